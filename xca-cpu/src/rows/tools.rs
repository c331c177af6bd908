//! What a thread keeps from row to row, and what it hands to a kernel.

use super::now::Now;
use xca_core::kernel::{Entry, Scratch};

/// What a kernel has done in some cells.
#[derive(Default)]
pub(super) struct Outcome {
    /// The largest radius of a search.
    pub(super) widest: f64,
    /// Whether the result may be another one in another step.
    pub(super) asked_for_step: bool,
}

/// Lists that are kept from row to row.
pub(super) struct Work<'a> {
    pub(super) entries: Vec<Entry>,
    /// A migration's answers for the items of a row.
    pub(super) answers: Vec<u32>,
    pub(super) scratch: Scratch,
    pub(super) pieces: Pieces,
    pub(super) now: &'a Now,
}

/// The cells that a kernel is given.
pub(super) struct Cells {
    /// The padded number of the first.
    pub(super) first: usize,
    pub(super) origin: [u32; 3],
    pub(super) length: usize,
    /// Their items.
    pub(super) own: (usize, usize),
}

/// Marks and copies of a row, for processes that run in pieces of it.
#[derive(Default)]
pub(super) struct Pieces {
    /// The tiles of a row that are due.
    pub(super) due: Vec<u64>,
    /// What a piece held before a process wrote to it in place.
    pub(super) before: Vec<u8>,
    /// For each substate of the process the tiles that have changed, and those from which that is seen.
    pub(super) changes: Vec<[Vec<u64>; 2]>,
}
