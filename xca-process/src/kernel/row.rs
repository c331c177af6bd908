//! A row of cells, or the items of a row of cells.
#![allow(unsafe_code)]

use super::{
    BEYOND_NEIGHBOURHOOD, Blocks, Column, Columns, Draws, Entry, Frame, NativeSpace, RowItems, Scratch,
};
use crate::float::Float;
use std::cell::Cell;
use std::marker::PhantomData;
use std::ops::Range;
use xca_values::Vector3;

/// A fault that a process reported.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RowFault {
    /// The linear index of the cell.
    pub cell: u32,
    /// The label of the item, in a process over items.
    pub label: Option<u32>,
    /// The code.
    pub code: u32,
    /// The value.
    pub value: f64,
}

/// The place at which a kernel panicked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StoppedAt {
    /// The linear index of the cell.
    pub cell: u32,
    /// The label of the item, in a process over items.
    pub label: Option<u32>,
}

/// The place of a kernel in its row. Only a panic drops it, and the drop records the place in the row. A
/// kernel that ends calls [`Self::leave`]. The place therefore stays in registers, and costs nothing if
/// nothing can panic.
#[derive(Debug)]
pub struct Place<'r, 'a> {
    /// The index of the cell in the row, in a process over cells.
    pub x: usize,
    /// The index of the item, in a process over items.
    pub item: Option<usize>,
    row: &'r Row<'a>,
}

impl Place<'_, '_> {
    /// Ends the row.
    #[inline(always)]
    pub fn leave(self) {
        std::mem::forget(self);
    }
}

impl Drop for Place<'_, '_> {
    #[inline(always)]
    fn drop(&mut self) {
        self.row.stop(self.x, self.item);
    }
}

/// A row of cells, for a kernel.
pub struct Row<'a> {
    pub(super) frame: &'a Frame<'a>,
    pub(super) entries: &'a [Entry],
    pub(super) items: Option<RowItems<'a>>,
    destinations: Cell<Option<&'a mut [u32]>>,
    pub(super) scratch: &'a Scratch,
    pub(super) origin: [u32; 3],
    /// The linear index of the first cell.
    first_cell: u32,
    pub(super) length: usize,
    /// The entries that the kernel has requested for writing.
    pub(super) taken: Cell<u128>,
    /// The largest search radius so far.
    pub(super) widest: Cell<f64>,
    /// The radius, as bits, for which the lists have been searched for all items.
    pub(super) walked: Cell<Option<u64>>,
    /// Whether the kernel has requested a random number or the number of the step.
    asked_for_step: Cell<bool>,
    fault: Cell<Option<RowFault>>,
    stopped: Cell<Option<StoppedAt>>,
}

impl std::fmt::Debug for Row<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Row")
            .field("origin", &self.origin)
            .field("length", &self.length)
            .finish_non_exhaustive()
    }
}

impl<'a> Row<'a> {
    /// Describes a row of `length` cells along x, the first of which has the indices `origin`.
    ///
    /// # Safety
    /// For the lifetime `'a`, and for every entry (that is not null, aligned for its elements):
    /// - each plane of cells can be read at every cell of the row and, with `around`, at all of
    ///   `frame.offsets` from there;
    /// - of items, the row's own can be read, and with `all` as many as `labels.len()`;
    /// - no one writes meanwhile what can be read by this (other rows' cells and own items may be written by
    ///   other threads);
    /// - `length` elements of each plane of cells at `write` are this row's alone;
    /// - the row's own items at `write` are this row's alone;
    /// - `write` does not overlap what can be read through any entry, except another entry's `read` of cells
    ///   or own items of the same substate;
    /// - `starts` and `ends` can be read at every cell of the row and at all offsets from there;
    /// - they hold ranges within `labels.len()`, those of the row's cells within `own`, and `own` lies within
    ///   `labels.len()`.
    pub unsafe fn new(
        frame: &'a Frame<'a>,
        entries: &'a [Entry],
        items: Option<RowItems<'a>>,
        destinations: Option<&'a mut [u32]>,
        scratch: &'a Scratch,
        origin: [u32; 3],
        length: usize,
    ) -> Self {
        let [width, height, _] = frame.extents;
        Self {
            frame,
            entries,
            items,
            destinations: Cell::new(destinations),
            scratch,
            origin,
            first_cell: (origin[2] * height + origin[1]) * width + origin[0],
            length,
            taken: Cell::new(0),
            widest: Cell::new(0.0),
            walked: Cell::new(None),
            asked_for_step: Cell::new(false),
            fault: Cell::new(None),
            stopped: Cell::new(None),
        }
    }

    /// The first fault in the row, by cell and label.
    pub fn first_fault(&self) -> Option<RowFault> {
        self.fault.get()
    }

    /// Whether the kernel has requested a random number or the number of the step. If not, its results do not
    /// depend on the step.
    pub fn has_asked_for_step(&self) -> bool {
        self.asked_for_step.get()
    }

    /// The random numbers of the row.
    #[inline(always)]
    pub fn draws(&self) -> Draws {
        let Frame { stream, step, seed, extents, .. } = *self.frame;
        // A space has at least one cell along x.
        Draws::new((stream, step, seed), self.first_cell, extents[0])
    }

    /// Records the requests of a kernel at its end.
    #[inline(always)]
    pub fn has_drawn(&self, draws: &Draws) {
        if draws.is_asked() {
            self.asked_for_step.set(true);
        }
    }

    /// The place at which the kernel panicked. The first cell if it panicked before it began.
    pub fn stopped_at(&self) -> StoppedAt {
        self.stopped.get().unwrap_or_else(|| StoppedAt { cell: self.cell(0), label: None })
    }

    /// The place of a kernel that is about to begin.
    #[inline(always)]
    pub fn place(&self) -> Place<'_, 'a> {
        Place { x: 0, item: None, row: self }
    }

    #[cold]
    fn stop(&self, x: usize, item: Option<usize>) {
        let x = item.map_or(x, |item| self.column_of(item - self.first_item()).number());
        let label = self.items.zip(item).and_then(|(items, item)| items.labels.get(item).copied());
        self.stopped.set(Some(StoppedAt { cell: self.cell(x), label }));
    }

    /// The number of cells.
    #[inline(always)]
    pub fn length(&self) -> usize {
        self.length
    }

    /// A struct of parameters. `None` if the model lacks this type, which building the model prevents.
    #[inline(always)]
    pub fn parameters<P: 'static>(&self) -> Option<&'a P> {
        self.frame.parameters.iter().find_map(|parameters| parameters.downcast_ref())
    }

    /// The space.
    #[inline(always)]
    pub fn space<'b, R: Float>(&'b self, draws: &'b Draws) -> NativeSpace<'b, R> {
        NativeSpace::new(self.frame, draws)
    }

    /// The cells of the row.
    #[inline(always)]
    pub fn columns(&self) -> Columns<'_> {
        Columns { first: 0, lanes: 0..self.length, row: PhantomData }
    }

    /// The cells of the row, in blocks of at most `most` cells.
    #[inline(always)]
    pub fn blocks(&self, most: usize) -> Blocks<'_> {
        Blocks { rest: 0..self.length, most, row: PhantomData }
    }

    /// The cell with this index, or the last cell if there is none.
    #[inline(always)]
    pub(super) fn column(&self, number: usize) -> Column<'_> {
        Column { first: 0, lane: number.min(self.length.saturating_sub(1)), row: PhantomData }
    }

    /// The index of the row's first own item.
    #[inline(always)]
    pub fn first_item(&self) -> usize {
        self.items.map_or(0, |items| items.own.0)
    }

    /// The number of the row's own items.
    #[inline(always)]
    pub fn own_items(&self) -> usize {
        self.items.map_or(0, |items| items.own.1 - items.own.0)
    }

    /// The cell of an own item, given by its index among the own items. It cannot panic, so that a kernel
    /// that does not use the cell pays nothing for it.
    #[inline(always)]
    pub fn column_of(&self, number: usize) -> Column<'_> {
        let cell = self.items.and_then(|items| items.cells.get(number).copied()).unwrap_or_default();
        self.column(cell.wrapping_sub(self.cell(0)) as usize)
    }

    /// The results of a migration, one for each own item of the row.
    #[inline(always)]
    pub fn destinations(&self) -> &'a mut [u32] {
        self.destinations.take().unwrap_or_default()
    }

    /// The items of a cell of the row.
    #[inline(always)]
    pub fn items(&self, cell: Column<'_>) -> Range<usize> {
        // SAFETY: the cell itself.
        unsafe { self.items_at(cell, 0) }
    }

    /// The items of a cell near a cell of the row.
    ///
    /// # Safety
    /// The distance is 0 or that of a cell of the neighbourhood.
    #[inline(always)]
    pub(super) unsafe fn items_at(&self, cell: Column<'_>, distance: isize) -> Range<usize> {
        let Some(items) = &self.items else { return 0..0 };
        let at = cell.number() as isize + distance;
        // SAFETY: `Row::new`: readable at every cell of the row and at all offsets from there; the column is
        // this row's.
        unsafe { *items.starts.offset(at) as usize..*items.ends.offset(at) as usize }
    }

    /// The label of an item.
    #[inline(always)]
    pub fn label(&self, item: usize) -> u32 {
        self.items.map_or(0, |items| items.labels[item])
    }

    /// Records a fault of an item or cell of the row. The first one stays.
    #[cold]
    pub fn report<R: Float>(&self, x: usize, label: Option<u32>, code: u32, value: R) {
        if self.fault.get().is_none() {
            self.fault.set(Some(RowFault { cell: self.cell(x), label, code, value: value.to_f64() }));
        }
    }

    /// Records a neighbour index beyond the neighbourhood.
    #[cold]
    pub fn beyond_neighbourhood(&self, x: usize, index: usize) {
        // Indices have 32 bits on other engines and in the message.
        let index = u32::try_from(index).unwrap_or(u32::MAX);
        self.report(x, None, BEYOND_NEIGHBOURHOOD, f64::from(index));
    }

    /// The linear index of a cell of the row.
    #[inline(always)]
    pub fn cell(&self, x: usize) -> u32 {
        self.first_cell + x as u32
    }

    /// The indices of a cell of the row.
    #[inline(always)]
    pub fn index(&self, x: usize) -> Vector3<i32> {
        let [first, y, z] = self.origin;
        Vector3::new(first as i32 + x as i32, y as i32, z as i32)
    }
}
