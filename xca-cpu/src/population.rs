//! Populations: items stored one after the other, cell after cell and by label.

use crate::layout::Layout;
use xca_core::engine::Population as Items;
use xca_core::storage::Buffer;
use xca_core::{Faces, StoredType};

/// The items of one population.
pub(crate) struct Population {
    pub(crate) types: Vec<StoredType>,
    pub(crate) slots: usize,
    pub(crate) may_leave: bool,
    pub(crate) left: u64,
    pub(crate) items: Arrays,
    /// Where migrations put the items; and what processes write that also read it of other items.
    pub(crate) next: Arrays,
    /// For each padded cell its first item; in the halo, that of the cell that it stands for.
    pub(crate) starts: Vec<u32>,
    /// For each padded cell one past its last item.
    pub(crate) ends: Vec<u32>,
    /// For each row of the space its first item, and at the end the number of items.
    pub(crate) rows: Vec<u32>,
}

/// What is stored of each item.
#[derive(Default)]
pub(crate) struct Arrays {
    pub(crate) labels: Vec<u32>,
    pub(crate) fields: Vec<Buffer>,
}

impl Arrays {
    pub(crate) fn new(types: &[StoredType]) -> Self {
        Self { labels: Vec::new(), fields: types.iter().map(|_| Buffer::zeroed(0)).collect() }
    }

    /// Makes room for so many items.
    pub(crate) fn resize(&mut self, items: usize, types: &[StoredType]) {
        self.labels.resize(items, 0);
        for (field, stored) in self.fields.iter_mut().zip(types) {
            field.resize(items * stored.size());
        }
    }

    fn memory(&self) -> usize {
        self.labels.capacity() * size_of::<u32>() + self.fields.iter().map(Buffer::capacity).sum::<usize>()
    }
}

impl Population {
    pub(crate) fn new(types: Vec<StoredType>, slots: usize, may_leave: bool, layout: &Layout) -> Self {
        Self {
            slots,
            may_leave,
            left: 0,
            items: Arrays::new(&types),
            next: Arrays::new(&types),
            starts: vec![0; layout.cells()],
            ends: vec![0; layout.cells()],
            rows: vec![0; layout.rows() + 1],
            types,
        }
    }

    /// The items of a row.
    pub(crate) fn row(&self, row: usize) -> (usize, usize) {
        (self.rows[row] as usize, self.rows[row + 1] as usize)
    }

    pub(crate) fn count(&self) -> usize {
        self.items.labels.len()
    }

    /// The number of items in each cell of a row.
    pub(crate) fn counts<'a>(&'a self, layout: &'a Layout, row: usize) -> impl Iterator<Item = u32> + 'a {
        let first = layout.first(row);
        (first..first + layout.width()).map(|cell| self.ends[cell] - self.starts[cell])
    }

    /// Replaces all items; the counts fit the slots.
    pub(crate) fn set(&mut self, layout: &Layout, items: &Items) {
        self.items.resize(items.labels.len(), &self.types);
        self.items.labels.copy_from_slice(&items.labels);
        for (field, values) in self.items.fields.iter_mut().zip(&items.fields) {
            field.bytes_mut().copy_from_slice(values);
        }
        let mut item = 0;
        for (row, counts) in items.counts.chunks_exact(layout.width()).enumerate() {
            self.rows[row] = item;
            let first = layout.first(row);
            for (x, count) in counts.iter().enumerate() {
                self.starts[first + x] = item;
                item += count;
                self.ends[first + x] = item;
            }
        }
        self.rows[layout.rows()] = item;
        self.fill_halo(layout);
    }

    /// Lets the halo cells stand for the cells that they repeat.
    pub(crate) fn fill_halo(&mut self, layout: &Layout) {
        if layout.halo_follows().contains(&true) {
            let none = Faces::all(vec![0]);
            layout.fill_halo(&mut self.starts, 1, Some(&none), false);
            layout.fill_halo(&mut self.ends, 1, Some(&none), false);
        }
    }

    pub(crate) fn memory(&self) -> usize {
        let cells = (self.starts.capacity() + self.ends.capacity() + self.rows.capacity()) * size_of::<u32>();
        cells + self.items.memory() + self.next.memory()
    }
}
