//! What a format is told: the model with its views, and the states.

use super::OutputFile;
use crate::record::{CellState, ItemState, Plane, RunFolder, Shown};
use crate::set_up::SetUp;
use std::path::PathBuf;
use xca_core::engine::SubstateId;
use xca_core::{GroupSnapshot, Model, Precision, Snapshot};
use xca_io::map::Placement;

/// What a run is of.
#[derive(Debug, Clone, Copy)]
pub struct Subject<'a> {
    pub(crate) set_up: &'a SetUp,
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
        &self.set_up.model
    }

    /// What the run is called.
    pub fn title(self) -> &'a str {
        &self.set_up.title
    }

    /// Where its cells lie.
    pub fn placement(self) -> Placement {
        self.set_up.placement()
    }

    /// Whether a map says where the cells lie.
    pub fn is_on_a_map(self) -> bool {
        self.set_up.map.is_some()
    }

    /// Of each cell, whether it has no ground; nothing where all have.
    pub fn missing(self) -> Option<&'a [bool]> {
        self.set_up.missing()
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
        step as f64 * self.set_up.time_step.unwrap_or(1.0)
    }

    /// The step, and the time of a model that knows it.
    pub(crate) fn caption(self, step: u64) -> String {
        match self.set_up.time_step {
            Some(_) => {
                format!("step {step}, time {} s", xca_io::numbers::significant(self.time(step), 4))
            }
            None => format!("step {step}"),
        }
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

/// A state that is recorded.
#[derive(Debug, Clone, Copy)]
pub struct RecordedState<'a> {
    pub(crate) subject: Subject<'a>,
    pub(crate) snapshot: &'a Snapshot,
    pub(crate) precision: Precision,
    pub(crate) folder: &'a RunFolder,
}

impl<'a> RecordedState<'a> {
    /// What it is a state of.
    pub fn subject(&self) -> Subject<'a> {
        self.subject
    }

    /// The number of steps done.
    pub fn step(&self) -> u64 {
        self.snapshot.step
    }

    /// The simulated time.
    pub fn time(&self) -> f64 {
        self.subject.time(self.snapshot.step)
    }

    /// What `Real` is.
    pub fn precision(&self) -> Precision {
        self.precision
    }

    /// Where a file goes.
    pub fn path(&self, file: &OutputFile) -> PathBuf {
        file.path(self.folder, self.snapshot.step)
    }

    /// What a view shows of cells; nothing where it shows items.
    pub fn cells(&self, view: View<'a>) -> Option<CellState<'a>> {
        view.shown.cells(self.subject.model(), self.precision, self.snapshot)
    }

    /// What a view shows of items; nothing where it shows cells.
    pub fn items(&self, view: View<'a>) -> Option<ItemState<'a>> {
        view.shown.items(self.subject.model(), self.precision, self.snapshot)
    }

    /// The values of a substate of cells, of whichever view; nothing of one of items.
    pub fn values(&self, substate: SubstateId) -> Option<Plane> {
        match self.snapshot.groups.get(substate.group)? {
            GroupSnapshot::Cells(fields) => {
                let stored = self.subject.model().stored(substate, self.precision);
                Some(Plane::all(stored, fields.get(substate.field)?))
            }
            GroupSnapshot::Population(..) => None,
        }
    }
}
