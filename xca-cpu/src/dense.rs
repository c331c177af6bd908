//! Substates of cells: a plane each, with a halo.

use crate::layout::Layout;
use xca_core::storage::Buffer;
use xca_core::{Faces, StoredType};

/// One substate of cells.
pub(crate) struct Plane {
    pub(crate) stored: StoredType,
    pub(crate) current: Buffer,
    /// Where a process writes that also reads neighbours; made when there is such a process.
    pub(crate) next: Option<Buffer>,
    /// Whether a process of the model reads the substate elsewhere, so that it reads the halo.
    pub(crate) read_elsewhere: bool,
    halo: Halo,
}

/// How much of a plane's halo is that of its cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Halo {
    /// All of it.
    Whole,
    /// What continues the rows of the space along x.
    Rows,
    /// Nothing of it.
    Stale,
}

impl Plane {
    pub(crate) fn new(
        stored: StoredType,
        layout: &Layout,
        outside: &Faces<Vec<u8>>,
        doubled: bool,
        read_elsewhere: bool,
    ) -> Self {
        let mut current = Buffer::zeroed(layout.cells() * stored.size());
        layout.fill_halo(current.bytes_mut(), stored.size(), Some(outside), false);
        let next = doubled.then(|| current.clone());
        Self { stored, current, next, read_elsewhere, halo: Halo::Whole }
    }

    /// After cells were written, or while they are.
    pub(crate) fn touch(&mut self) {
        self.halo = Halo::Stale;
    }

    /// After a pass in which all rows were written, and continued into the halo if anyone reads it there.
    pub(crate) fn written(&mut self, second: bool) {
        if let Some(next) = &mut self.next
            && second
        {
            std::mem::swap(&mut self.current, next);
        }
        self.halo = if self.read_elsewhere { Halo::Rows } else { Halo::Stale };
    }

    /// Makes the halo that of the cells. What lies beyond flat faces never changes.
    pub(crate) fn refresh(&mut self, layout: &Layout) {
        let [along_rows, elsewhere] = layout.halo_follows();
        let continued = self.halo == Halo::Rows;
        if self.halo != Halo::Whole && (elsewhere || (along_rows && !continued)) {
            layout.fill_halo(self.current.bytes_mut(), self.stored.size(), None, continued);
        }
        self.halo = Halo::Whole;
    }

    pub(crate) fn read(&self, layout: &Layout) -> Vec<u8> {
        let size = self.stored.size();
        let row_size = layout.width() * size;
        let mut values = Vec::with_capacity(layout.rows() * row_size);
        for row in 0..layout.rows() {
            values.extend_from_slice(self.row(layout, row));
        }
        values
    }

    /// The values of a row of the space.
    pub(crate) fn row(&self, layout: &Layout, row: usize) -> &[u8] {
        let size = self.stored.size();
        &self.current.bytes()[layout.first(row) * size..(layout.first(row) + layout.width()) * size]
    }

    pub(crate) fn write(&mut self, layout: &Layout, values: &[u8]) {
        let size = self.stored.size();
        let row_size = layout.width() * size;
        for (row, values) in values.chunks_exact(row_size).enumerate() {
            let first = layout.first(row) * size;
            self.current.bytes_mut()[first..first + row_size].copy_from_slice(values);
        }
        self.touch();
    }

    /// The values of the cells with these linear indices.
    pub(crate) fn read_cells(&self, layout: &Layout, cells: &[usize]) -> Vec<u8> {
        let size = self.stored.size();
        let mut values = Vec::with_capacity(cells.len() * size);
        for cell in cells {
            let first = layout.padded(*cell) * size;
            values.extend_from_slice(&self.current.bytes()[first..first + size]);
        }
        values
    }

    pub(crate) fn write_cells(&mut self, layout: &Layout, cells: &[usize], values: &[u8]) {
        let size = self.stored.size();
        let current = self.current.bytes_mut();
        for (cell, value) in cells.iter().zip(values.chunks_exact(size)) {
            let first = layout.padded(*cell) * size;
            current[first..first + size].copy_from_slice(value);
        }
        self.touch();
    }

    pub(crate) fn memory(&self) -> usize {
        self.current.capacity() + self.next.as_ref().map_or(0, Buffer::capacity)
    }
}
