//! Requests of a state that do not fit its model.

use crate::engine::{EngineFailure, Fault};
use xca_process::ParameterError;

/// A request that does not fit the model.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StateError {
    /// The model does not have these substates.
    #[error("the model has no substates `{0}`")]
    UnknownSubstates(&'static str),
    /// The substates belong to cells.
    #[error("`{0}` are the substates of cells, not of a population")]
    NotAPopulation(&'static str),
    /// The substates belong to items.
    #[error("`{0}` is a population; its items are not numbered by cells")]
    NotOfCells(&'static str),
    /// A cell that the space does not have.
    #[error("the space of {extents:?} cells has no cell {cell:?}")]
    NoSuchCell {
        /// The indices of the cell.
        cell: [usize; 3],
        /// The extents.
        extents: [usize; 3],
    },
    /// The number of values differs from that of the cells or items.
    #[error("`{substate}` has {wanted} values, but {given} are given")]
    WrongNumber {
        /// The substate.
        substate: &'static str,
        /// The number of cells or items.
        wanted: usize,
        /// The number of values.
        given: usize,
    },
    /// A bitwise reduction of floating-point numbers.
    #[error(
        "`{0}` holds floating numbers, whose bits cannot be reduced; use a logical reduction, or a substate of integers"
    )]
    BitsOfFloats(&'static str),
    /// Two items with the same label.
    #[error("the label {0} is given to two items")]
    LabelTwice(u32),
    /// A parameter that cannot be read or set.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// The engine lost its state.
    #[error(transparent)]
    Engine(#[from] EngineFailure),
    /// Items that do not fit.
    #[error(transparent)]
    Fault(#[from] Fault),
}
