//! A model that runs on an engine: its state and its steps.

use super::{EngineFailure, Fault, LabelledItems, Plane, Population, RowWork, SubstateId};
use crate::parameter_set::ParameterSet;
use crate::reduction::{Reduced, ReducedRows, Reduction};
use std::any::Any;
use std::ops::Range;
use std::sync::Arc;

/// The threads of an engine.
///
/// A run of many steps moves to one of them as a whole. Otherwise each step would wake them and wait for them
/// to sleep.
pub trait Workers: Send + Sync {
    /// Runs the work on one of the threads, and waits for it.
    fn run(&self, work: &mut (dyn FnMut() + Send));
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
    fn run(&mut self, processes: Range<usize>, context: &StepContext<'_>) -> Result<(), Fault>;

    /// Runs several whole steps, with nothing between them. The context is that of the first.
    ///
    /// # Errors
    /// Returns the first fault, with the number of steps before it. The state is then useless: later steps
    /// may have begun.
    fn run_steps(&mut self, steps: u64, context: &StepContext<'_>) -> Result<(), Interruption>;

    /// All values of a substate.
    ///
    /// # Errors
    /// Returns an error if [`check_substate`](super::check_substate) does, or the engine lost its state.
    fn read(&self, substate: SubstateId) -> Result<Vec<u8>, EngineFailure>;

    /// Replaces all values of a substate, with as many bytes as [`Self::read`] returns.
    ///
    /// # Errors
    /// Returns an error if [`check_values`](super::check_values) does, or as [`Self::read`].
    fn write(&mut self, substate: SubstateId, values: &[u8]) -> Result<(), EngineFailure>;

    /// The values of a substate in the cells with these linear indices, in their order.
    ///
    /// # Errors
    /// Returns an error if [`check_cells`](super::check_cells) does, or as [`Self::read`].
    fn read_cells(&self, substate: SubstateId, cells: &[usize]) -> Result<Vec<u8>, EngineFailure>;

    /// Replaces the values of a substate in the cells with these linear indices, in any order. If a cell is
    /// listed twice, the last value counts.
    ///
    /// # Errors
    /// Returns an error if [`check_values_of_cells`](super::check_values_of_cells) does, or as
    /// [`Self::read`]. Nothing is then written.
    fn write_cells(
        &mut self,
        substate: SubstateId,
        cells: &[usize],
        values: &[u8],
    ) -> Result<(), EngineFailure>;

    /// The bytes of a plane in these rows of the whole space. Rows count along y, then along z. An engine
    /// with a part of the space gives those of its own rows. `None` if the engine reads whole planes only.
    ///
    /// # Errors
    /// Returns an error if [`check_plane`](super::check_plane) does, or as [`Self::read`].
    fn read_rows(&self, _plane: Plane, _rows: Range<usize>) -> Result<Option<Vec<u8>>, EngineFailure> {
        Ok(None)
    }

    /// Replaces the values of a substate of cells in these rows of the whole space. An engine with a part of
    /// the space takes those of its own rows. `false` if the engine writes whole planes only.
    ///
    /// # Errors
    /// Returns an error if [`check_values_of_rows`](super::check_values_of_rows) does, or as
    /// [`Self::read`]. Nothing is then written.
    fn write_rows(
        &mut self,
        _substate: SubstateId,
        _rows: Range<usize>,
        _values: &[u8],
    ) -> Result<bool, EngineFailure> {
        Ok(false)
    }

    /// Takes the bytes of a plane of a population in these rows of the whole space, for
    /// [`Self::set_collected_items`]. The rows of each plane come in order, and the counts of rows before
    /// their labels and values. Row 0 begins anew. `false` if the engine takes populations as a whole only.
    ///
    /// # Errors
    /// Returns an error if the model does not have the plane, the number of bytes is wrong, or the engine
    /// lost its state.
    fn collect_items(
        &mut self,
        _plane: Plane,
        _rows: Range<usize>,
        _bytes: &[u8],
    ) -> Result<bool, EngineFailure> {
        Ok(false)
    }

    /// Replaces all items of a population by those that [`Self::collect_items`] has taken. Whoever gives them
    /// has to make sure that no two have one label.
    ///
    /// # Errors
    /// As [`Self::set_population`].
    fn set_collected_items(&mut self, _group: usize) -> Result<(), Fault> {
        Ok(())
    }

    /// All items of a population.
    ///
    /// # Errors
    /// As [`Self::read`].
    fn population(&self, group: usize) -> Result<Population, EngineFailure>;

    /// For each block of labels ([`LabelledItems::BLOCK`] of them) the number of items. `None` for a group of
    /// cells, or if the engine gives populations as a whole only.
    ///
    /// # Errors
    /// As [`Self::read`].
    fn label_counts(&self, _group: usize) -> Result<Option<Vec<u32>>, EngineFailure> {
        Ok(None)
    }

    /// The items of a population with labels in this range, of an engine with [`Self::label_counts`].
    ///
    /// # Errors
    /// As [`Self::read`].
    fn labelled_items(&self, _group: usize, _labels: Range<u64>) -> Result<LabelledItems, EngineFailure> {
        Ok(LabelledItems::default())
    }

    /// Replaces all items of a population.
    ///
    /// # Errors
    /// Returns an error if [`check_population`](super::check_population) does, such as
    /// [`Fault::CellFull`], or as [`Self::read`].
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

    /// The work in each row since the start, to balance parts of a space. Both lists are empty if the engine
    /// does not count. It is no result: it may differ between engines and runs.
    fn work(&self) -> RowWork {
        RowWork::default()
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
