//! Input that does not fit a model.

use std::ops::Range;

/// Input that does not fit the model. The state does not change.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum InputError {
    /// A group that the model does not have.
    #[error("the model has {groups} structs of substates, no number {group}")]
    NoSuchGroup {
        /// The number.
        group: usize,
        /// The number of groups.
        groups: usize,
    },
    /// A field that the struct does not have.
    #[error("`{substates}` has {fields} substates, no number {field}")]
    NoSuchField {
        /// The name of the struct.
        substates: &'static str,
        /// The number.
        field: usize,
        /// The number of fields.
        fields: usize,
    },
    /// The group is a population, not substates of cells.
    #[error("`{0}` is a population; its items are not numbered by cells")]
    NotOfCells(&'static str),
    /// The group belongs to cells, not to a population.
    #[error("`{0}` are the substates of cells, not of a population")]
    NotAPopulation(&'static str),
    /// A cell that the space does not have.
    #[error("the space has {cells} cells, no cell number {cell}")]
    NoSuchCell {
        /// The linear index.
        cell: usize,
        /// The number of cells.
        cells: usize,
    },
    /// A cell that belongs to another part of the space.
    #[error("cell number {cell} is not in the part of the space with y in {y:?} and z in {z:?}")]
    NotInPart {
        /// The linear index.
        cell: usize,
        /// The indices of the part along y.
        y: Range<usize>,
        /// Its indices along z.
        z: Range<usize>,
    },
    /// The number of bytes is not that of the values.
    #[error("the values of `{substates}.{substate}` take {wanted} bytes, but {given} are given")]
    WrongLength {
        /// The name of the struct.
        substates: &'static str,
        /// The name of the field.
        substate: &'static str,
        /// The number of bytes of the values.
        wanted: usize,
        /// The number of bytes in the input.
        given: usize,
    },
    /// A byte is not a `bool` or not a state.
    #[error("`{substates}`: {reason}")]
    NoState {
        /// The name of the struct.
        substates: &'static str,
        /// The invalid byte, in words.
        reason: String,
    },
    /// The counts, labels and fields of items do not agree.
    #[error("`{substates}`: {reason}")]
    Items {
        /// The name of the struct.
        substates: &'static str,
        /// The difference.
        reason: String,
    },
}
