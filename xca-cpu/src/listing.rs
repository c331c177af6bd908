//! Construction of neighbour lists.

use crate::blocks::blocks;
use crate::layout::Layout;
use crate::population::Population;
use rayon::prelude::*;
use std::ops::Range;
use xca_core::Geometry;
use xca_core::kernel::{Work, run};

/// The number of items that are compared at a time.
const LANES: usize = 8;

/// The lists of all items, by place.
#[derive(Default)]
pub(crate) struct Entries {
    /// The start of each list in `candidates`, then the length of that. A place without an item has an empty
    /// list.
    pub(crate) starts: Vec<u32>,
    pub(crate) candidates: Vec<u32>,
    /// The place that has the list of each candidate.
    pub(crate) owners: Vec<u32>,
}

/// The lists of some rows.
struct Listed {
    rows: Range<usize>,
    list: Vec<u32>,
    /// The length of `list` after each item.
    ends: Vec<u32>,
}

/// Lists for each item the places of all items nearer than `within` metres, and possibly of some that are
/// slightly farther. Leaves out ghosts. The box of the neighbourhood must hold all of these items: none may
/// be too far outside its cell. `None` if there are too many entries.
pub(crate) fn make(
    population: &Population,
    layout: &Layout,
    geometry: &Geometry,
    within: f64,
    before: Entries,
) -> Option<Entries> {
    let planes = Planes::new(&population.items.references);
    let toroidal = geometry.toroidal();
    let periods = std::array::from_fn(|axis| {
        let period = geometry.extents()[axis] as f64 * geometry.side();
        toroidal[axis].then_some(period as f32)
    });
    let square = (within * within) as f32;
    let square = square + square * f32::EPSILON;
    let maker = Maker { population, layout, planes, periods, square };
    let blocks = blocks(layout, &[population], rayon::current_num_threads());
    let blocks = blocks.into_par_iter().with_max_len(1);
    let list = |rows: Range<usize>| {
        let mut listed = Listed { rows: rows.clone(), list: Vec::new(), ends: Vec::new() };
        rows.for_each(|row| run(OfRow { maker: &maker, row, listed: &mut listed }));
        listed
    };
    let listed: Vec<Listed> = blocks.map(list).collect();
    drop(maker);
    before.replaced(population, listed)
}

/// Gives a vector new values. Its memory is used again, because large pieces that come and go leave holes
/// that no one can use. It gets a quarter more than it needs.
pub(crate) fn refill<T>(values: &mut Vec<T>, length: usize, value: impl FnMut() -> T) {
    values.clear();
    if values.capacity() < length {
        *values = Vec::new();
        values.reserve_exact(length + length / 4);
    }
    values.resize_with(length, value);
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
        let Self { population, listed: Listed { rows, list, ends }, before, starts, candidates, owners } =
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
    square: f32,
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
        let mut strips = Vec::new();
        for x in 0..layout.width() {
            let own = population.starts[padded + x]..population.ends[padded + x];
            if own.is_empty() {
                continue;
            }
            self.strips(padded, x, &mut strips);
            for item in own {
                for strip in &strips {
                    self.keep(item, strip.clone(), &mut listed.list);
                }
                listed.ends.push(listed.list.len() as u32);
            }
        }
    }

    /// The places of the items in the box around a cell: one range for each row, and one for each cell in the
    /// halo.
    #[inline(always)]
    fn strips(&self, padded: usize, x: usize, strips: &mut Vec<Range<u32>>) {
        let Population { starts, ends, .. } = self.population;
        let own_places = self.population.own_places();
        let [reach, ..] = self.layout.reach();
        let width = self.layout.width();
        let (low, high) = (x.saturating_sub(reach), (x + reach).min(width - 1));
        strips.clear();
        for offset in self.layout.rows_in_reach() {
            let row = padded.wrapping_add_signed(offset);
            let mut add = |range: Range<u32>| {
                // Ghosts come after all own places.
                if !range.is_empty() && (range.start as usize) < own_places {
                    strips.push(range);
                }
            };
            add(starts[row + low]..ends[row + high]);
            if self.periods[0].is_some() {
                // The halo repeats cells at the other end of the row.
                let before = (x + 1..=reach).map(|step| row - (step - x));
                let after = (width..=x + reach).map(|cell| row + cell);
                before.chain(after).for_each(|cell| add(starts[cell]..ends[cell]));
            }
        }
    }

    /// Adds the near items of a strip.
    #[inline(always)]
    fn keep(&self, item: u32, strip: Range<u32>, list: &mut Vec<u32>) {
        let here = [0, 1, 2].map(|axis| self.planes.axes[axis][item as usize]);
        let mut first = strip.start;
        while first < strip.end {
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
            // One byte for each, so that usually one comparison shows that none is near.
            let near: [u8; LANES] = std::array::from_fn(|lane| u8::from(squares[lane] < self.square));
            let mut bits = u64::from_le_bytes(near);
            let count = (strip.end - first) as usize;
            if count < LANES {
                bits &= (1 << (8 * count)) - 1;
            }
            while bits != 0 {
                let place = first + bits.trailing_zeros() / 8;
                bits &= bits - 1;
                if place != item {
                    list.push(place);
                }
            }
            first += LANES as u32;
        }
    }
}
