//! The buffers that a thread keeps from row to row, and the input of a kernel.

use super::now::Now;
use std::cell::Cell;
use xca_core::kernel::{Entry, Scratch};
use xca_core::storage::Buffer;

/// The outcome of a kernel in some cells.
#[derive(Default)]
pub(super) struct Outcome {
    /// The largest radius of a search.
    pub(super) widest: f64,
    /// Whether the result may depend on the step.
    pub(super) asked_for_step: bool,
}

/// The work of a thread in some rows.
pub(super) struct Work<'a> {
    pub(super) buffers: Buffers,
    /// The results of searches, which are those of this pass.
    pub(super) scratch: Scratch,
    pub(super) now: &'a Now,
}

/// Buffers that a thread keeps from row to row.
#[derive(Default)]
pub(super) struct Buffers {
    pub(super) entries: Vec<Entry>,
    /// The results of a migration for the items of a row.
    pub(super) answers: Vec<u32>,
    pub(super) pieces: Pieces,
    /// The positions of a row before the pass, of each measured population.
    pub(super) positions: Vec<Buffer>,
}

thread_local! {
    /// The buffers of this thread between blocks of rows. Blocks can be small, and new buffers expensive.
    static SPARE: Cell<Buffers> = Cell::default();
}

impl<'a> Work<'a> {
    /// Begins with the buffers of this thread.
    pub(super) fn begin(now: &'a Now) -> Self {
        Self { buffers: SPARE.take(), scratch: Scratch::default(), now }
    }

    /// Keeps the buffers for the next rows.
    pub(super) fn end(self) {
        SPARE.set(self.buffers);
    }
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
