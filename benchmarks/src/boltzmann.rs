//! The gallery's fluid (D3Q19) on the CPU engine against a loop written by hand: stream and collide in one pass.

use crate::comparison::Comparison;
use crate::timing::interleaved;
use rayon::prelude::*;
use std::error::Error;
use std::f64::consts::TAU;
use std::ops::{Div, Neg};
use xca_core::kernel::{Work, run};
use xca_core::prelude::*;
use xca_core::{Float, Precision};
use xca_cpu::Cpu;
use xca_examples::models::boltzmann;

const DIRECTIONS: usize = 19;

/// Cells that the loop by hand computes side by side.
const LANES: usize = 16;

const VISCOSITY: f64 = 0.1;

/// What the loop by hand computes with.
trait Number: Float + Div<Output = Self> + Neg<Output = Self> {}

impl Number for f32 {}
impl Number for f64 {}

/// The particles of cells side by side, by direction.
type Lanes<T> = [[T; LANES]; DIRECTIONS];

/// A periodic cube of fluid. Its planes, one a direction, have a halo of one cell.
struct Lattice<T> {
    size: usize,
    directions: Vec<[i32; 3]>,
    now: Vec<Vec<T>>,
    next: Vec<Vec<T>>,
}

impl<T: Number> Lattice<T> {
    /// A step: what moves in a direction comes from the opposite neighbour.
    fn step(&mut self, omega: T) {
        let (size, whole) = (self.size, self.size + 2);
        let mut layers: Vec<Vec<&mut [T]>> = (0..whole).map(|_| Vec::new()).collect();
        for plane in &mut self.next {
            for (layer, part) in layers.iter_mut().zip(plane.chunks_mut(whole * whole)) {
                layer.push(part);
            }
        }
        let (now, directions) = (&self.now, &self.directions);
        layers.par_iter_mut().enumerate().skip(1).take(size).for_each(|(z, to)| {
            for y in 1..=size {
                let first = |n: usize| {
                    let [dx, dy, dz] = directions[n].map(|along| along as isize);
                    let (x, y, z) = (1 - dx, y as isize - dy, z as isize - dz);
                    ((z * whole as isize + y) * whole as isize + x) as usize
                };
                let from: [&[T]; DIRECTIONS] = std::array::from_fn(|n| &now[n][first(n)..first(n) + size]);
                run(FluidRow { from, to, here: y * whole + 1, size, omega });
            }
        });
        drop(layers);
        std::mem::swap(&mut self.now, &mut self.next);
        self.now.par_iter_mut().for_each(|plane| wrap(plane, size));
    }
}

/// A row of fluid, compiled for the same processors as the engine's kernels.
struct FluidRow<'a, 'b, T> {
    from: [&'a [T]; DIRECTIONS],
    to: &'a mut [&'b mut [T]],
    /// Where the row begins in the layers that are written.
    here: usize,
    size: usize,
    omega: T,
}

impl<T: Number> Work for FluidRow<'_, '_, T> {
    #[inline(always)]
    fn run(self) {
        let Self { from, to, here, size, omega } = self;
        for begin in (0..size).step_by(LANES) {
            let count = LANES.min(size - begin);
            let mut f: Lanes<T> = [[T::from_f64(1.0); LANES]; DIRECTIONS];
            for (f, from) in f.iter_mut().zip(from) {
                f[..count].copy_from_slice(&from[begin..begin + count]);
            }
            collide(&mut f, omega);
            for (f, to) in f.iter().zip(&mut *to) {
                to[here + begin..][..count].copy_from_slice(&f[..count]);
            }
        }
    }
}

/// Fills the halo of a plane from the opposite side.
fn wrap<T: Copy>(plane: &mut [T], size: usize) {
    let whole = size + 2;
    let layer = whole * whole;
    for row in plane.chunks_mut(whole) {
        row[0] = row[size];
        row[size + 1] = row[1];
    }
    for layer in plane.chunks_mut(layer) {
        layer.copy_within(size * whole..(size + 1) * whole, 0);
        layer.copy_within(whole..2 * whole, (size + 1) * whole);
    }
    plane.copy_within(size * layer..(size + 1) * layer, 0);
    plane.copy_within(layer..2 * layer, (size + 1) * layer);
}

/// Relaxes towards equilibrium. Directions are numbered as in the model: their opposites add up to 19.
#[inline(always)]
fn collide<T: Number>(f: &mut Lanes<T>, omega: T) {
    let number = T::from_f64;
    for lane in 0..LANES {
        let at = |n: usize| f[n][lane];
        let mut density = at(0);
        for n in 1..DIRECTIONS {
            density = density + at(n);
        }
        let part = number(1.0) / density;
        let x = (at(4) + at(8) + at(10) + at(13) + at(17) - at(2) - at(6) - at(9) - at(11) - at(15)) * part;
        let y = (at(5) + at(11) + at(12) + at(13) + at(18) - at(1) - at(6) - at(7) - at(8) - at(14)) * part;
        let z = (at(14) + at(15) + at(16) + at(17) + at(18) - at(1) - at(2) - at(3) - at(4) - at(5)) * part;
        let base = number(1.0) - number(1.5) * (x * x + y * y + z * z);
        let relaxed = omega * density;
        let rest = relaxed * number(1.0 / 3.0);
        f[0][lane] = (number(1.0) - omega) * f[0][lane] + rest * base;
        let straight = [(16, z), (12, y), (10, x)];
        let oblique = [(18, y + z), (17, x + z), (15, z - x), (14, z - y), (13, x + y), (11, y - x)];
        for (n, along) in straight {
            relax(f, lane, n, omega, relaxed * number(1.0 / 18.0), base, number(3.0) * along);
        }
        for (n, along) in oblique {
            relax(f, lane, n, omega, relaxed * number(1.0 / 36.0), base, number(3.0) * along);
        }
    }
}

/// Relaxes what moves in a direction and in the opposite one.
#[inline(always)]
fn relax<T: Number>(f: &mut Lanes<T>, lane: usize, n: usize, omega: T, weight: T, base: T, along: T) {
    let keep = T::from_f64(1.0) - omega;
    let even = base + T::from_f64(0.5) * along * along;
    f[n][lane] = keep * f[n][lane] + weight * (even + along);
    f[DIRECTIONS - n][lane] = keep * f[DIRECTIONS - n][lane] + weight * (even - along);
}

/// A shear wave: velocity along x that changes along z.
fn wave(size: usize, z: usize) -> Vector3<f64> {
    Vector3::new(0.05 * (TAU * z as f64 / size as f64).sin(), 0.0, 0.0)
}

/// Fluid in a periodic cube of `size` cells along each side, in one precision.
pub(crate) fn fluid(
    size: usize,
    precision: Precision,
    threads: usize,
    rounds: usize,
    steps: usize,
) -> Result<Comparison, Box<dyn Error>> {
    match precision {
        Precision::F32 => fluid_of::<f32>(size, threads, rounds, steps),
        Precision::F64 => fluid_of::<f64>(size, threads, rounds, steps),
    }
}

fn fluid_of<T: Number>(
    size: usize,
    threads: usize,
    rounds: usize,
    steps: usize,
) -> Result<Comparison, Box<dyn Error>> {
    let model = boltzmann::model([size; 3], VISCOSITY, move |site| wave(size, site.cell()[2]))
        .map_err(|error| error.to_string())?;
    let options = RunOptions { precision: T::PRECISION, ..RunOptions::default() };
    let mut simulation = Simulation::new(&model, &Cpu::with_threads(threads)?, options)?;
    let whole = size + 2;
    let directions = boltzmann::neighbourhood()?.displacements([0; 3]).to_vec();
    let mut now = vec![vec![T::default(); whole.pow(3)]; DIRECTIONS];
    for (cell, f) in simulation.state().read(boltzmann::Fluid::F)?.iter().enumerate() {
        let [x, y, z] = [cell % size, cell / size % size, cell / size / size];
        for (plane, value) in now.iter_mut().zip(f) {
            plane[((z + 1) * whole + y + 1) * whole + x + 1] = T::from_f64(*value);
        }
    }
    now.iter_mut().for_each(|plane| wrap(plane, size));
    let mut lattice = Lattice { size, directions, next: now.clone(), now };
    let omega = T::from_f64(1.0 / (3.0 * VISCOSITY + 0.5));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    let mut failure = None;
    let times = interleaved(
        rounds,
        &mut [&mut || failure = simulation.run(steps as u64).err().or(failure.take()), &mut || {
            pool.install(|| (0..steps).for_each(|_| lattice.step(omega)));
        }],
    );
    failure.map_or(Ok(()), Err)?;
    // The two add in other orders, so they agree but for rounding.
    let cell = [0, 0, size / 4];
    let f = simulation.state().get(boltzmann::Fluid::F, cell)?;
    let place = ((cell[2] + 1) * whole + cell[1] + 1) * whole + cell[0] + 1;
    let far = f.iter().zip(&lattice.now).map(|(f, plane)| (f - plane[place].to_f64()).abs());
    if !far.fold(0.0, f64::max).lt(&1e-4) {
        return Err("the engine and the loop by hand differ".into());
    }
    let name = format!("D3Q19 {size}^3, {}", T::PRECISION);
    Comparison::new(name, size.pow(3), steps, times)
}
