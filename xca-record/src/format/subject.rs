//! What a run is of: the model with its views.

use crate::place::place_of;
use crate::record::Shown;
use std::fmt;
use xca_core::Model;
use xca_io::map::{Map, Placement};

/// What a run is of.
#[derive(Clone, Copy)]
pub struct Subject<'a> {
    pub(crate) model: &'a Model,
    pub(crate) title: &'a str,
    /// The place of the space on a map.
    pub(crate) map: Option<&'a Map>,
    /// The length of a step in s.
    pub(crate) time_step: Option<f64>,
    pub(crate) shown: &'a [Shown],
}

/// Some substates that are saved together: of cells, or of the items of a population.
#[derive(Debug, Clone, Copy)]
pub struct View<'a> {
    pub(crate) shown: &'a Shown,
    number: usize,
}

impl<'a> Subject<'a> {
    /// The model.
    pub fn model(self) -> &'a Model {
        self.model
    }

    /// What the run is called.
    pub fn title(self) -> &'a str {
        self.title
    }

    /// Where its cells lie.
    pub fn placement(self) -> Placement {
        place_of(self.model, self.map)
    }

    /// Whether a map says where the cells lie.
    pub fn is_on_a_map(self) -> bool {
        self.map.is_some()
    }

    /// Of each cell, whether it has no ground; nothing where all have.
    pub fn missing(self) -> Option<&'a [bool]> {
        self.map.and_then(Map::missing)
    }

    /// What is saved, in the order of the set-up.
    pub fn views(self) -> impl Iterator<Item = View<'a>> {
        self.shown.iter().enumerate().map(|(number, shown)| View { shown, number })
    }

    /// The view that another way to draw it was made from.
    pub(crate) fn original(self, shown: &Shown) -> Option<View<'a>> {
        let stem = shown.view.stem();
        self.views().find(|view| view.stem() == stem)
    }

    /// The simulated time after so many steps: in seconds, or in steps where the model does not know better.
    pub fn time(self, step: u64) -> f64 {
        step as f64 * self.time_step.unwrap_or(1.0)
    }

    /// The step, and the time of a model that knows it.
    pub(crate) fn caption(self, step: u64) -> String {
        match self.time_step {
            Some(_) => {
                format!("step {step}, time {} s", xca_io::numbers::significant(self.time(step), 4))
            }
            None => format!("step {step}"),
        }
    }
}

impl fmt::Debug for Subject<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Subject")
            .field("model", &self.model.name())
            .field("time_step", &self.time_step)
            .field("shown", &self.shown)
            .finish_non_exhaustive()
    }
}

impl View<'_> {
    /// Its name.
    pub fn name(&self) -> &str {
        self.shown.view.name()
    }

    /// Its name in those of files.
    pub fn stem(&self) -> String {
        self.shown.view.stem()
    }

    /// Which view it is, from 0.
    pub fn number(&self) -> usize {
        self.number
    }

    /// Whether it shows items, not cells.
    pub fn shows_items(&self) -> bool {
        self.shown.is_of_items()
    }
}
