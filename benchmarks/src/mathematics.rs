//! What a call of a mathematical function takes.

use crate::timing::{Times, interleaved};
use std::error::Error;
use xca_core::math::{atan, atan2, cos, exp, log, pow, sin, tan, tanh};
use xca_core::prelude::*;
use xca_cpu::Cpu;

/// An argument, which stays, and the value of a function of it.
#[derive(Substates, Clone, Copy)]
struct Values {
    x: Real,
    result: Real,
}

#[elementary_process]
fn nothing(cell: &mut Cell<Values>) {
    cell.result = cell.x;
}

#[elementary_process]
fn square_root(cell: &mut Cell<Values>) {
    cell.result = cell.x.sqrt();
}

#[elementary_process]
fn exponential(cell: &mut Cell<Values>) {
    cell.result = exp(cell.x);
}

#[elementary_process]
fn logarithm(cell: &mut Cell<Values>) {
    cell.result = log(cell.x);
}

#[elementary_process]
fn power(cell: &mut Cell<Values>) {
    cell.result = pow(cell.x, 1.7);
}

#[elementary_process]
fn sine(cell: &mut Cell<Values>) {
    cell.result = sin(cell.x);
}

#[elementary_process]
fn cosine(cell: &mut Cell<Values>) {
    cell.result = cos(cell.x);
}

#[elementary_process]
fn tangent(cell: &mut Cell<Values>) {
    cell.result = tan(cell.x);
}

#[elementary_process]
fn angle(cell: &mut Cell<Values>) {
    cell.result = atan(cell.x);
}

#[elementary_process]
fn direction(cell: &mut Cell<Values>) {
    cell.result = atan2(cell.x, 3.0);
}

#[elementary_process]
fn hyperbolic_tangent(cell: &mut Cell<Values>) {
    cell.result = tanh(cell.x);
}

const NAMES: [&str; 11] = ["copy", "sqrt", "exp", "log", "pow", "sin", "cos", "tan", "atan", "atan2", "tanh"];

/// The time of a step of each process for one cell, on one thread; the arguments are evenly spread over 0
/// to 10.
pub(crate) fn costs(
    precision: Precision,
    rounds: usize,
) -> Result<Vec<(&'static str, Times)>, Box<dyn Error>> {
    const CELLS: usize = 1 << 16;
    let model = Model::builder("functions")
        .extents([CELLS, 1, 1])
        .substates::<Values>()
        .process(nothing)
        .process(square_root)
        .process(exponential)
        .process(logarithm)
        .process(power)
        .process(sine)
        .process(cosine)
        .process(tangent)
        .process(angle)
        .process(direction)
        .process(hyperbolic_tangent)
        .fill(|site| {
            let [index, ..] = site.cell();
            // Neighbouring cells have arguments far apart, so that branches cannot be guessed.
            let spread = (index * 40_503) % CELLS;
            Values { x: (spread as f64 + 0.5) * 10.0 / CELLS as f64, result: 0.0 }
        })
        .build()?;
    let engine = Cpu::with_threads(1)?;
    let mut simulation = Simulation::new(&model, &engine, RunOptions { precision, ..RunOptions::default() })?;
    let mut costs = Vec::new();
    for (process, name) in NAMES.into_iter().enumerate() {
        let mut outcome = Ok(());
        let mut run = || {
            for _ in 0..10 {
                if let Err(error) = simulation.run_process(process) {
                    outcome = Err(error);
                }
            }
        };
        let times = interleaved(rounds, &mut [&mut run]).remove(0).per(10 * CELLS);
        outcome?;
        costs.push((name, times));
    }
    Ok(costs)
}
