//! What the tests of all models share.

use xca_core::prelude::*;
use xca_cpu::Cpu;
use xca_tests::suite::engines::{self, PRECISIONS};

/// Runs the model for some steps on every engine in both precisions, and demands equal bits.
pub(crate) fn assert_same_bits(model: &Model, steps: u64) {
    let engines = engines::all().unwrap();
    for precision in PRECISIONS {
        let options = RunOptions { precision, seed: 7 };
        engines::assert_same_runs(model, &engines, options, steps).unwrap();
    }
}

/// The model on all cores, after so many steps.
pub(crate) fn run(model: &Model, seed: u64, steps: u64) -> Simulation {
    let options = RunOptions { seed, ..RunOptions::default() };
    let mut simulation = Simulation::new(model, &Cpu::new().unwrap(), options).unwrap();
    simulation.run(steps).unwrap();
    simulation
}
