//! Heat and Life on the CPU engine against loops written by hand with rayon.

use crate::comparison::Comparison;
use crate::timing::interleaved;
use rayon::prelude::*;
use std::error::Error;
use std::num::NonZeroU64;
use xca_core::kernel::{Work, run};
use xca_core::prelude::*;
use xca_core::{Outcome, RunError};
use xca_cpu::Cpu;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
}

#[derive(Parameters, Clone, Debug)]
struct Conduction {
    alpha: Real,
}

#[elementary_process]
fn diffuse(cell: &mut Cell<Heat>, p: &Conduction) {
    let mut flux = 0.0;
    for n in 1..cell.neighbour_count() {
        flux += cell.neighbour(n).temperature - cell.temperature;
    }
    cell.temperature += p.alpha * flux;
}

#[derive(Substates, Clone, Copy)]
struct Life {
    alive: u8,
}

#[elementary_process]
fn evolve(cell: &mut Cell<Life>) {
    let mut count = 0;
    for n in 1..cell.neighbour_count() {
        count += cell.neighbour(n).alive;
    }
    cell.alive = if count == 3 || (count == 2 && cell.alive == 1) { 1 } else { 0 };
}

const ALPHA: f64 = 0.1;

/// A step of heat, written by hand: planes with a halo of one, the row as the inner loop.
fn heat_by_hand(size: usize, old: &[f64], new: &mut [f64]) {
    let line = size + 2;
    let layer = line * line;
    new.par_chunks_mut(layer).enumerate().skip(1).take(size).for_each(|(z, new)| {
        for y in 1..=size {
            let at = z * layer + y * line + 1;
            let sides =
                [at - layer, at - line, at - 1, at + 1, at + line, at + layer].map(|at| &old[at..at + size]);
            let out = &mut new[y * line + 1..y * line + 1 + size];
            run(HeatRow { centre: &old[at..at + size], sides, out });
        }
    });
}

/// A row of heat, compiled for the same processors as the engine's kernels.
struct HeatRow<'a> {
    centre: &'a [f64],
    sides: [&'a [f64]; 6],
    out: &'a mut [f64],
}

impl Work for HeatRow<'_> {
    #[inline(always)]
    fn run(self) {
        heat_row(self.centre, self.sides, self.out);
    }
}

#[inline(always)]
fn heat_row(centre: &[f64], sides: [&[f64]; 6], out: &mut [f64]) {
    let size = out.len();
    let (centre, sides) = (&centre[..size], sides.map(|side| &side[..size]));
    for x in 0..size {
        let mut flux = 0.0;
        for side in sides {
            flux += side[x] - centre[x];
        }
        out[x] = centre[x] + ALPHA * flux;
    }
}

/// A step of Life on a torus, written by hand in the same way; the halo is filled first.
fn life_by_hand(size: usize, old: &mut [u8], new: &mut [u8]) {
    let line = size + 2;
    for y in 1..=size {
        old[y * line] = old[y * line + size];
        old[y * line + size + 1] = old[y * line + 1];
    }
    old.copy_within(size * line..(size + 1) * line, 0);
    old.copy_within(line..2 * line, (size + 1) * line);
    let old = &*old;
    new.par_chunks_mut(line).enumerate().skip(1).take(size).for_each(|(y, new)| {
        let rows = [y - 1, y, y + 1].map(|y| &old[y * line..(y + 1) * line]);
        run(LifeRow { rows, out: &mut new[1..1 + size] });
    });
}

/// A row of Life with those below and above it, halo included.
struct LifeRow<'a> {
    rows: [&'a [u8]; 3],
    out: &'a mut [u8],
}

impl Work for LifeRow<'_> {
    #[inline(always)]
    fn run(self) {
        life_row(self.rows, self.out);
    }
}

#[inline(always)]
fn life_row(rows: [&[u8]; 3], out: &mut [u8]) {
    let size = out.len();
    let [[a, b, c], [d, here, e], [f, g, h]] = rows.map(|row| [0, 1, 2].map(|x| &row[x..x + size]));
    for x in 0..size {
        let count = a[x] + b[x] + c[x] + d[x] + e[x] + f[x] + g[x] + h[x];
        out[x] = u8::from((count == 3) | ((count == 2) & (here[x] == 1)));
    }
}

fn heat_at([x, y, z]: [usize; 3]) -> f64 {
    ((x * 31 + y * 17 + z * 7) % 101) as f64
}

/// Three cells in ten are alive. It stays active nearly everywhere.
pub(crate) fn soup([x, y, _]: [usize; 3]) -> u8 {
    let mut mixed = (y as u32).wrapping_mul(0x9e37_79b9) ^ x as u32;
    for factor in [0x7feb_352d, 0x846c_a68b] {
        mixed = (mixed ^ (mixed >> 15)).wrapping_mul(factor);
    }
    u8::from((mixed >> 8) % 10 < 3)
}

/// Heat in a cube of `size` cells along each side.
pub(crate) fn heat_model(size: usize) -> Result<Model, ModelError> {
    Model::builder("heat")
        .extents([size; 3])
        .neighbourhood(Neighbourhood::von_neumann(1))
        .substates::<Heat>()
        .parameters(Conduction { alpha: ALPHA })
        .process(diffuse)
        .fill(move |site| Heat { temperature: heat_at(site.cell()) })
        .build()
}

/// Life on a square torus of `size` cells along each side.
pub(crate) fn life_model(size: usize) -> Result<Model, ModelError> {
    life_from(size, soup)
}

/// The same from other beginnings: 1 where a cell is alive.
pub(crate) fn life_from(
    size: usize,
    alive: impl Fn([usize; 3]) -> u8 + Send + Sync + 'static,
) -> Result<Model, ModelError> {
    Model::builder("life")
        .extents([size, size, 1])
        .neighbourhood(Neighbourhood::moore_2d(1))
        .boundaries([Boundary::Toroidal, Boundary::Toroidal, Boundary::Flat])
        .substates::<Life>()
        .process(evolve)
        .fill(move |site| Life { alive: alive(site.cell()) })
        .build()
}

/// Heat in a cube of `size` cells along each side, in f64.
pub(crate) fn heat(
    size: usize,
    threads: usize,
    rounds: usize,
    steps: usize,
) -> Result<Comparison, Box<dyn Error>> {
    let model = heat_model(size)?;
    let engine = Cpu::with_threads(threads)?;
    let mut simulation = Simulation::new(&model, &engine, RunOptions::default())?;
    let mut step_by_step =
        Simulation::new(&model, &engine.with_stride(NonZeroU64::MIN), RunOptions::default())?;
    let line = size + 2;
    let mut old = vec![0.0; line * line * line];
    for z in 0..size {
        for y in 0..size {
            for x in 0..size {
                old[((z + 1) * line + y + 1) * line + x + 1] = heat_at([x, y, z]);
            }
        }
    }
    let mut new = old.clone();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    let failure = std::cell::Cell::new(None);
    let ended = |result: Result<Outcome, RunError>| failure.set(result.err().or(failure.take()));
    let times = interleaved(
        rounds,
        &mut [
            &mut || ended(simulation.run(steps as u64)),
            &mut || {
                pool.install(|| {
                    for _ in 0..steps {
                        heat_by_hand(size, &old, &mut new);
                        std::mem::swap(&mut old, &mut new);
                    }
                });
            },
            &mut || ended(step_by_step.run(steps as u64)),
        ],
    );
    failure.take().map_or(Ok(()), Err)?;
    let cell = size / 2;
    let by_hand = old[((cell + 1) * line + cell + 1) * line + cell + 1];
    if simulation.state().get(Heat::TEMPERATURE, [cell; 3])? != by_hand {
        return Err("the engine and the loop by hand differ".into());
    }
    let bytes = 2 * size_of::<f64>();
    let comparison = Comparison::new(format!("heat {size}^3, f64"), size * size * size, bytes, steps, times)?;
    Ok(comparison.with_figures(&simulation.figures()))
}

/// Life on a square torus of `size` cells along each side.
pub(crate) fn life(
    size: usize,
    threads: usize,
    rounds: usize,
    steps: usize,
) -> Result<Comparison, Box<dyn Error>> {
    let model = life_model(size)?;
    let engine = Cpu::with_threads(threads)?;
    let mut simulation = Simulation::new(&model, &engine, RunOptions::default())?;
    let mut step_by_step =
        Simulation::new(&model, &engine.with_stride(NonZeroU64::MIN), RunOptions::default())?;
    let line = size + 2;
    let mut old = vec![0_u8; line * line];
    for y in 0..size {
        for x in 0..size {
            old[(y + 1) * line + x + 1] = soup([x, y, 0]);
        }
    }
    let mut new = old.clone();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    let failure = std::cell::Cell::new(None);
    let ended = |result: Result<Outcome, RunError>| failure.set(result.err().or(failure.take()));
    let times = interleaved(
        rounds,
        &mut [
            &mut || ended(simulation.run(steps as u64)),
            &mut || {
                pool.install(|| {
                    for _ in 0..steps {
                        life_by_hand(size, &mut old, &mut new);
                        std::mem::swap(&mut old, &mut new);
                    }
                });
            },
            &mut || ended(step_by_step.run(steps as u64)),
        ],
    );
    failure.take().map_or(Ok(()), Err)?;
    let alive: i64 =
        old.chunks(line).skip(1).take(size).flat_map(|row| &row[1..=size]).map(|&cell| i64::from(cell)).sum();
    if simulation.state().sum(Life::ALIVE)? != alive {
        return Err("the engine and the loop by hand differ".into());
    }
    let comparison = Comparison::new(format!("life {size}^2"), size * size, 2, steps, times)?;
    Ok(comparison.with_figures(&simulation.figures()))
}
