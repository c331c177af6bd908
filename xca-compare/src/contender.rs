//! An engine in a comparison.

use std::time::Duration;
use xca_core::{Engine, Precision};

/// An engine in a comparison.
#[derive(Debug)]
pub struct Contender {
    /// The name in the report.
    pub name: String,
    /// The engine.
    pub engine: Box<dyn Engine>,
    /// The type that `Real` stands for.
    pub precision: Precision,
    /// The time it took to create the engine.
    pub making: Duration,
}
