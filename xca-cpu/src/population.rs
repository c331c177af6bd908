//! Populations: items stored contiguously, sorted by row, then cell, then label.
//!
//! Each row has some room after its last item. An item that changes its cell therefore moves only the items
//! of two rows. If a row has no room left, all items are moved to make room again
//! ([`Population::make_room`]).

use crate::arrays::Arrays;
use crate::layout::Layout;
use crate::lists::{Lists, STRANGER};
use crate::motion::Motion;
use crate::upkeep::Upkeep;
use rayon::prelude::*;
use std::ops::Range;
use xca_core::engine::{Plane, Population as Items, SubstateId};
use xca_core::model::{Group as Definition, GroupKind};
use xca_core::storage::Buffer;
use xca_core::{Precision, StoredScalar, StoredType};

/// The least room of a row for more items. Few items come and go at once, but among many rows some exceed the
/// average.
const LEAST_ROOM: u32 = 4;

/// The number of rows that are worth the start of a thread.
const ROWS_WORTH_A_START: usize = 64;

/// A row has one extra place for each of this many items.
const ITEMS_WORTH_A_PLACE: u32 = 8;

/// The items of one population.
pub(crate) struct Population {
    pub(crate) types: Vec<StoredType>,
    pub(crate) slots: usize,
    pub(crate) may_leave: bool,
    pub(crate) left: u64,
    /// The stored arrays, as long as the places of all rows.
    pub(crate) items: Arrays,
    /// The second buffer of each field that processes write and also read from other items.
    pub(crate) next: Vec<Buffer>,
    /// The place of the first item of each padded cell, even of an empty one. In the halo, that of the cell
    /// that it repeats.
    pub(crate) starts: Vec<u32>,
    /// One past the last item of each padded cell.
    pub(crate) ends: Vec<u32>,
    /// The place of the first item of each row of the space, then the number of places.
    pub(crate) rows: Vec<u32>,
    /// One past the last item of each row. Room begins there.
    pub(crate) row_ends: Vec<u32>,
    /// The index of the position field.
    pub(crate) position: Option<usize>,
    /// The measures of the current positions and cells, if there are any.
    pub(crate) motion: Option<Motion>,
    /// The largest distance in metres, along an axis, of a ghost from its cell.
    pub(crate) slack_of_ghosts: f64,
    /// Whether a process has searched the population.
    pub(crate) searched: bool,
    /// The neighbour lists.
    pub(crate) lists: Option<Lists>,
    pub(crate) upkeep: Upkeep,
}

impl Population {
    /// A population without items.
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
            slack_of_ghosts: 0.0,
            searched: false,
            lists: None,
            upkeep: Upkeep::new(skin),
            types,
        }
    }

    /// The range of places of the items of a row.
    pub(crate) fn row(&self, row: usize) -> (usize, usize) {
        (self.rows[row] as usize, self.row_ends[row] as usize)
    }

    /// The number of places of a row.
    pub(crate) fn room(&self, row: usize) -> usize {
        (self.rows[row + 1] - self.rows[row]) as usize
    }

    /// The occupied places, row after row.
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

    /// The values of a field, without the room between rows.
    pub(crate) fn read(&self, field: usize) -> Vec<u8> {
        let size = self.types[field].size();
        let bytes = self.items.fields[field].bytes();
        let mut values = Vec::with_capacity(self.count() * size);
        for places in self.places() {
            values.extend_from_slice(&bytes[places.start * size..places.end * size]);
        }
        values
    }

    /// Appends the bytes of a plane in these rows.
    pub(crate) fn read_rows(
        &self,
        (layout, plane): (&Layout, Plane),
        rows: impl Iterator<Item = usize>,
        bytes: &mut Vec<u8>,
    ) {
        for row in rows {
            let (first, end) = self.row(row);
            match plane {
                Plane::Counts(_) => {
                    self.counts(layout, row).for_each(|count| bytes.extend(count.to_ne_bytes()));
                }
                Plane::Labels(_) => {
                    bytes.extend_from_slice(bytemuck::cast_slice(&self.items.labels[first..end]));
                }
                Plane::Values(SubstateId { field, .. }) => {
                    let size = self.types[field].size();
                    bytes.extend_from_slice(&self.items.fields[field].bytes()[first * size..end * size]);
                }
            }
        }
    }

    /// Replaces the values of a field. There must be as many as items.
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

    /// Replaces all items. The counts must fit the slots.
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

    /// Moves all items, so that each row has room for `counts` items and some more. Returns the shift of the
    /// items of each row (wrapping).
    pub(crate) fn make_room(&mut self, layout: &Layout, counts: &[u32]) -> Vec<u32> {
        let rows = rows_with_room(layout, counts);
        let moved = |(first, place): (&u32, &u32)| place.wrapping_sub(*first);
        let shifts: Vec<u32> = self.rows.iter().zip(&rows).map(moved).take(layout.rows()).collect();
        let places = rows[layout.rows()] as usize;
        let Self { types, items, rows: firsts, row_ends: ends, lists, .. } = self;
        items.replace(types, places, lists.is_some(), |old, mut new, size| {
            let of_rows = firsts.iter().zip(ends.iter()).zip(rows.windows(2));
            let of_rows: Vec<_> = of_rows
                .filter_map(|((first, end), places)| {
                    let room = new.split_off_mut(..(places[1] - places[0]) as usize * size)?;
                    Some((&old[*first as usize * size..*end as usize * size], room))
                })
                .collect();
            of_rows.into_par_iter().with_min_len(ROWS_WORTH_A_START).for_each(|(values, room)| {
                room[..values.len()].copy_from_slice(values);
            });
        });
        for (row, shift) in shifts.iter().enumerate() {
            let cells = layout.first(row)..layout.first(row) + layout.width();
            for range in self.starts[cells.clone()].iter_mut().chain(&mut self.ends[cells]) {
                *range = range.wrapping_add(*shift);
            }
            self.row_ends[row] = self.row_ends[row].wrapping_add(*shift);
        }
        self.rows = rows;
        self.fill_halo(layout);
        (0..layout.rows()).for_each(|row| self.follow(row));
        shifts
    }

    /// Stores the measures of all items after a pass.
    pub(crate) fn measured(&mut self, motion: Motion) {
        self.motion = Some(motion);
        if let Some(lists) = &mut self.lists {
            lists.moved_in_pass(&motion);
        }
    }

    /// Updates the places of the items of a row in the lists.
    pub(crate) fn follow(&mut self, row: usize) {
        let (first, end) = self.row(row);
        if let Some(lists) = &mut self.lists {
            lists.moved(&self.items.numbers[first..end], first as u32);
        }
    }

    /// Stores the positions of all places, as references for lists.
    pub(crate) fn store_references(&mut self) {
        let Self { items: Arrays { references, fields, .. }, types, .. } = self;
        let Some(field) = self.position else { return };
        let bytes = fields[field].bytes();
        references.clear();
        match types[field].scalar {
            StoredScalar::F32 => references.extend_from_slice(bytemuck::cast_slice(bytes)),
            _ => {
                let positions: &[[f64; 3]] = bytemuck::cast_slice(bytes);
                references.extend(positions.iter().map(|position| position.map(|value| value as f32)));
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

    /// The number of places of all rows. Items of other parts come after them.
    pub(crate) fn own_places(&self) -> usize {
        self.rows.last().map_or(0, |places| *places as usize)
    }

    /// Adds an item of another part after all places, with the bytes of its fields. Returns its place.
    pub(crate) fn push(&mut self, label: u32, fields: &[u8]) -> u32 {
        let place = self.items.labels.len();
        self.items.labels.push(label);
        self.items.cells.push(0);
        let mut rest = fields;
        for (field, stored) in self.items.fields.iter_mut().zip(&self.types) {
            let (bytes, others) = rest.split_at(stored.size());
            rest = others;
            field.resize((place + 1) * bytes.len());
            field.bytes_mut()[place * bytes.len()..].copy_from_slice(bytes);
        }
        if let Some(Lists { drift, .. }) = &self.lists {
            // As if it had moved like the others so far.
            let position = self.position_of(place).unwrap_or_default();
            self.items.references.push(std::array::from_fn(|axis| (position[axis] - drift[axis]) as f32));
            self.items.numbers.push(STRANGER);
        }
        place as u32
    }

    /// Adds ghosts after all places, with the bytes of their labels and of some fields. Other fields are 0.
    pub(crate) fn add_ghosts(&mut self, labels: &[u8], fields: &[(usize, &[u8])]) {
        let first = self.items.labels.len();
        let labels = labels.chunks_exact(size_of::<u32>());
        self.items.labels.extend(labels.map(bytemuck::pod_read_unaligned::<u32>));
        let end = self.items.labels.len();
        self.items.cells.resize(end, 0);
        if self.lists.is_some() {
            self.items.numbers.resize(end, STRANGER);
            // Only own items are compared with their references.
            self.items.references.resize(end, [0.0; 3]);
        }
        for (field, stored) in self.items.fields.iter_mut().zip(&self.types) {
            field.resize(end * stored.size());
        }
        for (field, values) in fields {
            let size = self.types[*field].size();
            self.items.fields[*field].bytes_mut()[first * size..].copy_from_slice(values);
        }
    }

    /// Removes the items after all places.
    pub(crate) fn truncate(&mut self) {
        let places = self.own_places();
        self.items.labels.truncate(places);
        self.items.cells.truncate(places);
        self.items.numbers.truncate(places);
        self.items.references.truncate(places);
        for (field, stored) in self.items.fields.iter_mut().zip(&self.types) {
            field.resize(places * stored.size());
        }
    }

    /// Copies the ranges of the repeated cells to the halo. Beyond flat faces it is empty from the start.
    pub(crate) fn fill_halo(&mut self, layout: &Layout) {
        layout.fill_halo(&mut self.starts, 1, None, false);
        layout.fill_halo(&mut self.ends, 1, None, false);
    }

    /// The same for the halo along z alone.
    pub(crate) fn fill_layers(&mut self, layout: &Layout) {
        layout.fill_layers(&mut self.starts, 1, None);
        layout.fill_layers(&mut self.ends, 1, None);
    }

    pub(crate) fn memory(&self) -> usize {
        let of_cells = self.starts.capacity() + self.ends.capacity();
        let of_rows = self.rows.capacity() + self.row_ends.capacity();
        let next: usize = self.next.iter().map(Buffer::capacity).sum();
        let lists = self.lists.as_ref().map_or(0, Lists::memory);
        (of_cells + of_rows) * size_of::<u32>() + self.items.memory() + next + lists
    }
}

/// The first places of rows with these counts, then the number of places. A row far from all items needs no
/// room, because items move from cell to cell.
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
