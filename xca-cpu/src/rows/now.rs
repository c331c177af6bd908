//! The current work of a thread, for reports after a panic.

use std::cell::Cell;
use xca_core::kernel::{Row, RowFault, StoppedAt};

/// The current work of a thread, for reports after a panic.
#[derive(Default)]
pub(super) struct Now {
    /// The index of the process in the pass.
    pub(super) process: Cell<usize>,
    pub(super) row: Cell<usize>,
    /// The index in the list of due rows, or the row itself without a list.
    pub(super) place: Cell<usize>,
    /// The first fault that the process has reported in the row.
    pub(super) reported: Cell<Option<RowFault>>,
    /// The place of the process when it ended or panicked.
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

/// Keeps the reports of a kernel, both after it ends and after a panic.
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
