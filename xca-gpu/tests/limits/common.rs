//! Engines with handicaps, compared with the reference engine.

use std::error::Error;
use xca_core::Snapshot;
use xca_core::prelude::*;
use xca_gpu::{Arithmetic, Gpu, GpuError, GpuOptions, Handicap};

pub(crate) type TestResult = Result<(), Box<dyn Error>>;

/// The strict engine on an adapter made worse.
pub(crate) fn gpu(handicap: Handicap) -> Result<Gpu, GpuError> {
    Gpu::new(&GpuOptions { arithmetic: Arithmetic::Strict, handicap, ..GpuOptions::default() })
}

/// The state after so many steps, or what stops the run.
pub(crate) fn state_after(model: &Model, engine: &dyn Engine, steps: u64) -> Result<Snapshot, String> {
    let run = || {
        let mut simulation = Simulation::new(model, engine, RunOptions::default())?;
        simulation.run(steps)?;
        simulation.snapshot()
    };
    run().map_err(|error: RunError| error.to_string())
}

/// Demands that an engine gives the bits of the reference engine, or stops with the same words.
pub(crate) fn assert_agrees(model: &Model, engine: &dyn Engine, steps: u64) {
    let [wanted, found] = [&Reference as &dyn Engine, engine].map(|engine| state_after(model, engine, steps));
    match (wanted, found) {
        (Ok(wanted), Ok(found)) => {
            assert!(wanted.groups == found.groups, "`{}`: the states differ", model.name());
        }
        (Err(wanted), Err(found)) => assert_eq!(wanted, found),
        (wanted, found) => panic!("`{}`: {:?} and {:?}", model.name(), wanted.err(), found.err()),
    }
}
