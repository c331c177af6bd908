//! Checkpoints: the complete state of a run in one file, for resuming it.
//!
//! The page `docs/checkpoints.md` describes the format byte by byte.

#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should"))]

mod checkpoint_file;
pub mod components;
mod description;
mod file;
mod folder;
mod identity;
mod input_file;
mod model_report;
mod numbers;
mod origin;
mod outputs;
mod planes;
mod recorded;

pub use checkpoint_file::{CheckpointFile, ResumeError};
pub use description::{Description, GroupShape, Kind};
pub use file::{CheckpointError, CheckpointWriteError};
pub use folder::{CHECKPOINTS, CheckpointFolder};
pub use identity::Identity;
pub use input_file::InputFile;
pub use model_report::ModelReport;
pub use numbers::Exact;
pub use origin::{Difference, Origin, Parameter, other_model, other_program};
pub use outputs::Outputs;
pub use recorded::{Quantity, Recorded};

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

    /// Reads a file. A damaged file is an error.
    pub fn read(path: &Path) -> Result<Self, CheckpointError> {
        CheckpointFile::open(path)?.read()
    }
}

#[cfg(test)]
mod tests;
