//! Doing steps together, each in the wake of the previous one, does not change a bit. The reference engine,
//! which does one step after the other, gives the expected results.

use std::error::Error;
use std::num::{NonZeroU64, NonZeroUsize};
use xca_core::prelude::*;
use xca_core::{Parity, RunError, Snapshot};
use xca_cpu::Cpu;

type TestResult = Result<(), Box<dyn Error>>;

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Air {
    warmth: Real,
    moisture: [u32; 2],
    age: u32,
    seen: u32,
    luck: Real,
}

/// Another struct of the same cells.
#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Ground {
    wet: u32,
}

/// Writes to a second buffer.
#[elementary_process]
fn mix(cell: &mut Cell<Air>) {
    let mut sum = 0.0;
    for n in 1..cell.neighbour_count() {
        sum += cell.neighbour(n).warmth * 0.125;
    }
    cell.warmth = cell.warmth * 0.375 + sum;
    cell.moisture[0] =
        31 * (cell.moisture[0] % 1000) + cell.neighbour(cell.neighbour_count() - 1).moisture[1];
}

/// Writes in place what [`mix`] reads elsewhere.
#[elementary_process]
fn rain(cell: &mut Cell<Air>) {
    cell.moisture[1] = 7 * (cell.moisture[1] % 1000) + cell.moisture[0] % 13;
}

/// Writes in place what [`drink`] reads elsewhere.
#[elementary_process]
fn soak(ground: &mut Cell<Ground>, cell: &Cell<Air>) {
    ground.wet = 3 * (ground.wet % 10000) + cell.moisture[1] % 5;
}

/// Reads another struct elsewhere.
#[elementary_process]
fn drink(cell: &mut Cell<Air>, ground: &Cell<Ground>) {
    let mut sum = cell.seen % 1000;
    for n in 0..cell.neighbour_count() {
        sum = 5 * (sum % 1000) + ground.neighbour(n).wet % 11;
    }
    cell.seen = sum;
}

/// Draws, and requests the step.
#[elementary_process]
fn drift(cell: &mut Cell<Air>, space: &Space) {
    cell.luck = cell.luck * 0.5 + cell.random(0) + (space.step() as Real) * 0.001;
}

const TOO_OLD: u32 = 3;

/// Stops the run at a cell that is too old, sometimes by a division by zero.
#[elementary_process]
fn grow_old(cell: &mut Cell<Air>) {
    cell.age += 1;
    if cell.age >= 40 {
        if cell.seen % 16 == 5 {
            cell.seen = 1 / (cell.age - cell.age);
        }
        cell.fault(TOO_OLD, cell.warmth);
    }
}

/// A number below `below`, from the cell and `which`.
fn number(cell: [usize; 3], which: u32, below: u32) -> u32 {
    let mut mixed =
        cell.iter().fold(which, |mixed, index| mixed.wrapping_mul(977).wrapping_add(*index as u32));
    for factor in [0x7feb_352d_u32, 0x846c_a68b, 0x9e37_79b1] {
        mixed = (mixed ^ (mixed >> 15)).wrapping_mul(factor);
    }
    (mixed >> 8) % below
}

/// Weather whose cells have at most this age at the beginning.
fn weather(
    extents: [usize; 3],
    neighbourhood: Neighbourhood,
    boundaries: [Boundary; 3],
    oldest: u32,
) -> Result<Model, ModelError> {
    let mut builder = Model::builder("weather")
        .extents(extents)
        .neighbourhood(neighbourhood)
        .boundaries(boundaries)
        .substates::<Air>()
        .substates::<Ground>()
        .fault_text(TOO_OLD, "a cell is too old")
        .process((mix, grow_old, rain, soak))
        .process_every(3, drift)
        .process(drink)
        .fill(move |site| {
            let of = |which, below| number(site.cell(), which, below);
            let age = if of(1, 50) == 0 { oldest - of(2, 5).min(oldest) } else { 0 };
            let [warmth, luck] = [3, 4].map(|which| f64::from(of(which, 1000)));
            Air { warmth, moisture: [of(5, 90), of(6, 90)], age, seen: of(7, 9), luck }
        })
        .fill(|site| Ground { wet: number(site.cell(), 8, 50) });
    let beyond = Air { warmth: 9.0, moisture: [5, 6], age: 0, seen: 1, luck: 0.0 };
    if boundaries[1] == Boundary::Flat {
        builder = builder.outside(Face::South, beyond);
    }
    if boundaries[2] == Boundary::Flat {
        builder = builder.outside(Face::Top, Ground { wet: 77 });
    }
    builder.build()
}

const OPTIONS: RunOptions = RunOptions { precision: Precision::F32, seed: 7 };

/// The numbers of steps that have nothing between them.
const LEAPS: [u64; 5] = [1, 7, 2, 16, 5];

/// The snapshots after each leap, and the error that ends the run.
fn run(model: &Model, engine: &dyn Engine) -> Result<(Vec<Snapshot>, Option<RunError>), Box<dyn Error>> {
    let mut simulation = Simulation::new(model, engine, OPTIONS)?;
    let mut seen = Vec::new();
    for steps in LEAPS {
        if let Err(error) = simulation.run(steps) {
            return Ok((seen, Some(error)));
        }
        seen.push(simulation.snapshot()?);
    }
    Ok((seen, None))
}

/// An engine that does `steps` steps together if there is room, in columns of `rows` rows.
fn together(steps: u64, threads: usize, rows: usize) -> Result<Cpu, Box<dyn Error>> {
    let steps = NonZeroU64::new(steps).ok_or("no steps")?;
    let rows = NonZeroUsize::new(rows).ok_or("no rows")?;
    Ok(Cpu::with_threads(threads)?.without_tiles().with_stride(steps).with_columns(rows))
}

/// The mean number of steps that an engine does together.
fn mean_stride(model: &Model, engine: &dyn Engine) -> Result<f64, Box<dyn Error>> {
    let mut simulation = Simulation::new(model, engine, OPTIONS)?;
    simulation.run(30)?;
    let figures = simulation.figures();
    Ok(figures.iter().find(|figure| figure.name == "steps_together").map_or(1.0, |figure| figure.value))
}

fn spaces() -> Result<Vec<([usize; 3], Neighbourhood)>, xca_core::NeighbourhoodError> {
    Ok(vec![
        ([11, 60, 1], Neighbourhood::von_neumann_2d(1)),
        ([7, 90, 1], Neighbourhood::moore_2d(2)),
        ([5, 4, 50], Neighbourhood::moore(1)),
        ([33, 1, 1], Neighbourhood::custom(vec![[0; 3], [1, 0, 0], [-2, 0, 0]])?),
        ([5, 5, 40], Neighbourhood::von_neumann(2)),
        ([5, 14, 24], Neighbourhood::moore(1)),
        ([9, 64, 1], Neighbourhood::hexagonal(Hexagons::CornerUp)),
        ([8, 64, 1], Neighbourhood::hexagonal(Hexagons::SideUp)),
        ([7, 5, 60], Neighbourhood::custom(vec![[0, 0, 0], [3, 0, 0], [-1, 2, 0], [0, -1, 1]])?),
        ([4, 9, 30], Neighbourhood::custom(vec![[0, 0, 0], [1, 0, -1], [0, 0, 1]])?),
    ])
}

#[test]
fn steps_that_are_done_together_change_no_bit() -> TestResult {
    let rings = [Boundary::Toroidal; 3];
    let mixed = [Boundary::Toroidal, Boundary::Reflecting, Boundary::Flat];
    let turned = [Boundary::Flat, Boundary::Toroidal, Boundary::Reflecting];
    let partly = [Boundary::Flat, Boundary::Flat, Boundary::Toroidal];
    let (mut done_together, mut faults) = (0, 0);
    for (extents, neighbourhood) in spaces()? {
        for boundaries in [[Boundary::Flat; 3], rings, [Boundary::Reflecting; 3], mixed, turned, partly] {
            let reflects = boundaries.contains(&Boundary::Reflecting);
            if reflects && neighbourhood.parity() != Parity::None {
                continue;
            }
            for oldest in [0, 25] {
                let model = weather(extents, neighbourhood.clone(), boundaries, oldest)?;
                let (wanted, end) = run(&model, &Reference)?;
                faults += u32::from(end.is_some());
                for (steps, threads, rows) in [(2, 1, 1), (3, 2, 3), (5, 8, 2), (16, 3, 4)] {
                    let engine = together(steps, threads, rows)?;
                    let place = format!("{extents:?} {boundaries:?} {oldest} {steps} on {threads} by {rows}");
                    let (got, stopped) = run(&model, &engine)?;
                    assert_eq!(
                        stopped.map(|one| one.to_string()),
                        end.as_ref().map(RunError::to_string),
                        "{place}"
                    );
                    assert!(got == wanted, "{place}");
                    done_together += u32::from(oldest == 0 && mean_stride(&model, &engine)? > 1.5);
                }
            }
        }
    }
    // Not all of them, because some spaces are too small for a torus and that many steps.
    assert!(done_together > 100 && faults > 30, "{done_together} {faults}");
    Ok(())
}

/// The engine's choice depends on times, but the result does not.
#[test]
fn whatever_the_engine_finds_best_changes_no_bit() -> TestResult {
    let model = weather([40, 300, 1], Neighbourhood::moore_2d(1), [Boundary::Toroidal; 3], 0)?;
    let mut wanted = Simulation::new(&model, &Reference, OPTIONS)?;
    wanted.run(35)?;
    for threads in [1, 2] {
        let mut simulation = Simulation::new(&model, &Cpu::with_threads(threads)?.without_tiles(), OPTIONS)?;
        simulation.run(35)?;
        assert!(simulation.snapshot()? == wanted.snapshot()?);
    }
    Ok(())
}
