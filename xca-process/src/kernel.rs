//! The input of native kernels: a row of cells, or the items of a row of cells.
//!
//! An engine describes a row by a [`Row`]. A kernel, made by the macros, requests the substates that its
//! process declares (its [`Access`] list), and works through the row. A whole row takes one dynamic call.
//! Inside it everything is monomorphic, so the compiler can vectorize.
//!
//! This module is for engines and for code that the macros write. An engine guarantees the properties of a
//! row ([`Row::new`]). A kernel is not trusted: each of its requests is compared with the row's entries, once
//! a row.

mod cells;
mod codes;
mod company;
mod constants;
mod distance;
mod draws;
mod entries;
mod filter;
mod frame;
mod items;
mod near;
mod neighbours;
mod pairs;
pub mod reach;
mod requests;
mod row;
mod scratch;
mod search;
mod space;
mod values;
mod walk;
mod wide;
mod work;
mod written;

pub use cells::{AroundRead, Blocks, CentreRead, Column, Columns, Offset};
pub use codes::{BEYOND_NEIGHBOURHOOD, NOWHERE, OUTSIDE, STAY, WRONG_RADIUS};
pub use constants::{KernelConstant, constant};
pub use draws::Draws;
pub use entries::{Entry, Memory, MemoryOf};
pub use filter::CellFilter;
pub use frame::Frame;
pub use items::{NO_PLACE, NearLists, RowItems};
pub use neighbours::{Directions, Offsets};
pub use pairs::{Batch, GROUP, Pairs};
pub use row::{Place, Row, RowFault, StoppedAt};
pub use scratch::{Found, Scratch};
pub use space::NativeSpace;
pub use values::{
    ArrayValue, BATCH, KernelElement, KernelValue, Lanes, Planes, Written, block, empty_batch, load,
    load_element, store,
};
pub use work::{Work, run};
pub use written::{Stage, WrittenArrays};
pub use xca_space::shapes::{ANY as ANY_SHAPE, ShapeNumber};
pub use xca_values::Instructions;

/// A kernel: runs a process over one row.
pub type RowKernel = fn(&Row<'_>);

/// The use of one substate by a process, derived from the body.
#[derive(Debug, Clone, Copy)]
pub struct Access {
    /// The index of its struct among the structs that the process takes.
    pub argument: usize,
    /// The index of the field.
    pub field: usize,
    /// Whether it is read at the centre.
    pub centre: bool,
    /// Whether it is read at neighbours, or from other items.
    pub others: bool,
    /// Whether it is written.
    pub write: bool,
}
