//! When checkpoints are written.

use crate::interval::Interval;
use crate::record::RunFolder;
use std::path::Path;
use std::time::Instant;
use xca_checkpoint::{CheckpointFolder, CheckpointWriteError, Description};
use xca_core::Simulation;
use xca_io::atomic::WriteError;

/// The checkpoints of a run.
#[derive(Debug)]
pub(crate) struct Checkpoints {
    every: Interval,
    folder: CheckpointFolder,
    written: Instant,
}

impl Checkpoints {
    /// Those of a run, which may have been resumed from one of them.
    pub(crate) fn new(every: Interval, folder: &RunFolder, from: Option<&Path>) -> Result<Self, WriteError> {
        Ok(Self { every, folder: CheckpointFolder::create(&folder.top, from)?, written: Instant::now() })
    }

    /// The step of the next one, where that is known.
    pub(super) fn next(&self, done: u64) -> u64 {
        match self.every {
            Interval::Steps(steps) => (done / steps + 1).saturating_mul(steps),
            Interval::Time(_) => u64::MAX,
        }
    }

    pub(super) fn is_due(&self, done: u64) -> bool {
        match self.every {
            Interval::Steps(steps) => done.is_multiple_of(steps),
            Interval::Time(time) => self.written.elapsed() >= time,
        }
    }

    pub(super) fn write(&mut self, of: &Description, run: &Simulation) -> Result<(), CheckpointWriteError> {
        self.folder.write(of, run)?;
        self.written = Instant::now();
        Ok(())
    }
}
