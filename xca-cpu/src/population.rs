//! Populations: items stored one after the other, row after row, in a row cell after cell, in a cell by
//! label.
//!
//! Each row has some room after its last item. So an item that changes its cell moves the items of two rows
//! and no others; only where a row has no room left, all are moved, to get room again
//! ([`Population::make_room`]).

use crate::layout::Layout;
use crate::lists::Lists;
use crate::motion::Motion;
use crate::upkeep::Upkeep;
use rayon::prelude::*;
use std::ops::Range;
use xca_core::engine::Population as Items;
use xca_core::model::{Group as Definition, GroupKind};
use xca_core::storage::Buffer;
use xca_core::{Precision, StoredScalar, StoredType};

/// How many more items than it has a row has room for at least: few items come and go at once, but some row
/// among many is always unlucky.
const LEAST_ROOM: u32 = 4;

/// A row has one more place for so many items that it has.
const ITEMS_WORTH_A_PLACE: u32 = 8;

/// The items of one population.
pub(crate) struct Population {
    pub(crate) types: Vec<StoredType>,
    pub(crate) slots: usize,
    pub(crate) may_leave: bool,
    pub(crate) left: u64,
    /// As long as all room.
    pub(crate) items: Arrays,
    /// For a field that processes write and also read of other items: where they write it.
    pub(crate) next: Vec<Buffer>,
    /// For each padded cell the place of its first item, also where it has none; in the halo, that of the
    /// cell that it stands for.
    pub(crate) starts: Vec<u32>,
    /// For each padded cell one past its last item.
    pub(crate) ends: Vec<u32>,
    /// For each row of the space the place of its first item, and at the end the number of places.
    pub(crate) rows: Vec<u32>,
    /// For each row one past its last item; from there on is room.
    pub(crate) row_ends: Vec<u32>,
    /// The field that is the position.
    pub(crate) position: Option<usize>,
    /// What has been measured of the positions and cells that items have now.
    pub(crate) motion: Option<Motion>,
    /// Whether a process has searched in it.
    pub(crate) searched: bool,
    /// Lists of what is near each item.
    pub(crate) lists: Option<Lists>,
    pub(crate) upkeep: Upkeep,
}

/// What is stored of each item, by its place.
#[derive(Default)]
pub(crate) struct Arrays {
    pub(crate) labels: Vec<u32>,
    /// The linear indices of the items' cells.
    pub(crate) cells: Vec<u32>,
    /// The numbers by which lists know the items; none without lists.
    pub(crate) numbers: Vec<u32>,
    /// Where the items were when the lists were made, in metres; none without lists.
    pub(crate) references: Vec<[f32; 3]>,
    pub(crate) fields: Vec<Buffer>,
}

/// The values of an array as bytes, so many each.
pub(crate) struct Values<'a> {
    pub(crate) size: usize,
    pub(crate) bytes: &'a mut [u8],
}

impl Arrays {
    fn new(types: &[StoredType], places: usize) -> Self {
        Self {
            labels: vec![0; places],
            cells: vec![0; places],
            numbers: Vec::new(),
            references: Vec::new(),
            fields: types.iter().map(|stored| Buffer::zeroed(places * stored.size())).collect(),
        }
    }

    /// The number of the labels among [`Self::values`].
    pub(crate) const LABELS: usize = 0;
    /// The number of the cells.
    pub(crate) const CELLS: usize = 1;

    /// All arrays, to be moved; always in the same order.
    pub(crate) fn values<'a>(&'a mut self, types: &[StoredType]) -> Vec<Values<'a>> {
        let numbers = [&mut self.labels, &mut self.cells, &mut self.numbers];
        let numbers = numbers.map(|values| Values { size: 4, bytes: bytemuck::cast_slice_mut(values) });
        let references =
            Values { size: size_of::<[f32; 3]>(), bytes: bytemuck::cast_slice_mut(&mut self.references) };
        let fields = self.fields.iter_mut().zip(types);
        let fields = fields.map(|(field, stored)| Values { size: stored.size(), bytes: field.bytes_mut() });
        let all = numbers.into_iter().chain([references]).chain(fields);
        all.filter(|values| !values.bytes.is_empty()).collect()
    }

    fn memory(&self) -> usize {
        let numbers = self.labels.capacity() + self.cells.capacity() + self.numbers.capacity();
        let references = self.references.capacity() * size_of::<[f32; 3]>();
        numbers * size_of::<u32>() + references + self.fields.iter().map(Buffer::capacity).sum::<usize>()
    }
}

impl Population {
    /// Without items.
    pub(crate) fn new(
        definition: &Definition,
        precision: Precision,
        layout: &Layout,
        skin: Option<f64>,
    ) -> Self {
        let types = definition.stored(precision);
        let (slots, may_leave) = match definition.kind() {
            GroupKind::Population { slots, may_leave } => (*slots, *may_leave),
            GroupKind::Cells { .. } => (0, false),
        };
        Self {
            slots,
            may_leave,
            left: 0,
            items: Arrays::new(&types, 0),
            next: types.iter().map(|_| Buffer::zeroed(0)).collect(),
            starts: vec![0; layout.cells()],
            ends: vec![0; layout.cells()],
            rows: vec![0; layout.rows() + 1],
            row_ends: vec![0; layout.rows()],
            position: definition.schema().position,
            motion: None,
            searched: false,
            lists: None,
            upkeep: Upkeep::new(skin),
            types,
        }
    }

    /// The places of the items of a row.
    pub(crate) fn row(&self, row: usize) -> (usize, usize) {
        (self.rows[row] as usize, self.row_ends[row] as usize)
    }

    /// How many items a row has places for.
    pub(crate) fn room(&self, row: usize) -> usize {
        (self.rows[row + 1] - self.rows[row]) as usize
    }

    /// The places that have items, row after row.
    pub(crate) fn places(&self) -> impl Iterator<Item = Range<usize>> + '_ {
        self.rows.iter().zip(&self.row_ends).map(|(first, end)| *first as usize..*end as usize)
    }

    pub(crate) fn count(&self) -> usize {
        self.places().map(|places| places.len()).sum()
    }

    /// The number of items in each cell of a row.
    pub(crate) fn counts<'a>(&'a self, layout: &'a Layout, row: usize) -> impl Iterator<Item = u32> + 'a {
        let first = layout.first(row);
        (first..first + layout.width()).map(|cell| self.ends[cell] - self.starts[cell])
    }

    /// The values of a field, without the room between them.
    pub(crate) fn read(&self, field: usize) -> Vec<u8> {
        let size = self.types[field].size();
        let bytes = self.items.fields[field].bytes();
        let mut values = Vec::with_capacity(self.count() * size);
        for places in self.places() {
            values.extend_from_slice(&bytes[places.start * size..places.end * size]);
        }
        values
    }

    /// Replaces the values of a field; there are as many as items.
    pub(crate) fn write(&mut self, field: usize, mut values: &[u8]) {
        if Some(field) == self.position {
            self.motion = None;
        }
        let size = self.types[field].size();
        let bytes = self.items.fields[field].bytes_mut();
        for (first, end) in self.rows.iter().zip(&self.row_ends) {
            let (now, after) = values.split_at((end - first) as usize * size);
            bytes[*first as usize * size..*end as usize * size].copy_from_slice(now);
            values = after;
        }
    }

    /// The labels of all items.
    pub(crate) fn labels(&self) -> Vec<u32> {
        self.places().flat_map(|places| self.items.labels[places].iter().copied()).collect()
    }

    /// Replaces all items; the counts fit the slots.
    pub(crate) fn set(&mut self, layout: &Layout, items: &Items) {
        let width = layout.width();
        let of_rows: Vec<u32> = items.counts.chunks_exact(width).map(|counts| counts.iter().sum()).collect();
        self.rows = rows_with_room(layout, &of_rows);
        self.row_ends = self.rows.iter().zip(&of_rows).map(|(first, count)| first + count).collect();
        self.items = Arrays::new(&self.types, self.rows[layout.rows()] as usize);
        self.lists = None;
        let mut labels = items.labels.as_slice();
        for (row, counts) in items.counts.chunks_exact(width).enumerate() {
            let (mut place, first) = (self.rows[row], layout.first(row));
            let places = place as usize..self.row_ends[row] as usize;
            let (now, after) = labels.split_at(places.len());
            self.items.labels[places].copy_from_slice(now);
            labels = after;
            for (x, count) in counts.iter().enumerate() {
                self.starts[first + x] = place;
                self.items.cells[place as usize..(place + count) as usize]
                    .fill((layout.linear(row) + x) as u32);
                place += count;
                self.ends[first + x] = place;
            }
        }
        for (field, values) in items.fields.iter().enumerate() {
            self.write(field, values);
        }
        self.fill_halo(layout);
    }

    /// Moves all items, so that each row has room for `counts` items and some more; gives for each row how
    /// far its items have moved (wrapping).
    pub(crate) fn make_room(&mut self, layout: &Layout, counts: &[u32]) -> Vec<u32> {
        let rows = rows_with_room(layout, counts);
        let mut arrays = Arrays::new(&self.types, rows[layout.rows()] as usize);
        if self.lists.is_some() {
            arrays.numbers.resize(arrays.labels.len(), 0);
            arrays.references.resize(arrays.labels.len(), [0.0; 3]);
        }
        let moved = |(first, place): (&u32, &u32)| place.wrapping_sub(*first);
        let shifts: Vec<u32> = self.rows.iter().zip(&rows).map(moved).take(layout.rows()).collect();
        let old = self.items.values(&self.types);
        let (firsts, ends, new_rows) = (&self.rows, &self.row_ends, &rows);
        old.into_iter().zip(arrays.values(&self.types)).par_bridge().for_each(|(old, new)| {
            let size = new.size;
            for row in 0..layout.rows() {
                let (first, end) = (firsts[row] as usize * size, ends[row] as usize * size);
                let place = new_rows[row] as usize * size;
                new.bytes[place..place + end - first].copy_from_slice(&old.bytes[first..end]);
            }
        });
        for (row, shift) in shifts.iter().enumerate() {
            let cells = layout.first(row)..layout.first(row) + layout.width();
            for range in self.starts[cells.clone()].iter_mut().chain(&mut self.ends[cells]) {
                *range = range.wrapping_add(*shift);
            }
            self.row_ends[row] = self.row_ends[row].wrapping_add(*shift);
        }
        self.items = arrays;
        self.rows = rows;
        self.fill_halo(layout);
        (0..layout.rows()).for_each(|row| self.follow(row));
        shifts
    }

    /// Keeps what has been measured of all items, and expects them to move on together.
    pub(crate) fn measured(&mut self, motion: Motion) {
        self.motion = Some(motion);
        if let Some(lists) = &mut self.lists
            && motion.low.iter().chain(&motion.high).all(|bound| bound.is_finite())
        {
            for axis in 0..3 {
                lists.drift[axis] += 0.5 * (motion.low[axis] + motion.high[axis]);
            }
        }
    }

    /// Lets the lists know where the items of a row are.
    pub(crate) fn follow(&mut self, row: usize) {
        let (first, end) = self.row(row);
        if let Some(lists) = &mut self.lists {
            lists.moved(&self.items.numbers[first..end], first as u32);
        }
    }

    /// The positions of all places, as lists refer to them.
    pub(crate) fn references(&self) -> Vec<[f32; 3]> {
        let Some(field) = self.position else { return Vec::new() };
        let bytes = self.items.fields[field].bytes();
        match self.types[field].scalar {
            StoredScalar::F32 => bytemuck::cast_slice(bytes).to_vec(),
            _ => {
                let positions: &[[f64; 3]] = bytemuck::cast_slice(bytes);
                positions.iter().map(|position| position.map(|value| value as f32)).collect()
            }
        }
    }

    /// The position of an item, in metres.
    pub(crate) fn position_of(&self, place: usize) -> Option<[f64; 3]> {
        let field = self.position?;
        let bytes = self.items.fields[field].bytes();
        Some(match self.types[field].scalar {
            StoredScalar::F32 => bytemuck::cast_slice::<u8, [f32; 3]>(bytes)[place].map(f64::from),
            _ => bytemuck::cast_slice::<u8, [f64; 3]>(bytes)[place],
        })
    }

    /// Adds an item after all places; gives its place.
    pub(crate) fn push(&mut self, label: u32, fields: &[&[u8]]) -> u32 {
        let place = self.items.labels.len();
        self.items.labels.push(label);
        self.items.cells.push(0);
        for (field, bytes) in self.items.fields.iter_mut().zip(fields) {
            field.resize((place + 1) * bytes.len());
            field.bytes_mut()[place * bytes.len()..].copy_from_slice(bytes);
        }
        place as u32
    }

    /// Takes away what stands after all places.
    pub(crate) fn truncate(&mut self) {
        let places = self.rows.last().map_or(0, |places| *places as usize);
        self.items.labels.truncate(places);
        self.items.cells.truncate(places);
        for (field, stored) in self.items.fields.iter_mut().zip(&self.types) {
            field.resize(places * stored.size());
        }
    }

    /// Lets the halo cells stand for the cells that they repeat.
    pub(crate) fn fill_halo(&mut self, layout: &Layout) {
        if layout.halo_follows().contains(&true) {
            let none = xca_core::Faces::all(vec![0]);
            layout.fill_halo(&mut self.starts, 1, Some(&none), false);
            layout.fill_halo(&mut self.ends, 1, Some(&none), false);
        }
    }

    pub(crate) fn memory(&self) -> usize {
        let of_cells = self.starts.capacity() + self.ends.capacity();
        let of_rows = self.rows.capacity() + self.row_ends.capacity();
        let next: usize = self.next.iter().map(Buffer::capacity).sum();
        let lists = self.lists.as_ref().map_or(0, Lists::memory);
        (of_cells + of_rows) * size_of::<u32>() + self.items.memory() + next + lists
    }
}

/// The first places of rows with so many items, and at the end the number of places. A row far from all items
/// needs no room: they come from cell to cell.
fn rows_with_room(layout: &Layout, counts: &[u32]) -> Vec<u32> {
    let mut rows = Vec::with_capacity(counts.len() + 1);
    let mut place = 0;
    for row in 0..counts.len() {
        rows.push(place);
        let near = layout.rows_beside(row).any(|row| counts[row] > 0);
        place += counts[row] + if near { LEAST_ROOM + counts[row] / ITEMS_WORTH_A_PLACE } else { 0 };
    }
    rows.push(place);
    rows
}
