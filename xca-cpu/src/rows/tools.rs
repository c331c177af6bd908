//! The buffers that a thread keeps from row to row, and the input of a kernel.

use super::now::Now;
use xca_core::kernel::{Entry, Scratch};

/// The outcome of a kernel in some cells.
#[derive(Default)]
pub(super) struct Outcome {
    /// The largest radius of a search.
    pub(super) widest: f64,
    /// Whether the result may depend on the step.
    pub(super) asked_for_step: bool,
}

/// Buffers kept from row to row.
pub(super) struct Work<'a> {
    pub(super) entries: Vec<Entry>,
    /// The results of a migration for the items of a row.
    pub(super) answers: Vec<u32>,
    pub(super) scratch: Scratch,
    pub(super) pieces: Pieces,
    pub(super) now: &'a Now,
}

/// The cells for a kernel.
pub(super) struct Cells {
    pub(super) row: usize,
    /// The padded index of the first cell.
    pub(super) first: usize,
    pub(super) origin: [u32; 3],
    pub(super) length: usize,
    /// The places of their items.
    pub(super) own: (usize, usize),
}

/// Marks and copies of a row, for processes that run in its due pieces.
#[derive(Default)]
pub(super) struct Pieces {
    /// The due tiles of a row.
    pub(super) due: Vec<u64>,
    /// The values of a piece before a process overwrote them in place.
    pub(super) before: Vec<u8>,
    /// For each substate that the process writes, the tiles that have changed and then the tiles that see the
    /// change.
    pub(super) changes: Vec<u64>,
}
