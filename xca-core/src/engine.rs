//! The interface between simulations and engines.

mod agreement;
mod border;
mod execution;
mod fault;
pub(crate) mod input;
mod input_error;
mod labelled;
mod part;
mod plane;
mod population;
mod row_work;
mod substate_id;

pub use agreement::{Phase, STEPS_TO_AGREE, Stopped, agree};
pub use border::Border;
pub use execution::{Execution, Figure, Interruption, StepContext, Workers, step_by_step};
pub use fault::{EngineFailure, Fault};
pub(crate) use input::full_cell;
pub use input::{
    check_cells, check_cells_of_part, check_plane, check_population, check_population_of_part,
    check_substate, check_values, check_values_of_cells, check_values_of_part, check_values_of_rows,
};
pub use input_error::InputError;
pub use labelled::LabelledItems;
pub use part::{Part, PartError};
pub use plane::Plane;
pub use population::Population;
pub use row_work::RowWork;
pub use substate_id::SubstateId;

use crate::model::Model;
use std::fmt;
use xca_values::Precision;

/// A way to run models. A program chooses one; a model never names one.
pub trait Engine: fmt::Debug + Send + Sync {
    /// The name on the command line: `reference`, `cpu`.
    fn name(&self) -> &str;

    /// The number of threads.
    fn threads(&self) -> usize;

    /// Further entries of a report, such as the device: names and values.
    fn facts(&self) -> Vec<(&'static str, String)> {
        Vec::new()
    }

    /// A caveat for the times or results of this engine, if there is one.
    fn note(&self) -> Option<String> {
        None
    }

    /// A lower bound of the memory that a model takes, in bytes, so that a program can check it in advance.
    /// Items count if their memory is allocated in advance. 0 means unknown.
    fn least_memory(&self, _model: &Model, _precision: Precision) -> u128 {
        0
    }

    /// Allocates the state of a model. All substates are zero, and all populations are empty.
    ///
    /// # Errors
    /// Returns an error if the engine cannot run this model at this precision.
    fn start(&self, model: &Model, precision: Precision) -> Result<Box<dyn Execution>, StartError>;

    /// Allocates a part of the state of a model. Other executions hold the other parts, and all make the same
    /// calls at the same time.
    ///
    /// The [`Execution`] holds the rows of its part only. It reads and writes all values of these rows, and
    /// names cells by their linear indices in the whole space. Steps, random numbers, positions and faults
    /// are those of the whole space. Every change of a state, such as [`Execution::write_cells`], is called
    /// on all parts, with no cells where there are none.
    ///
    /// # Errors
    /// Returns an error if the engine cannot run this model at this precision, this part of it, or any part.
    fn start_part(
        &self,
        _model: &Model,
        _precision: Precision,
        _part: &Part,
        _border: Box<dyn Border>,
    ) -> Result<Box<dyn Execution>, StartError> {
        let (engine, reason) = (self.name().to_owned(), "it cannot share a space with others".to_owned());
        Err(StartError::NoParts { engine, reason })
    }
}

/// A model that an engine cannot run.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StartError {
    /// The model needs more memory or more cells than the engine can address.
    #[error(
        "the {engine} engine cannot hold this model: {what} would be {wanted}, at most {limit} can be; use fewer cells or slots"
    )]
    TooLarge {
        /// The engine.
        engine: String,
        /// The quantity that is too large.
        what: String,
        /// The required amount.
        wanted: u128,
        /// The largest possible amount.
        limit: u128,
    },
    /// The lengths of the space are not positive numbers at the precision of the run.
    #[error(
        "a cell side of {side} m with {extents:?} cells overflows or vanishes in {precision}; run in f64"
    )]
    Length {
        /// The side of a cell in metres.
        side: f64,
        /// The number of cells along x, y, z.
        extents: [usize; 3],
        /// The precision of the run.
        precision: Precision,
    },
    /// The part does not fit the model.
    #[error(transparent)]
    Part(#[from] PartError),
    /// The engine cannot run a part of the model's space.
    #[error("the {engine} engine cannot run a part of the space: {reason}")]
    NoParts {
        /// The engine.
        engine: String,
        /// Why.
        reason: String,
    },
    /// Any other reason, such as threads that failed to start.
    #[error("the {engine} engine cannot start: {reason}")]
    Other {
        /// The engine.
        engine: String,
        /// Why.
        reason: String,
    },
}
