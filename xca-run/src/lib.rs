//! The program frame that every xca model's program shares.
//!
//! | module | holds |
//! |---|---|
//! | [`output`] | the files of a run: particles and time series as CSV, VTK files for ParaView, PNG pictures |
//! | [`progress`] | the line that shows how far a run has come, and the table at its end |
//! | [`interrupt`] | Ctrl-C and termination: the run ends after its current step |
//!
//! These three work on plain data (slices of numbers) and know nothing of models and engines.

#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should"))]

mod command;
mod engines;
pub mod interrupt;
mod machine;
mod numbers;
pub mod output;
mod program;
pub mod progress;
mod record;
mod report;
mod set_up;
mod terminal;
mod view;

pub use command::{ConfigError, main, main_of};
pub use engines::{EngineError, EngineName, MOST_THREADS};
pub use machine::{NotEnoughMemory, check_memory};
pub use program::{Assignment, Failure, Given, NoAssignment, Observable, Program};
pub use record::{FolderError, RecordError};
pub use set_up::SetUp;
pub use view::{CellView, ItemView, ViewError};

/// What a model's program needs: the words of [`xca_core::prelude`] and those of the frame.
pub mod prelude {
    pub use crate::output::picture::ColourMap;
    pub use crate::{CellView, Failure, Given, ItemView, Observable, Program, SetUp};
    pub use clap::{self, Args};
    pub use std::process::ExitCode;
    pub use xca_core::prelude::*;
}
