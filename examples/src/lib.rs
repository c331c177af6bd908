//! One short program per model, in `src/bin`. `cargo run --release --bin life -- run` runs one of them.
//!
//! This library holds only what those programs read and is worth a test of its own.

#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should"))]

pub mod cadem_input;
pub mod models;
