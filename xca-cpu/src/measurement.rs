//! The measurement of the motion of items.

use crate::blocks::blocks;
use crate::layout::Layout;
use crate::motion::Motion;
use crate::population::Population;
use rayon::prelude::*;
use xca_core::kernel::{self, STAY, Work};
use xca_core::{Geometry, StoredScalar};

impl Population {
    /// The largest distance in metres, along an axis, of an item from its cell. Measures the items if they
    /// have changed. To be called before the population is searched.
    pub(crate) fn slack(&mut self, layout: &Layout, geometry: &Geometry) -> f64 {
        self.searched = true;
        let motion = self.motion.unwrap_or_else(|| measure(self, layout, geometry));
        self.motion = Some(motion);
        motion.slack
    }
}

/// The measures of all items of a population.
fn measure(population: &Population, layout: &Layout, geometry: &Geometry) -> Motion {
    let blocks = blocks(layout, &[population], rayon::current_num_threads()).into_par_iter().with_max_len(1);
    let of_block = |rows: std::ops::Range<usize>| {
        rows.map(|row| {
            let (first, end) = population.row(row);
            let positions = population.position.map_or(&[][..], |field| {
                let size = population.types[field].size();
                &population.items.fields[field].bytes()[first * size..end * size]
            });
            measure_row(population, layout, geometry, row, positions, None)
        })
        .fold(Motion::NONE, Motion::and)
    };
    blocks.map(of_block).reduce(|| Motion::NONE, Motion::and)
}

/// The measures of the items of a row with these positions. With `answers` of a migration, the slack is that
/// of the staying items.
pub(crate) fn measure_row(
    population: &Population,
    layout: &Layout,
    geometry: &Geometry,
    row: usize,
    positions: &[u8],
    answers: Option<&[u32]>,
) -> Motion {
    let Some(field) = population.position else { return Motion::NONE };
    let frame = &Frame::new(population, layout, geometry, row, answers);
    let mut motion = Motion::NONE;
    match population.types[field].scalar {
        StoredScalar::F32 => {
            let positions: &[[f32; 3]] = bytemuck::cast_slice(positions);
            let position = |position: [f32; 3]| position.map(f64::from);
            kernel::run(Measurement { frame, positions, position, motion: &mut motion });
        }
        _ => {
            let positions: &[[f64; 3]] = bytemuck::cast_slice(positions);
            let position = |position: [f64; 3]| position;
            kernel::run(Measurement { frame, positions, position, motion: &mut motion });
        }
    }
    motion
}

/// A row, and the references of its items.
struct Frame<'a> {
    cells: &'a [u32],
    answers: Option<&'a [u32]>,
    references: &'a [[f32; 3]],
    first_cell: u32,
    side: f64,
    /// The lower corner along y and z.
    low: [f64; 2],
    drift: [f64; 3],
    /// The length of each toroidal axis. Infinite for other axes.
    periods: [f64; 3],
}

impl<'a> Frame<'a> {
    fn new(
        population: &'a Population,
        layout: &Layout,
        geometry: &Geometry,
        row: usize,
        answers: Option<&'a [u32]>,
    ) -> Self {
        let (first, end) = population.row(row);
        let [_, south, bottom] = layout.origin(row);
        let side = geometry.side();
        let (toroidal, extents) = (geometry.toroidal(), geometry.extents());
        let listed = population.lists.is_some();
        Self {
            cells: &population.items.cells[first..end],
            answers,
            references: if listed { &population.items.references[first..end] } else { &[] },
            first_cell: layout.linear(row) as u32,
            side,
            low: [south, bottom].map(|index| index as f64 * side),
            drift: population.lists.as_ref().map_or([0.0; 3], |lists| lists.drift),
            periods: std::array::from_fn(|axis| {
                if toroidal[axis] { extents[axis] as f64 * side } else { f64::INFINITY }
            }),
        }
    }

    /// The slack of the staying items. Only the distance along x depends on the cell of an item.
    #[inline(always)]
    fn slack<T: Copy>(&self, positions: &[T], position: impl Fn(T) -> [f64; 3]) -> f64 {
        let mut slack: f64 = 0.0;
        let [south, bottom] = self.low;
        let [north, top] = [south + self.side, bottom + self.side];
        for (number, (&place, &cell)) in positions.iter().zip(self.cells).enumerate() {
            let [x, y, z] = position(place);
            let west = f64::from(cell - self.first_cell) * self.side;
            let across = above(west - x, x - (west + self.side));
            let out = above(across, above(above(south - y, y - north), above(bottom - z, z - top)));
            let stays = self.answers.is_none_or(|answers| answers[number] == STAY || answers[number] == cell);
            slack = above(slack, if stays { out } else { 0.0 });
        }
        slack
    }

    #[inline(always)]
    fn moved<T: Copy>(&self, positions: &[T], position: impl Fn(T) -> [f64; 3], motion: &mut Motion) {
        let wraps = self.periods.iter().any(|period| period.is_finite());
        for (&place, reference) in positions.iter().zip(self.references) {
            let now = position(place);
            let mut moved: [f64; 3] =
                std::array::from_fn(|axis| now[axis] - f64::from(reference[axis]) - self.drift[axis]);
            if wraps {
                for (moved, period) in
                    moved.iter_mut().zip(self.periods).filter(|(_, period)| period.is_finite())
                {
                    *moved -= period * (*moved / period).round();
                }
            }
            for (moved, (low, high)) in moved.iter().zip(motion.low.iter_mut().zip(&mut motion.high)) {
                *low = -above(-*low, -moved);
                *high = above(*high, *moved);
            }
            let [x, y, z] = moved;
            motion.square = above(motion.square, x * x + y * y + z * z);
        }
    }

    #[inline(always)]
    fn measure<T: Copy>(&self, positions: &[T], position: impl Fn(T) -> [f64; 3] + Copy) -> Motion {
        let mut motion = Motion { slack: self.slack(positions, position), ..Motion::NONE };
        self.moved(positions, position, &mut motion);
        // Products with 0 are 0, except for NaN and infinities.
        let mut nothing = [0.0; 3];
        for &place in positions {
            let now = position(place);
            for axis in 0..3 {
                nothing[axis] += now[axis] * 0.0;
            }
        }
        if nothing != [0.0; 3] {
            motion.slack = f64::NAN;
            motion.square = f64::NAN;
        }
        motion
    }
}

/// The larger number. With NaN, either one.
#[inline(always)]
fn above(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The measurement of a row, compiled for the processor's instructions.
struct Measurement<'a, T, F> {
    frame: &'a Frame<'a>,
    positions: &'a [T],
    position: F,
    motion: &'a mut Motion,
}

impl<T: Copy, F: Fn(T) -> [f64; 3] + Copy> Work for Measurement<'_, T, F> {
    #[inline(always)]
    fn run(self) {
        *self.motion = self.frame.measure(self.positions, self.position);
    }
}
