//! What a thread is doing, to be known after a panic.

use std::cell::Cell;
use xca_core::kernel::{Row, RowFault, StoppedAt};

/// What is being done, to be known after a panic.
#[derive(Default)]
pub(super) struct Now {
    /// The number of the process in the pass.
    pub(super) process: Cell<usize>,
    pub(super) row: Cell<usize>,
    /// The number of the row in the list of those that are due, or the row.
    pub(super) place: Cell<usize>,
    /// The first fault that the process has reported in the row.
    pub(super) reported: Cell<Option<RowFault>>,
    /// Where the process was when it ended or panicked.
    pub(super) stopped: Cell<Option<StoppedAt>>,
}

impl Now {
    pub(super) fn start(&self, process: usize, row: usize, place: usize) {
        self.process.set(process);
        self.place.set(place);
        self.row.set(row);
        self.reported.set(None);
        self.stopped.set(None);
    }
}

/// Keeps what a kernel has reported when it ends, and when it panics.
pub(super) struct Report<'a> {
    pub(super) row: &'a Row<'a>,
    pub(super) now: &'a Now,
}

impl Drop for Report<'_> {
    fn drop(&mut self) {
        if self.now.reported.get().is_none() {
            self.now.reported.set(self.row.first_fault());
        }
        self.now.stopped.set(Some(self.row.stopped_at()));
    }
}
