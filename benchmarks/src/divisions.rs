//! What divisions and square roots take on a GPU whose own are right, and corrected as if they were wrong.

use crate::timing::{Times, interleaved};
use std::error::Error;
use xca_core::prelude::*;
use xca_gpu::{Arithmetic, Gpu, GpuError, GpuOptions, Handicap};

/// How many operations of a cell follow each other.
const TURNS: usize = 32;
const CELLS: usize = 1 << 20;

#[derive(Substates, Clone, Copy)]
struct Fraction {
    numerator: Real,
    value: Real,
}

/// As many turns without the operation.
#[elementary_process]
fn multiply(cell: &mut Cell<Fraction>) {
    let mut value = cell.value;
    for _ in 0..32 {
        value = 1.0 + cell.numerator * value;
    }
    cell.value = value;
}

/// A continued fraction.
#[elementary_process]
fn divide(cell: &mut Cell<Fraction>) {
    let mut value = cell.value;
    for _ in 0..32 {
        value = 1.0 + cell.numerator / value;
    }
    cell.value = value;
}

#[elementary_process]
fn take_roots(cell: &mut Cell<Fraction>) {
    let mut value = cell.value;
    for _ in 0..32 {
        value = 1.0 + (cell.numerator * value).sqrt();
    }
    cell.value = value;
}

const NAMES: [&str; 3] = ["multiplication", "division", "square root"];

/// The time of an operation of a cell, as the adapter does it and corrected.
pub(crate) struct Cost {
    pub(crate) name: &'static str,
    pub(crate) own: Times,
    pub(crate) corrected: Times,
}

fn gpu(corrected: bool) -> Result<Gpu, GpuError> {
    let handicap = Handicap { corrected, ..Handicap::default() };
    Gpu::new(&GpuOptions { arithmetic: Arithmetic::Strict, handicap, ..GpuOptions::default() })
}

/// Both in turns. An error where the adapter's own divisions or roots are wrong, or where the results differ.
pub(crate) fn costs(precision: Precision, rounds: usize) -> Result<Vec<Cost>, Box<dyn Error>> {
    let model = Model::builder("fractions")
        .extents([CELLS, 1, 1])
        .substates::<Fraction>()
        .process(multiply)
        .process(divide)
        .process(take_roots)
        .fill(|site| Fraction { numerator: 0.1 + 0.8 * site.random(0), value: 1.0 + site.random(1) })
        .build()?;
    let engines = [gpu(false)?, gpu(true)?];
    let type_ = if precision == Precision::F32 { "f32" } else { "f64" };
    for operation in ["division", "square root"] {
        let name = format!("{operation} in {type_}");
        if engines[0].corrected().contains(&name) {
            return Err(format!("{name} is corrected on this adapter anyway").into());
        }
    }
    let start = |engine: &Gpu| Simulation::new(&model, engine, RunOptions { precision, seed: 0 });
    let [mut own, mut corrected] = [start(&engines[0])?, start(&engines[1])?];
    let mut costs = Vec::new();
    for (process, name) in NAMES.into_iter().enumerate() {
        let mut outcomes = [Ok(()), Ok(())];
        let [first, second] = &mut outcomes;
        let times = interleaved(
            rounds,
            &mut [&mut || *first = own.run_process(process), &mut || {
                *second = corrected.run_process(process);
            }],
        );
        outcomes.into_iter().collect::<Result<(), _>>()?;
        if own.snapshot()?.groups != corrected.snapshot()?.groups {
            return Err(format!("{name} in {type_}: the corrections change the result").into());
        }
        let [own, corrected] = <[Times; 2]>::try_from(times)
            .map_err(|_| "two contenders")?
            .map(|times| times.per(TURNS * CELLS));
        costs.push(Cost { name, own, corrected });
    }
    Ok(costs)
}
