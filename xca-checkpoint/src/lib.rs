//! Checkpoints: the complete state of a run in one file, for resuming it.
//!
//! The page `docs/checkpoints.md` describes the format byte by byte.

#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should"))]

mod checkpoint;
mod checkpoint_file;
mod checkpoints;
pub mod components;
mod description;
mod file;
mod folder;
mod identity;
mod input_file;
mod interval;
mod model_report;
mod numbers;
mod origin;
mod outputs;
mod planes;
mod recorded;

pub use checkpoint::Checkpoint;
pub use checkpoint_file::{CheckpointFile, ResumeError};
pub use checkpoints::Checkpoints;
pub use description::{Description, GroupShape, Kind};
pub use file::{CheckpointError, CheckpointWriteError};
pub use folder::{CHECKPOINTS, CheckpointFolder};
pub use identity::Identity;
pub use input_file::InputFile;
pub use interval::Interval;
pub use model_report::ModelReport;
pub use numbers::Exact;
pub use origin::{Difference, Origin, Parameter, other_model, other_program};
pub use outputs::Outputs;
pub use recorded::{Quantity, Recorded};

#[cfg(test)]
mod tests;
