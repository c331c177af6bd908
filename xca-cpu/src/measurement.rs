//! The measurement of the motion of items.

use crate::blocks::blocks;
use crate::layout::Layout;
use crate::motion::{Motion, moves};
use crate::population::Population;
use rayon::prelude::*;
use xca_core::kernel::{self, Work};
use xca_core::{Geometry, StoredScalar};

impl Population {
    /// The largest distance in metres, along an axis, of an item from its cell. Measures the items if they
    /// have changed. To be called before the population is searched.
    pub(crate) fn slack(&mut self, layout: &Layout, geometry: &Geometry) -> f64 {
        self.searched = true;
        if let Some(motion) = self.motion {
            return motion.slack;
        }
        let motion = self.measure(layout, geometry);
        if let Some(lists) = &mut self.lists {
            // A distance has changed at most by its change until the last measure, undone, and its change
            // until now.
            lists.travelled += lists.approach + motion.approach();
            lists.measured(&motion);
        }
        self.motion = Some(motion);
        motion.slack
    }

    /// The measures of all items, with the displacements since lists were made.
    pub(crate) fn measure(&self, layout: &Layout, geometry: &Geometry) -> Motion {
        let blocks = blocks(layout, &[self], rayon::current_num_threads()).into_par_iter().with_max_len(1);
        let of_block = |rows: std::ops::Range<usize>| {
            rows.map(|row| {
                let (first, end) = self.row(row);
                let positions = self.position.map_or(&[][..], |field| {
                    let size = self.types[field].size();
                    &self.items.fields[field].bytes()[first * size..end * size]
                });
                measure_row(self, layout, geometry, row, positions, Since::Lists, None)
            })
            .fold(Motion::NONE, Motion::and)
        };
        blocks.map(of_block).reduce(|| Motion::NONE, Motion::and)
    }
}

/// The time from which displacements are measured.
#[derive(Clone, Copy)]
pub(crate) enum Since<'a> {
    /// When the lists were made, if there are any.
    Lists,
    /// The beginning of the pass, with these positions. None if they stay, or if there are no lists.
    Pass(&'a [u8]),
}

/// The measures of the items of a row with these positions. With `answers` of a migration, the slack is that
/// of the staying items.
pub(crate) fn measure_row(
    population: &Population,
    layout: &Layout,
    geometry: &Geometry,
    row: usize,
    positions: &[u8],
    since: Since<'_>,
    answers: Option<&[u32]>,
) -> Motion {
    let Some(field) = population.position else { return Motion::NONE };
    let (first, end) = population.row(row);
    let references = match since {
        Since::Lists if population.lists.is_some() => &population.items.references[first..end],
        _ => &[],
    };
    let before = match since {
        Since::Pass(before) => before,
        Since::Lists => &[],
    };
    let frame = &Frame::new(population, layout, geometry, row, since, answers);
    let mut motion = Motion::NONE;
    match population.types[field].scalar {
        StoredScalar::F32 => {
            let [positions, before]: [&[[f32; 3]]; 2] = [positions, before].map(cast);
            kernel::run(Measurement { frame, positions, before, references, motion: &mut motion });
        }
        _ => {
            let [positions, before]: [&[[f64; 3]]; 2] = [positions, before].map(cast);
            kernel::run(Measurement { frame, positions, before, references, motion: &mut motion });
        }
    }
    motion
}

/// Empty slices need not be aligned.
fn cast<T: bytemuck::AnyBitPattern>(bytes: &[u8]) -> &[T] {
    if bytes.is_empty() { &[] } else { bytemuck::cast_slice(bytes) }
}

/// A row.
struct Frame<'a> {
    cells: &'a [u32],
    answers: Option<&'a [u32]>,
    first_cell: u32,
    side: f64,
    /// The lower corner along y and z.
    low: [f64; 2],
    /// The common displacement.
    common: [f64; 3],
    /// The length of each toroidal axis. Infinite for other axes.
    periods: [f64; 3],
}

impl<'a> Frame<'a> {
    fn new(
        population: &'a Population,
        layout: &Layout,
        geometry: &Geometry,
        row: usize,
        since: Since<'_>,
        answers: Option<&'a [u32]>,
    ) -> Self {
        let (first, end) = population.row(row);
        let [_, south, bottom] = layout.origin(row);
        let side = geometry.side();
        let (toroidal, extents) = (geometry.toroidal(), geometry.extents());
        let lists = population.lists.as_ref();
        Self {
            cells: &population.items.cells[first..end],
            answers,
            first_cell: layout.linear(row) as u32,
            side,
            low: [south, bottom].map(|index| index as f64 * side),
            common: lists.map_or([0.0; 3], |lists| match since {
                Since::Lists => lists.drift,
                Since::Pass(_) => lists.pace,
            }),
            periods: std::array::from_fn(|axis| {
                if toroidal[axis] { extents[axis] as f64 * side } else { f64::INFINITY }
            }),
        }
    }

    /// The slack of the staying items.
    #[inline(always)]
    fn slack<S: Copy + Into<f64>>(&self, positions: &[[S; 3]]) -> f64 {
        let [south, bottom] = self.low;
        let [north, top] = [south + self.side, bottom + self.side];
        let mut slack = rank(0.0);
        let mut exponent = 0;
        // Without a migration all items stay.
        let answers = self.answers.unwrap_or(self.cells);
        for ((place, &cell), &answer) in positions.iter().zip(self.cells).zip(answers) {
            let [x, y, z] = place.map(Into::into);
            let west = f64::from(cell - self.first_cell) * self.side;
            let across = above(west - x, x - (west + self.side));
            let out = above(across, above(above(south - y, y - north), above(bottom - z, z - top)));
            slack = slack.max(if moves(cell, answer) { rank(0.0) } else { rank(out) });
            for number in [x, y, z] {
                exponent = exponent.max(number.to_bits() & EXPONENT);
            }
        }
        if exponent == EXPONENT { f64::NAN } else { number(slack) }
    }

    #[inline(always)]
    fn moved<S: Copy + Into<f64>, T: Copy + Into<f64>>(
        &self,
        positions: &[[S; 3]],
        before: &[[T; 3]],
    ) -> Motion {
        let wraps = self.periods.iter().any(|period| period.is_finite());
        let Motion { slack, square, low, high } = Motion::NONE;
        let (mut square, mut low, mut high) = (rank(square), low.map(rank), high.map(rank));
        for (now, before) in positions.iter().zip(before) {
            let mut moved: [f64; 3] =
                std::array::from_fn(|axis| now[axis].into() - before[axis].into() - self.common[axis]);
            if wraps {
                for (moved, period) in
                    moved.iter_mut().zip(self.periods).filter(|(_, period)| period.is_finite())
                {
                    *moved -= period * (*moved / period).round();
                }
            }
            for axis in 0..3 {
                low[axis] = low[axis].min(rank(moved[axis]));
                high[axis] = high[axis].max(rank(moved[axis]));
            }
            let [x, y, z] = moved;
            square = square.max(rank(x * x + y * y + z * z));
        }
        Motion { slack, square: number(square), low: low.map(number), high: high.map(number) }
    }
}

/// The bits of the exponent. All are set in infinities and NaN.
const EXPONENT: u64 = 0x7FF << 52;

/// The integer that stands for a number in the total order. The compiler computes the largest of many
/// integers in lanes, but that of many floating-point numbers one by one, because of NaN.
#[inline(always)]
fn rank(number: f64) -> i64 {
    flip(number.to_bits() as i64)
}

/// The number with this rank.
#[inline(always)]
fn number(rank: i64) -> f64 {
    f64::from_bits(flip(rank) as u64)
}

/// Reverses the order of negative numbers, whose bits grow with their size.
#[inline(always)]
fn flip(bits: i64) -> i64 {
    bits ^ (bits >> 63 & i64::MAX)
}

/// The larger number. With NaN, either one.
#[inline(always)]
fn above(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The measurement of a row, compiled for the processor's instructions.
struct Measurement<'a, S> {
    frame: &'a Frame<'a>,
    positions: &'a [[S; 3]],
    /// The positions before the pass, or when lists were made. One of them is empty, or both.
    before: &'a [[S; 3]],
    references: &'a [[f32; 3]],
    motion: &'a mut Motion,
}

impl<S: Copy + Into<f64>> Work for Measurement<'_, S> {
    #[inline(always)]
    fn run(self) {
        let Self { frame, positions, before, references, motion } = self;
        let moved = if references.is_empty() {
            frame.moved(positions, before)
        } else {
            frame.moved(positions, references)
        };
        *motion = Motion { slack: frame.slack(positions), ..moved };
        if motion.slack.is_nan() {
            motion.square = f64::NAN;
        }
    }
}
