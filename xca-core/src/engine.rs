//! What an engine is to a simulation.

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

/// A way to run models: a value that a program chooses, and that a model never names.
pub trait Engine: fmt::Debug + Send + Sync {
    /// The name as on a command line: `reference`, `cpu`.
    fn name(&self) -> &str;

    /// How many threads it uses.
    fn threads(&self) -> usize;

    /// What a report says of the engine beside its name and its threads, its device for example: what it is,
    /// and which.
    fn facts(&self) -> Vec<(&'static str, String)> {
        Vec::new()
    }

    /// What a user has to know to judge times or results, if there is something.
    fn note(&self) -> Option<String> {
        None
    }

    /// The bytes that a model takes at least when it is started, so that a program can compare them with the
    /// memory there is before it asks for them. Items count where room for them is made in advance; an engine
    /// that does not know says 0.
    fn least_memory(&self, _model: &Model, _precision: Precision) -> u128 {
        0
    }

    /// Makes room for the state of a model. All substates are zero and all populations empty.
    ///
    /// # Errors
    /// Where the engine cannot run this model at this precision.
    fn start(&self, model: &Model, precision: Precision) -> Result<Box<dyn Execution>, StartError>;

    /// Makes room for a part of the state of a model; other executions have the other parts, and all do the
    /// same at the same time.
    ///
    /// The [`Execution`] knows the rows of its part alone. It reads and writes all values of these rows, and
    /// names cells by their linear indices in the whole space. Steps, random numbers, positions and faults
    /// are those of the whole space too. Each change of a state, such as [`Execution::write_cells`], is made
    /// of all parts, if only of no cell in some of them.
    ///
    /// # Errors
    /// Where the engine cannot run this model at this precision, this part of it, or no part at all.
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

/// The way from a part of a space to the others. What is sent arrives, in order; what it means is between the
/// engines.
pub trait Border: Send {
    /// Sends bytes to the part beyond this face of the own part. It does not wait until they arrive.
    ///
    /// # Errors
    /// [`EngineFailure::Elsewhere`] where another part has ended, and where the way is broken.
    fn send(&mut self, face: Face, bytes: Vec<u8>) -> Result<(), EngineFailure>;

    /// Waits for the bytes that the part beyond this face has sent to the own part across the same face.
    ///
    /// # Errors
    /// As [`Self::send`].
    fn receive(&mut self, face: Face) -> Result<Vec<u8>, EngineFailure>;

    /// The least of the numbers that all parts give.
    ///
    /// # Errors
    /// As [`Self::send`].
    fn least(&mut self, number: u64) -> Result<u64, EngineFailure>;
}

/// An engine that cannot run a model.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StartError {
    /// More memory or more cells than the engine can number.
    #[error(
        "the {engine} engine cannot hold this model: {what} would be {wanted}, at most {limit} can be; use fewer cells or slots"
    )]
    TooLarge {
        /// The engine.
        engine: String,
        /// What is too many.
        what: String,
        /// How many there would be.
        wanted: u128,
        /// How many there can be.
        limit: u128,
    },
    /// A space whose lengths are no positive numbers of the run's precision.
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
    /// A part that the model cannot be run on.
    #[error(transparent)]
    Part(#[from] PartError),
    /// An engine that cannot run a part of the model's space.
    #[error("the {engine} engine cannot run a part of the space: {reason}")]
    NoParts {
        /// The engine.
        engine: String,
        /// Why.
        reason: String,
    },
    /// Anything else, such as threads that could not be started.
    #[error("the {engine} engine cannot start: {reason}")]
    Other {
        /// The engine.
        engine: String,
        /// Why.
        reason: String,
    },
}

/// Threads that wait for work.
///
/// A run of many steps moves to one of them as a whole; else each step would have to wake them and to wait
/// for them to fall asleep.
pub trait Workers: Send + Sync {
    /// Does the work on one of the threads, and waits for it.
    fn run(&self, work: &mut (dyn FnMut() + Send));
}

/// A substate of a model: the number of its group, and of the field in the group.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
pub struct SubstateId {
    /// The number of the group in the order in which the model names them.
    pub group: usize,
    /// The number of the field.
    pub field: usize,
}

/// What the processes of a step need beside the state.
#[derive(Debug, Clone, Copy)]
pub struct StepContext<'a> {
    /// The number of the step, from 0.
    pub step: u64,
    /// The seed of random numbers.
    pub seed: u64,
    /// `P::Native<R>` of each struct of parameters.
    pub parameters: &'a [Arc<dyn Any + Send + Sync>],
    /// The same parameters by name, for engines that lay them out themselves.
    pub values: &'a ParameterSet,
}

/// A fault in one of several steps.
#[derive(Debug, Clone, PartialEq)]
pub struct Interruption {
    /// How many of the steps were done before.
    pub done: u64,
    /// What stopped the next one.
    pub fault: Fault,
}

/// All items of a population, in the order of cells, then labels.
#[derive(Debug, Clone, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub struct Population {
    /// How many items each cell has.
    pub counts: Vec<u32>,
    /// The labels.
    pub labels: Vec<u32>,
    /// The stored bytes of each field.
    pub fields: Vec<Vec<u8>>,
}

/// A figure of how an engine works, such as how often it has made lists anew.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// What it is, in words that can be a key: `grain_lists_made`.
    pub name: String,
    /// How much.
    pub value: f64,
}

/// The state of a model on an engine. Values pass as stored bytes: of cells in the order of linear indices,
/// of items cell after cell and by label.
///
/// Nothing may carry over from step to step but what these methods give and take: a run goes on from a
/// snapshot made of them, on this engine or another, as if it had never been interrupted.
pub trait Execution: Send {
    /// Runs those of these processes that are due in the step ([`crate::Process::is_due`]), by their numbers
    /// in the model, in order.
    ///
    /// # Errors
    /// The first fault, by process, then cell, then label. The state is then that of an unfinished step.
    fn run(&mut self, processes: std::ops::Range<usize>, context: &StepContext<'_>) -> Result<(), Fault>;

    /// Runs so many whole steps, with nothing to do between them; the context is that of the first.
    ///
    /// # Errors
    /// The first fault, with the number of steps done before it. The state is then of no use: steps after the
    /// one with the fault may have begun.
    fn run_steps(&mut self, steps: u64, context: &StepContext<'_>) -> Result<(), Interruption>;

    /// All values of a substate.
    ///
    /// # Errors
    /// Where [`check_substate`] refuses it, or the engine cannot reach its state any more; so with all that
    /// follows.
    fn read(&self, substate: SubstateId) -> Result<Vec<u8>, EngineFailure>;

    /// Replaces all values of a substate; as many bytes as [`Self::read`] gives.
    ///
    /// # Errors
    /// Where [`check_values`] refuses them, and as [`Self::read`].
    fn write(&mut self, substate: SubstateId, values: &[u8]) -> Result<(), EngineFailure>;

    /// The values of a substate in these cells, given by their linear indices in any order, one value after
    /// the other.
    ///
    /// # Errors
    /// Where [`check_cells`] refuses them, and as [`Self::read`].
    fn read_cells(&self, substate: SubstateId, cells: &[usize]) -> Result<Vec<u8>, EngineFailure>;

    /// Replaces the values of a substate in these cells, given by their linear indices in any order. Of a
    /// cell that is given twice the last value stays.
    ///
    /// # Errors
    /// Where [`check_values_of_cells`] refuses them, and as [`Self::read`]. Nothing is written then.
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
    /// Where [`check_population`] refuses them, [`Fault::CellFull`] among it, and as [`Self::read`].
    fn set_population(&mut self, group: usize, population: &Population) -> Result<(), Fault>;

    /// How many items a population has; 0 of substates of cells.
    fn items(&self, group: usize) -> usize;

    /// How many items have left the space.
    fn left(&self, group: usize) -> u64;

    /// The most items in one cell.
    ///
    /// # Errors
    /// As [`Self::read`].
    fn largest_occupancy(&self, group: usize) -> Result<u32, EngineFailure>;

    /// Reduces each row of a substate, component by component (see [`crate::reduction`]).
    ///
    /// # Errors
    /// As [`Self::read`].
    fn reduce_rows(&self, substate: SubstateId, reduction: &Reduction) -> Result<ReducedRows, EngineFailure>;

    /// Reduces a substate, component by component: the results of its rows in order.
    ///
    /// # Errors
    /// As [`Self::read`].
    fn reduce(&self, substate: SubstateId, reduction: &Reduction) -> Result<Vec<Reduced>, EngineFailure> {
        Ok(self.reduce_rows(substate, reduction)?.combined(reduction))
    }

    /// The bytes that the state takes.
    fn memory(&self) -> usize;

    /// What there is to tell of how the state is computed, for reports. None of it is a result: engines,
    /// threads and machines differ in it.
    fn figures(&self) -> Vec<Figure> {
        Vec::new()
    }

    /// The engine's own threads, if it has any.
    fn workers(&self) -> Option<Arc<dyn Workers>> {
        None
    }
}

/// Runs steps one after the other, for an engine that gains nothing from knowing how many follow.
///
/// # Errors
/// The first fault.
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
