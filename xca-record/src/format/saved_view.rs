//! Where the files of a state are, as a view has saved it.

use super::{Moment, OutputFile, Subject, View};
use crate::record::{FRAMES, SavedRun};
use std::path::PathBuf;
use xca_core::Precision;
use xca_io::atomic::OutputFolder;

/// A state that a run has saved, as a view saves it.
#[derive(Debug, Clone, Copy)]
pub struct SavedView<'a> {
    pub(crate) subject: Subject<'a>,
    pub(crate) view: View<'a>,
    pub(crate) run: &'a SavedRun,
    pub(crate) step: u64,
}

impl<'a> SavedView<'a> {
    /// What the run is of.
    pub fn subject(&self) -> Subject<'a> {
        self.subject
    }

    /// The view.
    pub fn view(&self) -> View<'a> {
        self.view
    }

    /// The number of steps done.
    pub fn step(&self) -> u64 {
        self.step
    }

    /// The simulated time.
    pub fn time(&self) -> f64 {
        self.subject.time(self.step)
    }

    /// What `Real` was.
    pub fn precision(&self) -> Precision {
        self.run.precision
    }

    /// Where a file is.
    pub fn path(&self, file: &OutputFile) -> PathBuf {
        match file.moment() {
            Moment::Each => file.frame(&OutputFolder::to_read(self.run.folder.join(FRAMES)), self.step),
            _ => self.run.folder.join(file.own_name()),
        }
    }
}
