//! Substates of cells: a plane each, with a halo.

use crate::layout::Layout;
use xca_core::StoredType;
use xca_core::storage::Buffer;

/// One substate of cells.
pub(crate) struct Plane {
    pub(crate) stored: StoredType,
    pub(crate) current: Buffer,
    /// Where a process writes that also reads neighbours; made when there is such a process.
    pub(crate) next: Option<Buffer>,
    /// Whether the halo of `current` is that of its cells.
    fresh: bool,
}

impl Plane {
    pub(crate) fn new(stored: StoredType, layout: &Layout, outside: &[u8], doubled: bool) -> Self {
        let mut current = Buffer::zeroed(layout.cells() * stored.size());
        fill(&mut current, stored.size(), layout, Some(outside));
        let next = doubled.then(|| current.clone());
        Self { stored, current, next, fresh: true }
    }

    /// After cells were written.
    pub(crate) fn touch(&mut self) {
        self.fresh = false;
    }

    /// After all cells were written to the second buffer.
    pub(crate) fn swap(&mut self) {
        if let Some(next) = &mut self.next {
            std::mem::swap(&mut self.current, next);
        }
        self.fresh = false;
    }

    /// Makes the halo that of the cells. What lies beyond flat faces never changes.
    pub(crate) fn refresh(&mut self, layout: &Layout) {
        if !self.fresh && layout.halo_follows() {
            fill(&mut self.current, self.stored.size(), layout, None);
        }
        self.fresh = true;
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

    pub(crate) fn cell(&self, layout: &Layout, cell: usize) -> &[u8] {
        let (first, size) = (layout.padded(cell), self.stored.size());
        &self.current.bytes()[first * size..(first + 1) * size]
    }

    pub(crate) fn write_cell(&mut self, layout: &Layout, cell: usize, value: &[u8]) {
        let (first, size) = (layout.padded(cell), self.stored.size());
        self.current.bytes_mut()[first * size..(first + 1) * size].copy_from_slice(value);
        self.touch();
    }

    pub(crate) fn memory(&self) -> usize {
        self.current.capacity() + self.next.as_ref().map_or(0, Buffer::capacity)
    }
}

/// Fills the halo; beyond flat faces with the outside value, where one is given.
fn fill(buffer: &mut Buffer, size: usize, layout: &Layout, outside: Option<&[u8]>) {
    let bytes = buffer.bytes_mut();
    layout.fill_halo(|target, source, count| match (source, outside) {
        (Some(source), _) if count == 1 => copy_one(bytes, size, source, target),
        (Some(source), _) => bytes.copy_within(source * size..(source + count) * size, target * size),
        (None, Some(outside)) => {
            for value in bytes[target * size..(target + count) * size].chunks_exact_mut(size) {
                value.copy_from_slice(outside);
            }
        }
        (None, None) => {}
    });
}

/// Copies one value. Along x the halo is made of single values, for which a call to the system's copy would cost more than the values.
fn copy_one(bytes: &mut [u8], size: usize, source: usize, target: usize) {
    match size {
        1 => bytes[target] = bytes[source],
        4 => copy_chunk::<4>(bytes, source, target),
        8 => copy_chunk::<8>(bytes, source, target),
        _ => bytes.copy_within(source * size..(source + 1) * size, target * size),
    }
}

fn copy_chunk<const SIZE: usize>(bytes: &mut [u8], source: usize, target: usize) {
    let (chunks, _) = bytes.as_chunks_mut::<SIZE>();
    chunks[target] = chunks[source];
}
