//! A run that goes on, as a format is given it.

use super::{OutputFile, Subject};
use crate::record::RunFolder;
use std::path::PathBuf;

/// A run that goes on.
#[derive(Debug, Clone, Copy)]
pub struct ResumedRun<'a> {
    subject: Subject<'a>,
    steps: &'a [u64],
    folder: &'a RunFolder,
}

impl<'a> ResumedRun<'a> {
    pub(crate) fn new(subject: Subject<'a>, steps: &'a [u64], folder: &'a RunFolder) -> Self {
        Self { subject, steps, folder }
    }

    /// What the run is of.
    pub fn subject(&self) -> Subject<'a> {
        self.subject
    }

    /// The steps after which states were recorded.
    pub fn steps(&self) -> &'a [u64] {
        self.steps
    }

    /// Where a file of the state after a step is.
    pub fn path(&self, file: &OutputFile, step: u64) -> PathBuf {
        file.path(self.folder, step)
    }
}
