//! Access of kernels to the substates of a row's cells and of their neighbours.
//!
//! A kernel reads only through a [`super::Row`]. The tokens [`Column`] and [`Offset`] address the values, and
//! come from the row too. A kernel therefore needs no unsafe code, and cannot reach memory of others.

use super::values::{KernelElement, KernelValue};
use super::work::announce_bytes;
use super::written::BLOCK_BYTES;
use std::fmt;
use std::marker::PhantomData;
use std::ops::Range;

/// The index of a cell in its row, below the row's length.
#[derive(Debug, Clone, Copy)]
pub struct Column<'r> {
    pub(super) first: usize,
    pub(super) lane: usize,
    pub(super) row: PhantomData<&'r ()>,
}

impl Column<'_> {
    /// The number.
    #[inline(always)]
    pub fn number(self) -> usize {
        self.first + self.lane
    }

    /// The index within its block.
    #[inline(always)]
    pub fn lane(self) -> usize {
        self.lane
    }
}

/// Consecutive cells of a row.
#[derive(Debug, Clone)]
pub struct Columns<'r> {
    pub(super) first: usize,
    pub(super) lanes: Range<usize>,
    pub(super) row: PhantomData<&'r ()>,
}

impl Columns<'_> {
    /// Their indices in the row.
    #[inline(always)]
    pub fn numbers(&self) -> Range<usize> {
        self.first + self.lanes.start..self.first + self.lanes.end
    }
}

impl<'r> Iterator for Columns<'r> {
    type Item = Column<'r>;

    #[inline(always)]
    fn next(&mut self) -> Option<Column<'r>> {
        Some(Column { first: self.first, lane: self.lanes.next()?, row: self.row })
    }
}

/// A row in blocks with a limited number of cells.
#[derive(Debug, Clone)]
pub struct Blocks<'r> {
    pub(super) rest: Range<usize>,
    pub(super) most: usize,
    pub(super) row: PhantomData<&'r ()>,
}

impl<'r> Iterator for Blocks<'r> {
    type Item = Columns<'r>;

    #[inline(always)]
    fn next(&mut self) -> Option<Columns<'r>> {
        let Range { start: first, end } = self.rest;
        let count = self.most.min(end - first);
        self.rest.start += count;
        (count > 0).then_some(Columns { first, lanes: 0..count, row: self.row })
    }
}

/// The distance from a cell to a cell of its neighbourhood.
#[derive(Debug, Clone, Copy)]
pub struct Offset<'r> {
    pub(super) distance: isize,
    pub(super) row: PhantomData<&'r ()>,
}

/// A substate of a row's cells and of their neighbours.
#[derive(Clone, Copy)]
pub struct AroundRead<'r, T: KernelValue> {
    pub(super) first: *const <T::Element as KernelElement>::Memory,
    pub(super) stride: usize,
    pub(super) row: PhantomData<&'r ()>,
}

impl<T: KernelValue> fmt::Debug for AroundRead<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("AroundRead").field("first", &self.first).field("stride", &self.stride).finish()
    }
}

impl<'r, T: KernelValue> AroundRead<'r, T> {
    #[inline(always)]
    fn read(&self, cell: Column<'r>, offset: Offset<'r>, element: usize) -> T::Element {
        assert!(element < T::LENGTH, "an element beyond the value");
        let place = cell.number() as isize + offset.distance + (element * self.stride) as isize;
        // SAFETY: `Row::new`: each plane can be read at every cell of the row and, if these can be had, at
        // all offsets of the neighbourhood from there. The column and the offset are of this row, and there
        // are `LENGTH` planes.
        #[allow(unsafe_code)]
        <T::Element as KernelElement>::from_memory(unsafe { *self.first.offset(place) })
    }

    /// The value of a cell of the neighbourhood.
    #[inline(always)]
    pub fn at(&self, cell: Column<'r>, offset: Offset<'r>) -> T {
        T::from_elements(|element| self.read(cell, offset, element))
    }

    /// The value of the cell itself.
    #[inline(always)]
    pub fn here(&self, cell: Column<'r>) -> T {
        self.at(cell, Offset { distance: 0, row: PhantomData })
    }
}

impl<'r, T: KernelElement, const N: usize> AroundRead<'r, [T; N]> {
    /// An element of the value of a cell of the neighbourhood.
    #[inline(always)]
    pub fn element(&self, cell: Column<'r>, offset: Offset<'r>, element: usize) -> T {
        check_element(element, N);
        self.read(cell, offset, element)
    }

    /// Prefetches an element of the neighbours of the next block of cells. The address may be invalid,
    /// because a prefetch reads nothing into the program.
    #[inline(always)]
    pub fn fetch(&self, columns: &Columns<'r>, offset: Offset<'r>, element: usize) {
        let next = columns.numbers().end as isize + offset.distance + (element * self.stride) as isize;
        let first = self.first.wrapping_offset(next).cast::<u8>();
        let bytes = columns.lanes.len() * size_of::<T::Memory>();
        // A row of one block has no next block, and is long enough for the processor's own prefetcher.
        if bytes <= BLOCK_BYTES {
            announce_bytes(first, bytes);
        }
    }

    /// An element of the value of the cell itself.
    #[inline(always)]
    pub fn element_here(&self, cell: Column<'r>, element: usize) -> T {
        self.element(cell, Offset { distance: 0, row: PhantomData }, element)
    }
}

/// A substate of a row's cells.
#[derive(Clone, Copy)]
pub struct CentreRead<'r, T: KernelValue> {
    pub(super) around: AroundRead<'r, T>,
}

impl<T: KernelValue> fmt::Debug for CentreRead<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("CentreRead").field(&self.around).finish()
    }
}

impl<'r, T: KernelValue> CentreRead<'r, T> {
    /// The value of a cell.
    #[inline(always)]
    pub fn here(&self, cell: Column<'r>) -> T {
        self.around.here(cell)
    }
}

impl<'r, T: KernelElement, const N: usize> CentreRead<'r, [T; N]> {
    /// An element of the value of a cell.
    #[inline(always)]
    pub fn element_here(&self, cell: Column<'r>, element: usize) -> T {
        self.around.element_here(cell, element)
    }
}

/// The message is that of arrays.
#[inline(always)]
fn check_element(element: usize, length: usize) {
    assert!(element < length, "index out of bounds: the len is {length} but the index is {element}");
}
