//! A state, as a format is given it.

use super::{OutputFile, Subject, View};
use crate::record::{CellState, ItemState, Plane, RunFolder, Seen, Source};
use std::path::PathBuf;
use xca_core::engine::SubstateId;
use xca_core::{EngineFailure, Precision};

/// A state that is recorded.
#[derive(Debug, Clone, Copy)]
pub struct RecordedState<'a> {
    pub(crate) subject: Subject<'a>,
    pub(crate) source: Source<'a>,
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
        self.source.step()
    }

    /// The simulated time.
    pub fn time(&self) -> f64 {
        self.subject.time(self.source.step())
    }

    /// What `Real` is.
    pub fn precision(&self) -> Precision {
        self.precision
    }

    /// Where a file goes.
    pub fn path(&self, file: &OutputFile) -> PathBuf {
        file.path(self.folder, self.source.step())
    }

    /// What a view shows of cells; nothing where it shows items.
    pub fn cells(&self, view: View<'a>) -> Option<CellState<'a>> {
        view.shown.cells(self.subject.model(), self.precision, self.source)
    }

    /// What a view shows of items; nothing where it shows cells.
    pub fn items(&self, view: View<'a>) -> Option<ItemState<'a>> {
        view.shown.items(self.subject.model(), self.precision, self.source)
    }

    /// All values of a substate, of whichever view.
    ///
    /// # Errors
    /// Where there is no such substate, or the engine has lost its state.
    pub fn values(&self, substate: SubstateId) -> Result<Plane, EngineFailure> {
        let values = self.source.values(substate)?;
        Ok(Plane::all(self.subject.model().stored(substate, self.precision), &values))
    }

    /// What a view draws.
    pub(crate) fn seen(&self, view: View<'_>) -> Result<Seen, EngineFailure> {
        view.shown.seen(self.subject.model(), self.precision, self.source)
    }
}
