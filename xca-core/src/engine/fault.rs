//! Errors that end a run.

use super::InputError;
use std::any::Any;
use std::fmt;
use xca_process::Geometry;
use xca_process::Process;
use xca_process::kernel::{BEYOND_NEIGHBOURHOOD, RowFault, StoppedAt, WRONG_RADIUS};
use xca_values::Precision;

/// A request that an engine cannot carry out.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum EngineFailure {
    /// The engine cannot continue: its device was lost, or ran out of memory.
    #[error("the {engine} engine failed: {reason}")]
    Broken {
        /// The engine.
        engine: String,
        /// Why.
        reason: String,
    },
    /// Another part of the space has a fault or cannot continue. Its own execution reports it.
    #[error("another part of the space has stopped")]
    Elsewhere,
    /// The input does not fit the model. The state does not change.
    #[error(transparent)]
    Input(#[from] InputError),
}

/// An error within a step. It ends the run.
#[derive(Debug, Clone, PartialEq)]
pub enum Fault {
    /// The engine cannot continue.
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
    /// A process asked for a neighbour beyond the neighbourhood.
    BeyondNeighbourhood {
        /// The process.
        process: &'static str,
        /// The indices of the cell.
        cell: [usize; 3],
        /// The index of the neighbour.
        index: u32,
        /// The size of the neighbourhood.
        size: usize,
    },
    /// The radius of a search is larger than the neighbourhood covers.
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
    /// The radius of a search is negative or NaN.
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
    /// A cell has more items than slots.
    CellFull {
        /// The migration that moved them there; `None` if the host set them.
        process: Option<&'static str>,
        /// The indices of the cell.
        cell: [usize; 3],
        /// The number of items.
        items: usize,
        /// The number of slots.
        slots: usize,
    },
    /// A migration sends an item beyond the neighbourhood of its cell.
    TooFar {
        /// The process.
        process: &'static str,
        /// The item.
        label: u32,
        /// The indices of its cell.
        from: [usize; 3],
        /// The indices of the destination.
        to: [usize; 3],
    },
    /// A migration finds an item with a NaN position.
    Nowhere {
        /// The process.
        process: &'static str,
        /// The item.
        label: u32,
        /// The indices of its cell.
        cell: [usize; 3],
    },
    /// A migration sends an item out of the space, which the model does not allow.
    Left {
        /// The process.
        process: &'static str,
        /// The item.
        label: u32,
        /// The indices of its cell.
        cell: [usize; 3],
    },
    /// A substate is NaN or infinite ([`crate::ModelBuilder::watch_finite`]): the first by substate, cell and
    /// label.
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
    /// A process panicked: integer overflow, division by zero, index out of bounds.
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
                write!(f, "`{process}` finds item {label} of cell {cell:?} at a NaN position")
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

impl From<InputError> for Fault {
    fn from(error: InputError) -> Self {
        Self::Engine(EngineFailure::Input(error))
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
