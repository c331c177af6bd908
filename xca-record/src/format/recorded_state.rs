//! A state, as a format is given it.

use super::{OutputFile, Subject, View};
use crate::record::{CellState, ItemState, Plane, RunFolder};
use std::path::PathBuf;
use xca_core::engine::SubstateId;
use xca_core::{GroupSnapshot, Precision, Snapshot};

/// A state that is recorded.
#[derive(Debug, Clone, Copy)]
pub struct RecordedState<'a> {
    pub(crate) subject: Subject<'a>,
    pub(crate) snapshot: &'a Snapshot,
    pub(crate) precision: Precision,
    pub(crate) folder: &'a RunFolder,
}

impl<'a> RecordedState<'a> {
    /// What it is a state of.
    pub fn subject(&self) -> Subject<'a> {
        self.subject
    }

    /// The number of steps done.
    pub fn step(&self) -> u64 {
        self.snapshot.step
    }

    /// The simulated time.
    pub fn time(&self) -> f64 {
        self.subject.time(self.snapshot.step)
    }

    /// What `Real` is.
    pub fn precision(&self) -> Precision {
        self.precision
    }

    /// Where a file goes.
    pub fn path(&self, file: &OutputFile) -> PathBuf {
        file.path(self.folder, self.snapshot.step)
    }

    /// What a view shows of cells; nothing where it shows items.
    pub fn cells(&self, view: View<'a>) -> Option<CellState<'a>> {
        view.shown.cells(self.subject.model(), self.precision, self.snapshot)
    }

    /// What a view shows of items; nothing where it shows cells.
    pub fn items(&self, view: View<'a>) -> Option<ItemState<'a>> {
        view.shown.items(self.subject.model(), self.precision, self.snapshot)
    }

    /// The values of a substate of cells, of whichever view; nothing of one of items.
    pub fn values(&self, substate: SubstateId) -> Option<Plane> {
        match self.snapshot.groups.get(substate.group)? {
            GroupSnapshot::Cells(fields) => {
                let stored = self.subject.model().stored(substate, self.precision);
                Some(Plane::all(stored, fields.get(substate.field)?))
            }
            GroupSnapshot::Population(..) => None,
        }
    }
}
