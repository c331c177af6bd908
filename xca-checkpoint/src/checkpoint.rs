//! A run at some step, with its whole state.

use crate::file;
use crate::{CheckpointWriteError, Description};
use std::path::Path;
use xca_core::Snapshot;

/// A run at some step.
#[derive(Debug, Clone)]
pub struct Checkpoint {
    /// The description in the file.
    pub description: Description,
    /// The state.
    pub snapshot: Snapshot,
}

impl Checkpoint {
    /// Writes the file. Overwrites an earlier one.
    pub fn write(&self, path: &Path) -> Result<(), CheckpointWriteError> {
        file::write(path, &self.description, &self.snapshot)
    }
}
