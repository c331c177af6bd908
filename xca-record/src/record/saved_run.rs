//! An earlier run, whose saved states are drawn.

use std::path::PathBuf;
use xca_core::Precision;

/// What a run has left, whose states are drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SavedRun {
    /// Its folder.
    pub folder: PathBuf,
    /// What `Real` was.
    pub precision: Precision,
    /// The step of its last state.
    pub last_step: u64,
}
