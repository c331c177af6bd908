//! An engine that is compared.

use std::time::Duration;
use xca_core::{Engine, Precision};

/// An engine that takes part.
#[derive(Debug)]
pub struct Contender {
    /// What the report calls it.
    pub name: String,
    /// The engine.
    pub engine: Box<dyn Engine>,
    /// What `Real` is.
    pub precision: Precision,
    /// What it took to make the engine.
    pub making: Duration,
}
