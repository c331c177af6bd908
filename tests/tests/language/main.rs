//! The Rust of a process on every engine, against the same functions run by Rust itself.

mod generics;
mod iterators;
mod loops;
mod methods;
mod tuples;

use std::error::Error;
use xca_core::Snapshot;
use xca_core::prelude::*;
use xca_tests::suite::engines::{self, assert_same_runs};

type TestResult = Result<(), Box<dyn Error>>;

/// Runs a model for a step on all engines, which must agree, and gives the state of the reference engine to
/// the test.
fn on_all_engines(
    model: &Model,
    precision: Precision,
    check: impl FnOnce(&mut Simulation) -> TestResult,
) -> TestResult {
    let options = RunOptions { precision, ..RunOptions::default() };
    let all = engines::all()?;
    assert_same_runs(model, engines::on_processors(&all), options, 1)?;
    // Which NaN an operation gives is nowhere defined.
    let after_a_step = |engine: &dyn Engine| -> Result<(Simulation, Snapshot), RunError> {
        let mut simulation = Simulation::new(model, engine, options)?;
        simulation.step()?;
        let snapshot = engines::with_one_nan(model, precision, simulation.snapshot()?);
        Ok((simulation, snapshot))
    };
    let (mut simulation, wanted) = after_a_step(&Reference)?;
    let (_, found) = after_a_step(&engines::gpu()?)?;
    engines::assert_same_state(&wanted, &found, &|| format!("`{}` on the gpu in {precision}", model.name()));
    check(&mut simulation)
}
