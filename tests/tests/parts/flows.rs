//! A flow in a corner of a large map, shared by parts whose bounds follow it.

use crate::moves::figure;
use crate::{TestResult, cpu};
use std::error::Error;
use xca_core::engine::Figure;
use xca_core::prelude::*;
use xca_examples::models::lava::{Lava, Rate, Vent, Volcano, model};
use xca_parts::{Balance, Grid, Parts};

const SIDE: usize = 240;
const STEPS: u64 = 420;

/// A plain that falls to the north-east, with a vent in the south-west.
fn volcano() -> Result<Model, ModelError> {
    let vent = Vent { cell: [50, 40, 0], rates: vec![Rate { from: 0.0, volume: 60.0 }] };
    let altitude = |site: Site| {
        let [x, y, _] = site.cell();
        Some(500.0 - 0.4 * (x + y) as f64 + 2.0 * site.random(0))
    };
    model([SIDE, SIDE], 10.0, Lava::default(), vec![vent], altitude)
}

/// The lava of each cell at the end, and the figures of the engine.
fn run(model: &Model, engine: &dyn Engine) -> Result<(Vec<f64>, Vec<Figure>), Box<dyn Error>> {
    let mut simulation = Simulation::new(model, engine, RunOptions::default())?;
    simulation.run(STEPS)?;
    Ok((simulation.state().read(Volcano::THICKNESS)?, simulation.figures()))
}

#[test]
fn a_flow_in_a_corner_is_shared() -> TestResult {
    let model = volcano()?;
    let parts = Parts::with_grid(cpu(1, 32)?, Grid { y: 2, z: 1 });
    let (even, figures) = run(&model, &parts.clone().with_balance(Balance::NEVER))?;
    let idle = figure(&figures, "imbalance")?;
    let (moved, figures) = run(&model, &parts.with_balance(Balance { cost: 4, ..Balance::default() }))?;
    let shared = figure(&figures, "imbalance")?;
    assert!(even == moved);
    assert!(even.iter().filter(|thickness| **thickness > 0.0).count() > 100);
    // One of two parts has nearly all of the work.
    assert!(idle > 1.8 && shared < 1.4, "{idle} and {shared}: {figures:?}");
    assert!((1.0..5.0).contains(&figure(&figures, "bounds_moved")?), "{figures:?}");
    Ok(())
}
