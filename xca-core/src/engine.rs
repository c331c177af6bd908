//! The interface between simulations and engines.

mod fault;
pub(crate) mod input;
mod part;

pub use fault::{EngineFailure, Fault};
pub use input::{
    InputError, check_cells, check_cells_of_part, check_population, check_population_of_part, check_substate,
    check_values, check_values_of_cells, check_values_of_part,
};
pub use part::{Part, PartError};

use crate::model::Model;
use crate::parameter_set::ParameterSet;
use crate::reduction::{Reduced, ReducedRows, Reduction};
use std::any::Any;
use std::fmt;
use std::sync::Arc;
use xca_process::Face;
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

/// The connection of a part of a space to the other parts. Messages arrive in order. The engines define their
/// content.
pub trait Border: Send {
    /// Sends bytes to the part beyond this face. Does not wait for their arrival.
    ///
    /// # Errors
    /// Returns [`EngineFailure::Elsewhere`] if another part has ended, or an error if the connection is
    /// broken.
    fn send(&mut self, face: Face, bytes: Vec<u8>) -> Result<(), EngineFailure>;

    /// Waits for the bytes that the part beyond this face has sent across it.
    ///
    /// # Errors
    /// As [`Self::send`].
    fn receive(&mut self, face: Face) -> Result<Vec<u8>, EngineFailure>;

    /// The minimum of the numbers of all parts.
    ///
    /// # Errors
    /// As [`Self::send`].
    fn least(&mut self, number: u64) -> Result<u64, EngineFailure>;
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

/// The threads of an engine.
///
/// A run of many steps moves to one of them as a whole. Otherwise each step would wake them and wait for them
/// to sleep.
pub trait Workers: Send + Sync {
    /// Runs the work on one of the threads, and waits for it.
    fn run(&self, work: &mut (dyn FnMut() + Send));
}

/// A substate of a model: the number of its group, and of the field in the group.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
pub struct SubstateId {
    /// The number of the group, in the order of the model.
    pub group: usize,
    /// The number of the field.
    pub field: usize,
}

/// The inputs of a step, in addition to the state.
#[derive(Debug, Clone, Copy)]
pub struct StepContext<'a> {
    /// The number of the step, from 0.
    pub step: u64,
    /// The seed of random numbers.
    pub seed: u64,
    /// `P::Native<R>` of each struct of parameters.
    pub parameters: &'a [Arc<dyn Any + Send + Sync>],
    /// The same parameters by name, for engines with their own layout.
    pub values: &'a ParameterSet,
}

/// A fault in one of several steps.
#[derive(Debug, Clone, PartialEq)]
pub struct Interruption {
    /// The number of complete steps before it.
    pub done: u64,
    /// The fault.
    pub fault: Fault,
}

/// All items of a population, by cell and label.
#[derive(Debug, Clone, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub struct Population {
    /// The number of items in each cell.
    pub counts: Vec<u32>,
    /// The labels.
    pub labels: Vec<u32>,
    /// The stored bytes of each field.
    pub fields: Vec<Vec<u8>>,
}

/// A figure of how an engine works, such as how often it made lists anew.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Its name, usable as a key: `grain_lists_made`.
    pub name: String,
    /// Its value.
    pub value: f64,
}

/// The state of a model on an engine. Values pass as stored bytes: cells by linear index, items by cell and
/// label.
///
/// An execution has no other memory than what these methods read and write. A run therefore resumes from a
/// snapshot on any engine, as if it had never been interrupted.
pub trait Execution: Send {
    /// Runs the processes with these numbers in the model, in order, if they are due in the step
    /// ([`crate::Process::is_due`]).
    ///
    /// # Errors
    /// Returns the first fault, by process, then cell, then label. The state is then that of an unfinished
    /// step.
    fn run(&mut self, processes: std::ops::Range<usize>, context: &StepContext<'_>) -> Result<(), Fault>;

    /// Runs several whole steps, with nothing between them. The context is that of the first.
    ///
    /// # Errors
    /// Returns the first fault, with the number of steps before it. The state is then useless: later steps
    /// may have begun.
    fn run_steps(&mut self, steps: u64, context: &StepContext<'_>) -> Result<(), Interruption>;

    /// All values of a substate.
    ///
    /// # Errors
    /// Returns an error if [`check_substate`] does, or the engine lost its state.
    fn read(&self, substate: SubstateId) -> Result<Vec<u8>, EngineFailure>;

    /// Replaces all values of a substate, with as many bytes as [`Self::read`] returns.
    ///
    /// # Errors
    /// Returns an error if [`check_values`] does, or as [`Self::read`].
    fn write(&mut self, substate: SubstateId, values: &[u8]) -> Result<(), EngineFailure>;

    /// The values of a substate in the cells with these linear indices, in their order.
    ///
    /// # Errors
    /// Returns an error if [`check_cells`] does, or as [`Self::read`].
    fn read_cells(&self, substate: SubstateId, cells: &[usize]) -> Result<Vec<u8>, EngineFailure>;

    /// Replaces the values of a substate in the cells with these linear indices, in any order. If a cell is
    /// listed twice, the last value counts.
    ///
    /// # Errors
    /// Returns an error if [`check_values_of_cells`] does, or as [`Self::read`]. Nothing is then written.
    fn write_cells(
        &mut self,
        substate: SubstateId,
        cells: &[usize],
        values: &[u8],
    ) -> Result<(), EngineFailure>;

    /// All items of a population.
    ///
    /// # Errors
    /// As [`Self::read`].
    fn population(&self, group: usize) -> Result<Population, EngineFailure>;

    /// Replaces all items of a population.
    ///
    /// # Errors
    /// Returns an error if [`check_population`] does, such as [`Fault::CellFull`], or as [`Self::read`].
    fn set_population(&mut self, group: usize, population: &Population) -> Result<(), Fault>;

    /// The number of items of a population; 0 for substates of cells.
    fn items(&self, group: usize) -> usize;

    /// The number of items that left the space.
    fn left(&self, group: usize) -> u64;

    /// The largest number of items in a cell.
    ///
    /// # Errors
    /// As [`Self::read`].
    fn largest_occupancy(&self, group: usize) -> Result<u32, EngineFailure>;

    /// Reduces each row of a substate, component by component (see [`crate::reduction`]).
    ///
    /// # Errors
    /// As [`Self::read`].
    fn reduce_rows(&self, substate: SubstateId, reduction: &Reduction) -> Result<ReducedRows, EngineFailure>;

    /// Reduces a substate, component by component, from the results of its rows in order.
    ///
    /// # Errors
    /// As [`Self::read`].
    fn reduce(&self, substate: SubstateId, reduction: &Reduction) -> Result<Vec<Reduced>, EngineFailure> {
        Ok(self.reduce_rows(substate, reduction)?.combined(reduction))
    }

    /// The size of the state in bytes.
    fn memory(&self) -> usize;

    /// Figures of how the state is computed, for reports. They are not results: they differ between engines,
    /// threads and machines.
    fn figures(&self) -> Vec<Figure> {
        Vec::new()
    }

    /// The engine's own threads, if it has any.
    fn workers(&self) -> Option<Arc<dyn Workers>> {
        None
    }
}

/// Runs steps one by one, for an engine that does not combine steps.
///
/// # Errors
/// Returns the first fault.
pub fn step_by_step(
    steps: u64,
    context: &StepContext<'_>,
    mut step: impl FnMut(&StepContext<'_>) -> Result<(), Fault>,
) -> Result<(), Interruption> {
    (0..steps).try_for_each(|done| {
        let context = StepContext { step: context.step + done, ..*context };
        step(&context).map_err(|fault| Interruption { done, fault })
    })
}
