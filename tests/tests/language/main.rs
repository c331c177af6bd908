//! The Rust of a process on every engine, against the same functions run by Rust itself.

mod loops;

use std::error::Error;
use xca_core::prelude::*;
use xca_tests::suite::engines::{self, assert_same_runs};

type TestResult = Result<(), Box<dyn Error>>;

/// Runs a model for a step on all engines, which must agree, and gives the state of the reference engine to the test.
fn on_all_engines(
    model: &Model,
    precision: Precision,
    check: impl FnOnce(&mut Simulation) -> TestResult,
) -> TestResult {
    let options = RunOptions { precision, ..RunOptions::default() };
    assert_same_runs(model, &engines::all()?, options, 1)?;
    let mut simulation = Simulation::new(model, &Reference, options)?;
    simulation.step()?;
    check(&mut simulation)
}
