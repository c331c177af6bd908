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

pub mod interrupt;
mod numbers;
pub mod output;
pub mod progress;
