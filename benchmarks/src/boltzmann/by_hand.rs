//! A fused loop: stream and collide in one pass, in opposite directions together.

use rayon::prelude::*;
use std::ops::{Div, Neg};
use xca_core::Float;
use xca_core::kernel::{Work, run};
use xca_examples::models::boltzmann::DIRECTIONS;

/// Cells that are computed side by side.
const LANES: usize = 16;

/// What the loop by hand computes with.
pub(crate) trait Number: Float + Div<Output = Self> + Neg<Output = Self> {}

impl Number for f32 {}
impl Number for f64 {}

/// The particles of cells side by side, by direction.
type Lanes<T> = [[T; LANES]; DIRECTIONS];

/// A periodic cube of fluid. Its planes, one a direction, have a halo of one cell.
pub(crate) struct Lattice<T> {
    size: usize,
    directions: Vec<[i32; 3]>,
    now: Vec<Vec<T>>,
    next: Vec<Vec<T>>,
}

impl<T: Number> Lattice<T> {
    /// From the particles of each cell, with x fastest.
    pub(crate) fn new(size: usize, directions: Vec<[i32; 3]>, particles: &[[f64; DIRECTIONS]]) -> Self {
        let mut now = vec![vec![T::default(); (size + 2).pow(3)]; DIRECTIONS];
        for (cell, f) in particles.iter().enumerate() {
            let place = place(size, [cell % size, cell / size % size, cell / size / size]);
            for (plane, value) in now.iter_mut().zip(f) {
                plane[place] = T::from_f64(*value);
            }
        }
        now.iter_mut().for_each(|plane| wrap(plane, size));
        Self { size, directions, next: now.clone(), now }
    }

    /// The particles of a cell.
    pub(crate) fn particles(&self, cell: [usize; 3]) -> [f64; DIRECTIONS] {
        let place = place(self.size, cell);
        std::array::from_fn(|n| self.now[n][place].to_f64())
    }

    /// A step: what moves in a direction comes from the opposite neighbour.
    pub(crate) fn step(&mut self, omega: T) {
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

/// Where a cell stands in a plane.
fn place(size: usize, [x, y, z]: [usize; 3]) -> usize {
    ((z + 1) * (size + 2) + y + 1) * (size + 2) + x + 1
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
