//! What an engine is to a simulation.

pub(crate) mod input;

pub use input::{
    InputError, check_cells, check_population, check_substate, check_values, check_values_of_cells,
};

use crate::geometry::Geometry;
use crate::kernel::{BEYOND_NEIGHBOURHOOD, RowFault, StoppedAt, WRONG_RADIUS};
use crate::model::Model;
use crate::parameter_set::ParameterSet;
use crate::process::Process;
use crate::reduction::{Reduced, Reduction};
use crate::value::Precision;
use std::any::Any;
use std::fmt;
use std::sync::Arc;

/// A way to run models: a value that a program chooses, and that a model never names.
pub trait Engine: fmt::Debug + Send + Sync {
    /// The name as on a command line: `reference`, `cpu`.
    fn name(&self) -> &str;

    /// How many threads it uses.
    fn threads(&self) -> usize;

    /// What a report says of the engine beside its name and its threads, its device for example: what it is, and which.
    fn facts(&self) -> Vec<(&'static str, String)> {
        Vec::new()
    }

    /// What a user has to know to judge times or results, if there is something.
    fn note(&self) -> Option<String> {
        None
    }

    /// The bytes that a model takes at least when it is started, so that a program can compare them with the memory there is before it asks
    /// for them. Items count where room for them is made in advance; an engine that does not know says 0.
    fn least_memory(&self, _model: &Model, _precision: Precision) -> u128 {
        0
    }

    /// Makes room for the state of a model. All substates are zero and all populations empty.
    ///
    /// # Errors
    /// Where the engine cannot run this model at this precision.
    fn start(&self, model: &Model, precision: Precision) -> Result<Box<dyn Execution>, StartError>;
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
/// A run of many steps moves to one of them as a whole; else each step would have to wake them and to wait for them to fall asleep.
pub trait Workers: Send + Sync {
    /// Does the work on one of the threads, and waits for it.
    fn run(&self, work: &mut (dyn FnMut() + Send));
}

/// A substate of a model: the number of its group, and of the field in the group.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
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

/// Why an engine does not do what it is asked to do with a state.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum EngineFailure {
    /// It cannot go on: its device was lost, or has no memory left.
    #[error("the {engine} engine failed: {reason}")]
    Broken {
        /// The engine.
        engine: String,
        /// Why.
        reason: String,
    },
    /// What it is given does not fit the model. The state is what it was.
    #[error(transparent)]
    Input(#[from] InputError),
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

/// The state of a model on an engine. Values pass as stored bytes: of cells in the order of linear indices, of items cell after cell
/// and by label.
///
/// Nothing may carry over from step to step but what these methods give and take: a run goes on from a snapshot made of them, on this engine
/// or another, as if it had never been interrupted.
pub trait Execution: Send {
    /// Runs those of these processes that are due in the step ([`Process::is_due`]), by their numbers in the model, in order.
    ///
    /// # Errors
    /// The first fault, by process, then cell, then label. The state is then that of an unfinished step.
    fn run(&mut self, processes: std::ops::Range<usize>, context: &StepContext<'_>) -> Result<(), Fault>;

    /// Runs so many whole steps, with nothing to do between them; the context is that of the first.
    ///
    /// # Errors
    /// The first fault, with the number of steps done before it.
    fn run_steps(&mut self, steps: u64, context: &StepContext<'_>) -> Result<(), Interruption>;

    /// All values of a substate.
    ///
    /// # Errors
    /// Where [`check_substate`] refuses it, or the engine cannot reach its state any more; so with all that follows.
    fn read(&self, substate: SubstateId) -> Result<Vec<u8>, EngineFailure>;

    /// Replaces all values of a substate; as many bytes as [`Self::read`] gives.
    ///
    /// # Errors
    /// Where [`check_values`] refuses them, and as [`Self::read`].
    fn write(&mut self, substate: SubstateId, values: &[u8]) -> Result<(), EngineFailure>;

    /// The values of a substate in these cells, given by their linear indices in any order, one value after the other.
    ///
    /// # Errors
    /// Where [`check_cells`] refuses them, and as [`Self::read`].
    fn read_cells(&self, substate: SubstateId, cells: &[usize]) -> Result<Vec<u8>, EngineFailure>;

    /// Replaces the values of a substate in these cells, given by their linear indices in any order. Of a cell that is given twice the last
    /// value stays.
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

    /// Reduces a substate, lane by lane, rows or blocks in order (see [`crate::reduction`]).
    ///
    /// # Errors
    /// As [`Self::read`].
    fn reduce(&self, substate: SubstateId, reduction: &Reduction) -> Result<Vec<Reduced>, EngineFailure>;

    /// The bytes that the state takes.
    fn memory(&self) -> usize;

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

/// What stops a run within a step.
#[derive(Debug, Clone, PartialEq)]
pub enum Fault {
    /// The engine cannot go on.
    Engine(EngineFailure),
    /// A process reported it.
    Reported {
        /// The process.
        process: &'static str,
        /// The indices of the cell.
        cell: [usize; 3],
        /// The item, in a process over items.
        label: Option<u32>,
        /// The code.
        code: u32,
        /// The value.
        value: f64,
    },
    /// A process asked for a neighbour that the neighbourhood does not have.
    BeyondNeighbourhood {
        /// The process.
        process: &'static str,
        /// The indices of the cell.
        cell: [usize; 3],
        /// The index that it asked for.
        index: u32,
        /// The size of the neighbourhood.
        size: usize,
    },
    /// A search has a radius beyond what the neighbourhood covers.
    SearchTooFar {
        /// The process.
        process: &'static str,
        /// The indices of the cell.
        cell: [usize; 3],
        /// The item.
        label: Option<u32>,
        /// The radius, in metres.
        radius: f64,
        /// The largest radius that the neighbourhood covers, in metres.
        covered: f64,
    },
    /// A search has a negative or NaN radius.
    InvalidRadius {
        /// The process.
        process: &'static str,
        /// The indices of the cell.
        cell: [usize; 3],
        /// The item.
        label: Option<u32>,
        /// The radius, in metres.
        radius: f64,
    },
    /// More items in a cell than it has slots.
    CellFull {
        /// The migration that moves them there; nothing where they are set from outside.
        process: Option<&'static str>,
        /// The indices of the cell.
        cell: [usize; 3],
        /// How many items there would be.
        items: usize,
        /// How many slots there are.
        slots: usize,
    },
    /// A migration sends an item to a cell that is no neighbour.
    TooFar {
        /// The process.
        process: &'static str,
        /// The item.
        label: u32,
        /// The indices of its cell.
        from: [usize; 3],
        /// The indices of the cell where it would go.
        to: [usize; 3],
    },
    /// A migration finds an item at a position that is no number.
    Nowhere {
        /// The process.
        process: &'static str,
        /// The item.
        label: u32,
        /// The indices of its cell.
        cell: [usize; 3],
    },
    /// A migration sends an item out of a space that none may leave.
    Left {
        /// The process.
        process: &'static str,
        /// The item.
        label: u32,
        /// The indices of its cell.
        cell: [usize; 3],
    },
    /// A substate that is to stay finite ([`crate::ModelBuilder::watch_finite`]) does not: the first by substate, cell and label.
    NotFinite {
        /// The struct and the substate, with the component: `Lava.outflow[3]`.
        substate: String,
        /// The indices of the cell.
        cell: [usize; 3],
        /// The item, of a population.
        label: Option<u32>,
        /// The value: NaN or an infinity.
        value: f64,
    },
    /// The code of a process panicked: an integer overflow, a division by zero, an index beyond an array.
    Panicked {
        /// The process.
        process: &'static str,
        /// The indices of the cell.
        cell: [usize; 3],
        /// The item, in a process over items.
        label: Option<u32>,
        /// The panic's message.
        message: String,
    },
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Engine(failure) => failure.fmt(f),
            Self::Reported { process, cell, label: None, code, value } => {
                write!(f, "`{process}` reports fault {code} with value {value} in cell {cell:?}")
            }
            Self::Reported { process, cell, label: Some(label), code, value } => {
                write!(
                    f,
                    "`{process}` reports fault {code} with value {value} for item {label} in cell {cell:?}"
                )
            }
            Self::BeyondNeighbourhood { process, cell, index, size } => {
                write!(
                    f,
                    "`{process}` asks for neighbour {index} in cell {cell:?}, but the neighbourhood has {size} cells (0 to {})",
                    size.saturating_sub(1)
                )
            }
            Self::SearchTooFar { process, cell, label, radius, covered } => {
                write!(
                    f,
                    "`{process}` searches within {radius} m around item {} in cell {cell:?}, but the \
                     neighbourhood covers {covered} m; use a wider neighbourhood (Moore covers \
                     its radius times the cell side) or larger cells",
                    label.unwrap_or_default()
                )
            }
            Self::InvalidRadius { process, cell, label, radius } => {
                write!(
                    f,
                    "`{process}` searches within {radius} m around item {} in cell {cell:?}; a radius is at least 0",
                    label.unwrap_or_default()
                )
            }
            Self::CellFull { process, cell, items, slots } => {
                if let Some(process) = process {
                    write!(f, "`{process}` moves too many items into one cell: ")?;
                }
                write!(
                    f,
                    "cell {cell:?} would hold {items} items, but a cell has {slots} slot{}; give the population more slots",
                    if *slots == 1 { "" } else { "s" }
                )
            }
            Self::TooFar { process, label, from, to } => {
                write!(
                    f,
                    "`{process}` moves item {label} from cell {from:?} to cell {to:?}, which is no neighbour; a smaller time step helps"
                )
            }
            Self::Nowhere { process, label, cell } => {
                write!(f, "`{process}` finds item {label} of cell {cell:?} at a position that is no number")
            }
            Self::Left { process, label, cell } => {
                write!(
                    f,
                    "`{process}` moves item {label} of cell {cell:?} out of the space, which this model does not allow"
                )
            }
            Self::NotFinite { substate, cell, label: None, value } => {
                write!(f, "`{substate}` is {value} in cell {cell:?}")
            }
            Self::NotFinite { substate, cell, label: Some(label), value } => {
                write!(f, "`{substate}` is {value} for item {label} in cell {cell:?}")
            }
            Self::Panicked { process, cell, label: None, message } => {
                write!(f, "the code of `{process}` panicked in cell {cell:?}: {message}")
            }
            Self::Panicked { process, cell, label: Some(label), message } => {
                write!(f, "the code of `{process}` panicked for item {label} in cell {cell:?}: {message}")
            }
        }
    }
}

impl std::error::Error for Fault {}

impl From<EngineFailure> for Fault {
    fn from(failure: EngineFailure) -> Self {
        Self::Engine(failure)
    }
}

impl Fault {
    /// A fault that a kernel recorded, as the host sees it.
    pub fn reported(process: &Process, fault: RowFault, geometry: &Geometry) -> Self {
        let cell = geometry.indices(fault.cell as usize);
        if fault.code == BEYOND_NEIGHBOURHOOD {
            let size = geometry.neighbourhood().size();
            return Self::BeyondNeighbourhood {
                process: process.name,
                cell,
                index: fault.value as u32,
                size,
            };
        }
        if fault.code == WRONG_RADIUS {
            let (process, label, radius) = (process.name, fault.label, fault.value);
            let invalid = radius.is_nan() || radius < 0.0;
            return if invalid {
                Self::InvalidRadius { process, cell, label, radius }
            } else {
                let covered = geometry.covered_radius(Precision::F64);
                Self::SearchTooFar { process, cell, label, radius, covered }
            };
        }
        Self::Reported {
            process: process.name,
            cell,
            label: fault.label,
            code: fault.code,
            value: fault.value,
        }
    }

    /// The fault that a panic of a process's code is.
    pub fn panicked(process: &Process, at: StoppedAt, panic: &(dyn Any + Send), geometry: &Geometry) -> Self {
        let message = panic
            .downcast_ref::<&str>()
            .map(|text| (*text).to_owned())
            .or_else(|| panic.downcast_ref::<String>().cloned())
            .unwrap_or_else(|| "without a message".to_owned());
        let (cell, message) = (geometry.indices(at.cell as usize), with_narrow_index(message));
        Self::Panicked { process: process.name, cell, label: at.label, message }
    }
}

/// The message about an index beyond an array with the 32 bits of the index that every engine has: a number
/// below zero that is taken for an index has 64 on a processor.
fn with_narrow_index(message: String) -> String {
    const WORDS: &str = "but the index is ";
    let wide =
        message.rsplit_once(WORDS).and_then(|(start, index)| Some((start, index.parse::<u64>().ok()?)));
    match wide {
        Some((start, index)) => format!("{start}{WORDS}{}", index as u32),
        None => message,
    }
}
