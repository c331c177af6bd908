//! Substates of cells: one plane for each element of a value, with a halo.

use crate::layout::Layout;
use std::borrow::Cow;
use std::ops::Range;
use xca_core::storage::Buffer;
use xca_core::{Face, Faces, StoredType};

/// One substate of cells: its planes, one after the other.
pub(crate) struct Dense {
    pub(crate) stored: StoredType,
    pub(crate) current: Buffer,
    /// The second buffer, for a process that writes the substate and also reads neighbours. `None` without
    /// such a process.
    pub(crate) next: Option<Buffer>,
    /// Whether a process of the model reads the substate elsewhere, and therefore the halo.
    pub(crate) read_elsewhere: bool,
    pub(crate) halo: Halo,
}

/// The part of a plane's halo that is up to date.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Halo {
    /// The whole halo.
    Whole,
    /// The continuation of the rows along x.
    Rows,
    /// None of it.
    Stale,
}

impl Dense {
    /// Creates the planes. `numbers` are the indices of the two buffers among all buffers of the model.
    pub(crate) fn new(
        stored: StoredType,
        layout: &Layout,
        (outside, numbers): (&Faces<Vec<u8>>, [usize; 2]),
        doubled: bool,
        read_elsewhere: bool,
    ) -> Self {
        let mut current = Buffer::zeroed_apart(layout.cells() * stored.size(), numbers[0]);
        let element = stored.element_size();
        let planes = current.bytes_mut().chunks_exact_mut(layout.cells() * element);
        for (number, plane) in planes.enumerate() {
            let outside = outside.map(|value| value[number * element..(number + 1) * element].to_vec());
            layout.fill_halo(plane, element, Some(&outside), false);
        }
        let next = doubled.then(|| {
            let mut next = Buffer::zeroed_apart(current.len(), numbers[1]);
            next.bytes_mut().copy_from_slice(current.bytes());
            next
        });
        let is_part = layout.borders() != Faces::all(false);
        let halo = if is_part { Halo::Stale } else { Halo::Whole };
        Self { stored, current, next, read_elsewhere, halo }
    }

    /// Marks the halo as stale, during or after a write of cells.
    pub(crate) fn touch(&mut self) {
        self.halo = Halo::Stale;
    }

    /// Records a pass that wrote all rows, and continued them into the halo if a process reads it there. The
    /// continuation is along x, or with `whole` beyond all faces.
    pub(crate) fn written(&mut self, second: bool, whole: bool) {
        self.swap(second);
        self.halo = match (self.read_elsewhere, whole) {
            (false, _) => Halo::Stale,
            (true, false) => Halo::Rows,
            (true, true) => Halo::Whole,
        };
    }

    /// Swaps the buffers, after a pass that wrote to the second one.
    pub(crate) fn swap(&mut self, second: bool) {
        if let Some(next) = &mut self.next
            && second
        {
            std::mem::swap(&mut self.current, next);
        }
    }

    /// Updates the halo. Values beyond flat faces never change.
    pub(crate) fn refresh(&mut self, layout: &Layout) {
        let [along_rows, elsewhere] = layout.halo_follows();
        let continued = self.halo == Halo::Rows;
        if self.halo != Halo::Whole && (elsewhere || (along_rows && !continued)) {
            let element = self.stored.element_size();
            for plane in self.current.bytes_mut().chunks_exact_mut(layout.cells() * element) {
                layout.fill_halo(plane, element, None, continued);
            }
        }
        self.halo = Halo::Whole;
    }

    /// Whether the halo is not up to date.
    pub(crate) fn is_stale(&self) -> bool {
        self.halo != Halo::Whole
    }

    /// Records a pass in which other parts may have written their cells.
    pub(crate) fn others_wrote(&mut self) {
        if self.halo == Halo::Whole {
            self.halo = Halo::Rows;
        }
    }

    /// Fills the halo along x and y, except for cells of other parts.
    pub(crate) fn fill_rows(&mut self, layout: &Layout) {
        let (element, continued) = (self.stored.element_size(), self.halo == Halo::Rows);
        for plane in self.current.bytes_mut().chunks_exact_mut(layout.cells() * element) {
            layout.fill_rows(plane, element, None, continued);
        }
    }

    /// Fills the halo along z, except for cells of other parts.
    pub(crate) fn fill_layers(&mut self, layout: &Layout) {
        let element = self.stored.element_size();
        for plane in self.current.bytes_mut().chunks_exact_mut(layout.cells() * element) {
            layout.fill_layers(plane, element, None);
        }
    }

    /// Records that the halo is up to date, also beyond the borders of the part.
    pub(crate) fn complete(&mut self) {
        self.halo = Halo::Whole;
    }

    /// The size of the message across a face, in bytes.
    pub(crate) fn edge(&self, layout: &Layout, face: Face) -> usize {
        layout.lines_at(face, true).count() * layout.line([0; 2]).len() * self.stored.size()
    }

    /// Appends the cells that another part sees across a face.
    pub(crate) fn pack(&self, layout: &Layout, face: Face, bytes: &mut Vec<u8>) {
        let element = self.stored.element_size();
        for plane in self.current.bytes().chunks_exact(layout.cells() * element) {
            for line in layout.lines_at(face, false) {
                let cells = layout.line(line);
                bytes.extend_from_slice(&plane[cells.start * element..cells.end * element]);
            }
        }
    }

    /// Fills the halo beyond a face with the message of the part there. [`Self::edge`] is its size.
    pub(crate) fn unpack(&mut self, layout: &Layout, face: Face, bytes: &[u8]) {
        let element = self.stored.element_size();
        let mut lines = bytes.chunks_exact(layout.line([0; 2]).len() * element);
        for plane in self.current.bytes_mut().chunks_exact_mut(layout.cells() * element) {
            for (line, bytes) in layout.lines_at(face, true).zip(&mut lines) {
                let cells = layout.line(line);
                plane[cells.start * element..cells.end * element].copy_from_slice(bytes);
            }
        }
    }

    /// The values of all cells. The elements of each value are contiguous.
    pub(crate) fn read(&self, layout: &Layout) -> Vec<u8> {
        let mut values = Vec::with_capacity(layout.rows() * layout.width() * self.stored.size());
        self.read_rows(layout, 0..layout.rows(), &mut values);
        values
    }

    /// Appends the values of the cells of these rows.
    pub(crate) fn read_rows(&self, layout: &Layout, rows: impl Iterator<Item = usize>, values: &mut Vec<u8>) {
        for row in rows {
            values.extend_from_slice(&self.row(layout, row));
        }
    }

    /// The elements with this index of the values of a row.
    pub(crate) fn row_of_plane(&self, layout: &Layout, row: usize, number: usize) -> &[u8] {
        let element = self.stored.element_size();
        let first = number * layout.cells() + layout.first(row);
        &self.current.bytes()[first * element..(first + layout.width()) * element]
    }

    /// The values of a row of the space.
    fn row(&self, layout: &Layout, row: usize) -> Cow<'_, [u8]> {
        let element = self.stored.element_size();
        let elements = self.stored.length as usize;
        if elements == 1 {
            return self.row_of_plane(layout, row, 0).into();
        }
        let mut values = vec![0; layout.width() * self.stored.size()];
        for number in 0..elements {
            let whole = values.chunks_exact_mut(self.stored.size());
            for (value, of_cell) in whole.zip(self.row_of_plane(layout, row, number).chunks_exact(element)) {
                value[number * element..(number + 1) * element].copy_from_slice(of_cell);
            }
        }
        values.into()
    }

    /// Replaces the values of the cells of these rows.
    pub(crate) fn write_rows(&mut self, layout: &Layout, rows: impl Iterator<Item = usize>, values: &[u8]) {
        let (size, element) = (self.stored.size(), self.stored.element_size());
        for (row, values) in rows.zip(values.chunks_exact(layout.width() * size)) {
            for number in 0..self.stored.length as usize {
                let first = (number * layout.cells() + layout.first(row)) * element;
                let plane = &mut self.current.bytes_mut()[first..first + layout.width() * element];
                if size == element {
                    plane.copy_from_slice(values);
                    continue;
                }
                for (of_cell, value) in plane.chunks_exact_mut(element).zip(values.chunks_exact(size)) {
                    of_cell.copy_from_slice(&value[number * element..(number + 1) * element]);
                }
            }
        }
        self.touch();
    }

    /// The byte ranges of the elements of a cell's value.
    fn places(&self, layout: &Layout, cell: usize) -> impl Iterator<Item = Range<usize>> + use<> {
        let (first, element, cells) = (layout.padded(cell), self.stored.element_size(), layout.cells());
        (0..self.stored.length as usize).map(move |number| {
            let start = (number * cells + first) * element;
            start..start + element
        })
    }

    /// The values of the cells with these linear indices.
    pub(crate) fn read_cells(&self, layout: &Layout, cells: &[usize]) -> Vec<u8> {
        let places = cells.iter().flat_map(|cell| self.places(layout, *cell));
        places.flat_map(|place| &self.current.bytes()[place]).copied().collect()
    }

    pub(crate) fn write_cells(&mut self, layout: &Layout, cells: &[usize], values: &[u8]) {
        let places: Vec<Range<usize>> = cells.iter().flat_map(|cell| self.places(layout, *cell)).collect();
        for (place, element) in places.into_iter().zip(values.chunks_exact(self.stored.element_size())) {
            self.current.bytes_mut()[place].copy_from_slice(element);
        }
        self.touch();
    }

    pub(crate) fn memory(&self) -> usize {
        self.current.capacity() + self.next.as_ref().map_or(0, Buffer::capacity)
    }
}
