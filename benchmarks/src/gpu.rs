//! The GPU engine against itself: where it works on all cells, and where it corrects the driver's division
//! and square root.

use crate::timing::{Times, interleaved};
use std::error::Error;
use std::fmt;
use xca_core::Precision;
use xca_core::engine::Figure;
use xca_core::prelude::*;
use xca_gpu::{Gpu, GpuOptions, Handicap};

/// The cells along each side of the model of operations.
const SIDE: usize = 512;
/// The operations of a cell in a step.
const OPERATIONS: u32 = 64;

/// A model on two engines that differ in one thing.
pub(crate) struct Cost {
    name: String,
    /// Of a step.
    own: Times,
    other: Times,
    /// Of all cells those that were worked on.
    share: Option<f64>,
    /// The operations of a step, if these are what is measured.
    operations: Option<usize>,
}

/// A landslide on the engine as it is, and working on all cells.
pub(crate) fn activity(model: &Model, rounds: usize, steps: u64) -> Result<Cost, Box<dyn Error>> {
    let all = Handicap { tiles: Some(usize::MAX), ..Handicap::default() };
    in_turns("landslide, all cells", model, Precision::F64, [Handicap::default(), all], (rounds, steps))
}

#[derive(Substates, Clone)]
struct Number {
    x: Real,
}

#[derive(Parameters, Clone, Debug)]
struct Constant {
    a: Real,
}

#[elementary_process]
fn divide(cell: &mut Cell<Number>, p: &Constant) {
    for _k in 0..OPERATIONS {
        cell.x = 1.0 + p.a / cell.x;
    }
}

#[elementary_process]
fn take_roots(cell: &mut Cell<Number>, p: &Constant) {
    for _k in 0..OPERATIONS {
        cell.x = (p.a + cell.x).sqrt();
    }
}

/// Divisions and square roots of the driver, and corrected ones.
pub(crate) fn corrections(rounds: usize, steps: u64) -> Result<Vec<Cost>, Box<dyn Error>> {
    let model = |name: &str| {
        Model::builder(name)
            .extents([SIDE, SIDE, 1])
            .substates::<Number>()
            .parameters(Constant { a: 2.0 })
            .fill(|site| Number { x: 1.0 + site.random(0) })
    };
    let models = [
        ("division, corrected", model("division").process(divide).build()?),
        ("square root, corrected", model("root").process(take_roots).build()?),
    ];
    // Values settle, so all cells must be worked on.
    let own = Handicap { tiles: Some(usize::MAX), ..Handicap::default() };
    let corrected = Handicap { corrected: true, ..own };
    let mut costs = Vec::new();
    for precision in [Precision::F32, Precision::F64] {
        for (name, model) in &models {
            let name = format!("{name}, {precision}");
            let cost = in_turns(&name, model, precision, [own, corrected], (rounds, steps))?;
            costs.push(Cost { operations: Some(SIDE * SIDE * OPERATIONS as usize), ..cost });
        }
    }
    Ok(costs)
}

/// Runs a model with both handicaps in turns. They must give the same bits.
fn in_turns(
    name: &str,
    model: &Model,
    precision: Precision,
    handicaps: [Handicap; 2],
    (rounds, steps): (usize, u64),
) -> Result<Cost, Box<dyn Error>> {
    let begin = |handicap| -> Result<Simulation, Box<dyn Error>> {
        let gpu = Gpu::new(&GpuOptions { handicap, ..GpuOptions::default() })?;
        Ok(Simulation::new(model, &gpu, RunOptions { precision, ..RunOptions::default() })?)
    };
    let [first, second] = handicaps;
    let [mut own, mut other] = [begin(first)?, begin(second)?];
    let [mut failure, mut other_failure] = [None, None];
    let times = interleaved(
        rounds,
        &mut [&mut || failure = own.run(steps).err().or(failure.take()), &mut || {
            other_failure = other.run(steps).err().or(other_failure.take());
        }],
    );
    failure.or(other_failure).map_or(Ok(()), Err)?;
    if own.snapshot()? != other.snapshot()? {
        return Err(format!("{name}: the results differ").into());
    }
    let is_share = |figure: &Figure| figure.name == "share_of_cells_worked_on";
    let share = own.figures().into_iter().find(is_share).map(|figure| figure.value);
    let [own, other] =
        <[Times; 2]>::try_from(times).map_err(|_| "two contenders")?.map(|times| times.per(steps as usize));
    Ok(Cost { name: name.to_owned(), own, other, share, operations: None })
}

impl fmt::Display for Cost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [own, other] = [&self.own, &self.other].map(|times| {
            let (low, high) = times.spread();
            format!("{:.3} ms a step ({:.3} to {:.3})", times.median() * 1e3, low * 1e3, high * 1e3)
        });
        let ratio = self.other.median() / self.own.median();
        write!(f, "{}: {other}, otherwise {own}; {ratio:.2} times as long", self.name)?;
        if let Some(share) = self.share {
            write!(f, "; {:.2} % of the cells worked on", share * 100.0)?;
        }
        if let Some(operations) = self.operations {
            let [own, other] = [&self.own, &self.other].map(|times| times.median() / operations as f64 * 1e9);
            write!(f, "; {other:.2} and {own:.2} ns an operation")?;
        }
        Ok(())
    }
}
