//! A model with what its program shows of it.

use crate::observable::{Failure, Observable};
use crate::view::{AnyView, CellView, ItemView};
use serde::Serialize;
use std::fmt;
use std::path::PathBuf;
use xca_core::{Model, State, Substates};

type Observe = dyn Fn(&State<'_>) -> Result<Vec<Observable>, Failure> + Send + Sync;

/// A model, how long it is run, and what is shown and saved of it.
///
/// What is not said has a default that follows from the model's substates: statistics of each are observed
/// (of `bool` and states, how many there are), every population and all substates of cells are saved, and the
/// first of them is drawn.
#[non_exhaustive]
pub struct SetUp {
    /// The model.
    pub model: Model,
    /// What pictures and the terminal call the run.
    pub title: String,
    /// How many steps are done.
    pub steps: u64,
    /// How long a step is, in s; without it, time is counted in steps.
    pub time_step: Option<f64>,
    pub(crate) observe: Option<Box<Observe>>,
    pub(crate) views: Vec<AnyView>,
    /// The files that the set-up has read.
    pub inputs: Vec<PathBuf>,
    /// Where the south-west corner of the space lies on the map.
    pub corner: Option<[f64; 2]>,
    /// Whether the final state is written as ASCII grids.
    pub grids: bool,
    /// What `run.json` tells beside options and parameters.
    pub notes: serde_json::Map<String, serde_json::Value>,
}

impl SetUp {
    /// A model that is run for so many steps, unless the command line says otherwise.
    pub fn new(model: Model, steps: u64) -> Self {
        Self {
            title: model.name().to_owned(),
            model,
            steps,
            time_step: None,
            observe: None,
            views: Vec::new(),
            inputs: Vec::new(),
            corner: None,
            grids: false,
            notes: serde_json::Map::new(),
        }
    }

    /// What pictures and the terminal call the run; the model's name unless it is given.
    #[must_use]
    pub fn title(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    /// How many seconds a step is: a positive number, or the program refuses to run. Without it, time is counted in steps.
    #[must_use]
    pub fn time_step(mut self, seconds: f64) -> Self {
        self.time_step = Some(seconds);
        self
    }

    /// What is measured before the first step, every so many steps and after the last: always the same quantities in the same order, and
    /// as a function of the state alone, or a run that is resumed would show others.
    #[must_use]
    pub fn observables(
        mut self,
        observe: impl Fn(&State<'_>) -> Result<Vec<Observable>, Failure> + Send + Sync + 'static,
    ) -> Self {
        self.observe = Some(Box::new(observe));
        self
    }

    /// How the items of a population are saved and drawn.
    #[must_use]
    pub fn items<S: Substates>(mut self, view: ItemView<S>) -> Self {
        self.views.push(AnyView::Items(view.into_any()));
        self
    }

    /// How substates of cells are saved and drawn.
    #[must_use]
    pub fn cells<S: Substates>(mut self, view: CellView<S>) -> Self {
        self.views.push(AnyView::Cells(view.into_any()));
        self
    }

    /// Where the south-west corner of the space lies on the map, in metres.
    ///
    /// A model of one layer whose corner is known leaves its final state as ESRI ASCII grids too, one for each substate of cells
    /// (`final_altitude.asc`); any other model of one layer does so with `run --grids`, and its corner is at 0, 0.
    #[must_use]
    pub fn corner(mut self, metres: [f64; 2]) -> Self {
        self.corner = Some(metres);
        self.grids = true;
        self
    }

    /// A file that the set-up has read. A run never replaces it.
    #[must_use]
    pub fn input(mut self, path: impl Into<PathBuf>) -> Self {
        self.inputs.push(path.into());
        self
    }

    /// Something that `run.json` should tell beside the options and the parameters.
    ///
    /// # Errors
    /// Where the value cannot be written as JSON.
    pub fn note(mut self, name: &str, value: impl Serialize) -> Result<Self, Failure> {
        self.notes.insert(name.to_owned(), serde_json::to_value(value)?);
        Ok(self)
    }
}

/// A set-up that makes no sense.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SetUpError {
    /// A time step that is not a positive number.
    #[error("the time step is {seconds} s; it must be a positive number")]
    TimeStep {
        /// The time step, in s.
        seconds: f64,
    },
}

impl SetUp {
    /// Checks what no method has checked yet.
    ///
    /// # Errors
    /// Where the time step is not a positive number.
    pub fn check(&self) -> Result<(), SetUpError> {
        match self.time_step {
            Some(seconds) if !(seconds.is_finite() && seconds > 0.0) => Err(SetUpError::TimeStep { seconds }),
            _ => Ok(()),
        }
    }
}

impl fmt::Debug for SetUp {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SetUp")
            .field("model", &self.model.name())
            .field("steps", &self.steps)
            .field("time_step", &self.time_step)
            .field("views", &self.views)
            .finish_non_exhaustive()
    }
}
