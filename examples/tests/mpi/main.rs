//! Programs under `mpirun`: the files of one machine, byte by byte, and an end whatever happens.
//!
//! There may be more processes than cores here, so nothing is said about times.
#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should")]

mod ends;
mod launched;
mod misuse;
#[path = "../programs/running.rs"]
#[allow(dead_code, reason = "other tests need more of it")]
mod running;
mod same_files;
