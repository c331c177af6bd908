//! Construction of neighbour lists.

use crate::blocks::blocks;
use crate::layout::Layout;
use crate::lists::{Entries, refill};
use crate::population::Population;
use rayon::prelude::*;
use std::ops::Range;
use xca_core::Geometry;
use xca_core::kernel::{Work, run};

/// The number of items that are compared at a time.
const LANES: usize = 8;

/// The lists of some rows.
struct Listed {
    rows: Range<usize>,
    list: Vec<u32>,
    /// The number of entries in `list`.
    length: usize,
    /// This number after each item.
    ends: Vec<u32>,
}

impl Listed {
    /// The places after all entries.
    #[inline(always)]
    fn next(&mut self) -> &mut [u32; LANES] {
        if self.list.len() < self.length + LANES {
            self.grow();
        }
        // `grow` has made room.
        self.list[self.length..].first_chunk_mut().expect("room for all lanes")
    }

    #[cold]
    fn grow(&mut self) {
        self.list.resize(self.length + self.length / 4 + 1024, 0);
    }
}

/// Lists for each item the places of all items nearer than `within` metres, and possibly of some that are
/// slightly farther. Leaves out ghosts. The box of the neighbourhood must hold all of these items: none may
/// be too far outside its cell. `None` if there are too many entries.
pub(crate) fn make(
    population: &Population,
    layout: &Layout,
    geometry: &Geometry,
    (within, rounding): (f64, f64),
    before: Entries,
) -> Option<Entries> {
    let planes = Planes::new(&population.items.references);
    let toroidal = geometry.toroidal();
    let periods = std::array::from_fn(|axis| {
        let period = geometry.extents()[axis] as f64 * geometry.side();
        toroidal[axis].then_some(period as f32)
    });
    let square = ((within + rounding) * (within + rounding)) as f32;
    let square = square + square * f32::EPSILON;
    let slack = population.motion.map_or(f64::INFINITY, |motion| motion.slack + rounding) as f32;
    let side = geometry.side();
    let rows = rows_in_reach(layout);
    let maker = Maker { population, layout, planes, periods, side, rows, slack, square };
    let blocks = blocks(layout, &[population], rayon::current_num_threads());
    let blocks = blocks.into_par_iter().with_max_len(1);
    let list = |rows: Range<usize>| {
        let mut listed = Listed { rows: rows.clone(), list: Vec::new(), length: 0, ends: Vec::new() };
        rows.for_each(|row| run(OfRow { maker: &maker, row, listed: &mut listed }));
        listed.list.truncate(listed.length);
        listed
    };
    let listed: Vec<Listed> = blocks.map(list).collect();
    drop(maker);
    before.replaced(population, listed)
}

/// Some rows, and their part of all entries.
struct Part<'a> {
    population: &'a Population,
    listed: Listed,
    /// The number of entries of earlier rows.
    before: u32,
    starts: &'a mut [u32],
    candidates: &'a mut [u32],
    owners: &'a mut [u32],
}

impl Entries {
    /// The entries of blocks of rows, in order. Each block is dropped when it has been copied.
    fn replaced(mut self, population: &Population, listed: Vec<Listed>) -> Option<Self> {
        let total = listed.iter().map(|listed| listed.list.len()).sum();
        let end = u32::try_from(total).ok()?;
        refill(&mut self.starts, population.own_places() + 1, || end);
        refill(&mut self.candidates, total, || 0);
        refill(&mut self.owners, total, || 0);
        let (mut starts, mut candidates, mut owners) =
            (&mut *self.starts, &mut *self.candidates, &mut *self.owners);
        let mut before = 0;
        let mut parts = Vec::with_capacity(listed.len());
        for listed in listed {
            let Range { start, end } = listed.rows;
            let places = (population.rows[end] - population.rows[start]) as usize;
            let length = listed.list.len();
            parts.push(Part {
                population,
                listed,
                before,
                starts: starts.split_off_mut(..places)?,
                candidates: candidates.split_off_mut(..length)?,
                owners: owners.split_off_mut(..length)?,
            });
            before += length as u32;
        }
        parts.into_par_iter().with_max_len(1).for_each(Part::fill);
        Some(self)
    }
}

impl Part<'_> {
    fn fill(self) {
        let Self { population, listed: Listed { rows, list, ends, .. }, before, starts, candidates, owners } =
            self;
        candidates.copy_from_slice(&list);
        let first_place = population.rows[rows.start] as usize;
        let mut ends = ends.into_iter();
        let mut end = 0;
        for row in rows {
            let (first, occupied) = population.row(row);
            for place in first..first + population.room(row) {
                starts[place - first_place] = before + end;
                if place < occupied {
                    let start = end;
                    end = ends.next().unwrap_or(start);
                    owners[start as usize..end as usize].fill(place as u32);
                }
            }
        }
    }
}

/// The positions in `f32`, as an array for each axis. Padding at the end allows reading [`LANES`] at a time.
struct Planes {
    axes: [Vec<f32>; 3],
}

impl Planes {
    fn new(positions: &[[f32; 3]]) -> Self {
        let along = |axis: usize| {
            let mut plane: Vec<f32> = positions.par_iter().map(|position| position[axis]).collect();
            plane.resize(positions.len() + LANES, 0.0);
            plane
        };
        Self { axes: [0, 1, 2].map(along) }
    }

    /// The values from a place on, along an axis.
    #[inline(always)]
    fn lanes(&self, axis: usize, first: usize) -> [f32; LANES] {
        let plane = &self.axes[axis][first..];
        plane.first_chunk().copied().unwrap_or([0.0; LANES])
    }
}

struct Maker<'a> {
    population: &'a Population,
    layout: &'a Layout,
    planes: Planes,
    /// The length of each toroidal axis.
    periods: [Option<f32>; 3],
    side: f64,
    /// The rows in the box of the neighbourhood.
    rows: Vec<NearRow>,
    /// The largest distance of an item from its cell along an axis, with the effect of rounding.
    slack: f32,
    square: f32,
}

/// The rows in the box of the neighbourhood, in order.
fn rows_in_reach(layout: &Layout) -> Vec<NearRow> {
    let [line, layer] = layout.steps();
    let [_, along, up] = layout.reach().map(|reach| reach as isize);
    let of_layer = |z| (-along..=along).map(move |y| NearRow { offset: z * layer + y * line, steps: [y, z] });
    (-up..=up).flat_map(of_layer).collect()
}

/// A row in the box of the neighbourhood of another.
struct NearRow {
    /// The distance in padded cells.
    offset: isize,
    /// The distances in rows along y and z.
    steps: [isize; 2],
}

/// Makes the lists of a row with the widest instructions of the processor.
struct OfRow<'a> {
    maker: &'a Maker<'a>,
    row: usize,
    listed: &'a mut Listed,
}

impl Work for OfRow<'_> {
    #[inline(always)]
    fn run(self) {
        self.maker.list_row(self.row, self.listed);
    }
}

impl Maker<'_> {
    #[inline(always)]
    fn list_row(&self, row: usize, listed: &mut Listed) {
        let (population, layout) = (self.population, self.layout);
        let (first, end) = population.row(row);
        if first == end {
            return;
        }
        let padded = layout.first(row);
        let [_, y, z] = layout.origin(row);
        for x in 0..layout.width() {
            let own = population.starts[padded + x]..population.ends[padded + x];
            let low = [x, y, z].map(|index| (index as f64 * self.side) as f32);
            for item in own {
                let here = [0, 1, 2].map(|axis| self.planes.axes[axis][item as usize]);
                let inside = std::array::from_fn(|axis| here[axis] - low[axis]);
                self.list_item(item, (padded, x), inside, listed);
                listed.ends.push(listed.length as u32);
            }
        }
    }

    /// Lists the near items of an item of a cell. Leaves out rows and cells that are too far from its
    /// position `inside` of its cell.
    #[inline(always)]
    fn list_item(&self, item: u32, (padded, x): (usize, usize), inside: [f32; 3], listed: &mut Listed) {
        let Population { starts, ends, .. } = self.population;
        let own_places = self.population.own_places();
        let [reach, ..] = self.layout.reach();
        let width = self.layout.width();
        let side = self.side as f32;
        // The square of the least distance from the items of the cells so many steps away along an axis.
        let square = |axis: usize, steps: isize| {
            let [before, after] =
                [inside[axis] - (steps + 1) as f32 * side, steps as f32 * side - inside[axis]];
            let gap = (before.max(after) - self.slack).max(0.0);
            gap * gap
        };
        let steps = 1..=reach as isize;
        let west = steps.clone().filter(|steps| square(0, -steps) < self.square).count();
        let east = steps.filter(|steps| square(0, *steps) < self.square).count();
        let (low, high) = (x.saturating_sub(west), (x + east).min(width - 1));
        for NearRow { offset, steps: [along, up] } in &self.rows {
            if square(1, *along) + square(2, *up) >= self.square {
                continue;
            }
            let row = padded.wrapping_add_signed(*offset);
            let mut keep = |range: Range<u32>| {
                // Ghosts come after all own places.
                if (range.start as usize) < own_places {
                    self.keep(item, range, listed);
                }
            };
            keep(starts[row + low]..ends[row + high]);
            if self.periods[0].is_some() {
                // The halo repeats cells at the other end of the row.
                let before = (x + 1..=reach).map(|step| row - (step - x));
                let after = (width..=x + reach).map(|cell| row + cell);
                before.chain(after).for_each(|cell| keep(starts[cell]..ends[cell]));
            }
        }
    }

    /// Adds the near items of a strip. The places of eight items are always written, the near ones first, and
    /// those after them are written over: no branch on what is near, which the processor could not predict.
    #[inline(always)]
    fn keep(&self, item: u32, strip: Range<u32>, listed: &mut Listed) {
        let here = [0, 1, 2].map(|axis| self.planes.axes[axis][item as usize]);
        for first in strip.clone().step_by(LANES) {
            let mut squares = [0.0_f32; LANES];
            for (axis, here) in here.iter().enumerate() {
                let there = self.planes.lanes(axis, first as usize);
                for lane in 0..LANES {
                    let mut way = there[lane] - here;
                    if let Some(period) = self.periods[axis] {
                        way -= period * (way / period).round_ties_even();
                    }
                    squares[lane] += way * way;
                }
            }
            let wanted = (1_u32 << (strip.end - first).min(LANES as u32)) - 1;
            let own = item.wrapping_sub(first);
            let own = u32::from(own < LANES as u32) << (own % LANES as u32);
            // One byte for each, and then one bit: the product moves byte n to bit 56 + n.
            let near: [u8; LANES] = std::array::from_fn(|lane| u8::from(squares[lane] < self.square));
            let near = (u64::from_le_bytes(near).wrapping_mul(0x0102_0408_1020_4080) >> 56) as u32;
            let near = near & wanted & !own;
            let lanes = SET_BITS[near as usize];
            *listed.next() = std::array::from_fn(|number| first + lanes[number]);
            listed.length += near.count_ones() as usize;
        }
    }
}

/// The indices of the set bits of each byte, then zeros.
static SET_BITS: [[u32; LANES]; 256] = {
    let mut all = [[0; LANES]; 256];
    let mut byte = 0;
    while byte < all.len() {
        let (mut bit, mut count) = (0, 0);
        while bit < LANES {
            if byte >> bit & 1 == 1 {
                all[byte][count] = bit as u32;
                count += 1;
            }
            bit += 1;
        }
        byte += 1;
    }
    all
};
