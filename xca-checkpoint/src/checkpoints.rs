//! When checkpoints are written.

use super::{CheckpointFolder, CheckpointWriteError, Description, Interval};
use std::path::Path;
use std::time::Instant;
use xca_core::Simulation;
use xca_io::atomic::{OutputFolder, WriteError};

/// The checkpoints of a run.
#[derive(Debug)]
pub struct Checkpoints {
    every: Interval,
    folder: CheckpointFolder,
    written: Instant,
}

impl Checkpoints {
    /// Those of a run in a folder, which may have been resumed from one of them.
    ///
    /// # Errors
    /// If the folder for them cannot be made.
    pub fn new(every: Interval, run: &OutputFolder, from: Option<&Path>) -> Result<Self, WriteError> {
        Ok(Self { every, folder: CheckpointFolder::create(run, from)?, written: Instant::now() })
    }

    /// The step of the next one, where that is known.
    pub fn next(&self, done: u64) -> u64 {
        match self.every {
            Interval::Steps(steps) => (done / steps + 1).saturating_mul(steps),
            Interval::Time(_) => u64::MAX,
        }
    }

    /// Whether one is to be written after so many steps.
    pub fn is_due(&self, done: u64) -> bool {
        match self.every {
            Interval::Steps(steps) => done.is_multiple_of(steps),
            Interval::Time(time) => self.written.elapsed() >= time,
        }
    }

    /// Writes one.
    ///
    /// # Errors
    /// If the file cannot be written, or the engine lost its state.
    pub fn write(&mut self, of: &Description, run: &Simulation) -> Result<(), CheckpointWriteError> {
        self.folder.write(of, run)?;
        self.written = Instant::now();
        Ok(())
    }
}
