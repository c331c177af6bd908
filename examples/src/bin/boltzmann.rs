//! Two shear layers of a fluid in a periodic box, which roll up into vortices (Minion and Brown, Journal of
//! Computational Physics 138, 1997).
use std::f64::consts::TAU;
use xca_examples::models::boltzmann::{Fluid, model};
use xca_run::prelude::*;

/// Cells along x and y.
const SIZE: usize = 80;

/// Speed of the layers, in cells a step.
const SPEED: f64 = 0.08;

/// The middle flows to the east, the rest to the west; a small wave along y disturbs them.
fn velocity(site: Site) -> Vector3<f64> {
    let [x, y, _] = site.cell().map(|index| (index as f64 + 0.5) / SIZE as f64);
    let along = (30.0 * (0.25 - (y - 0.5).abs())).tanh();
    Vector3::new(SPEED * along, 0.05 * SPEED * (TAU * x).sin(), 0.0)
}

fn main() -> ExitCode {
    xca_run::main_of!("boltzmann", "Shear layers by the lattice Boltzmann method in space", |_given| {
        let view = CellView::named("boltzmann").draw(Fluid::VELOCITY, "speed (cells a step)");
        Ok(SetUp::new(model([SIZE, SIZE, 3], 0.002, velocity)?, 1000).cells(view))
    })
}
