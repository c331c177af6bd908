//! What native kernels run on: a row of cells, or the items of a row of cells.
//!
//! An engine describes a row by a [`Row`]; a kernel, made by the macros, asks it for the substates that its process declares
//! (its [`Access`] list) and works through the row. One dynamic call serves a whole row, and inside it everything is
//! monomorphic, so that the compiler can vectorise.
//!
//! This module is for engines and for code that the macros write. Its functions trust the numbers that such code passes:
//! entries that are in the process's list, with the types of the schema, each asked for once a row.
#![allow(unsafe_code)]

use crate::random::{self, Owner};
use crate::schema::Schema;
use crate::value::Float;
use crate::vector::Vector3;
use bytemuck::Pod;
use std::any::{Any, TypeId};
use std::cell::Cell;
use std::marker::PhantomData;
use std::ops::Range;

mod constants;
mod search;
mod space;
mod wide;

pub use constants::{KernelConstant, constant};
pub use search::{CellFilter, Found, Scratch, reach};
pub use space::NativeSpace;

/// A migration's answer: the item stays where it is.
pub const STAY: u32 = u32::MAX;
/// A migration's answer: the item leaves the space.
pub const OUTSIDE: u32 = u32::MAX - 1;
/// A migration's answer: the position is no number.
pub const NOWHERE: u32 = u32::MAX - 2;
/// The code of the fault that a neighbour index beyond the neighbourhood is.
pub const BEYOND_NEIGHBOURHOOD: u32 = u32::MAX;

/// A kernel: runs a process over one row.
pub type RowKernel = fn(&Row<'_>);

/// A group of substates that a process works with.
#[derive(Debug, Clone, Copy)]
pub struct Group {
    /// The type of the struct.
    pub type_id: fn() -> TypeId,
    /// Its fields.
    pub schema: &'static Schema,
}

/// Which of a process's groups an access belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Of {
    /// The cell or item that the process runs for.
    Subject,
    /// The cell of the item, or the items of the cell.
    Companion,
}

/// How a process uses one substate; derived from its body.
#[derive(Debug, Clone, Copy)]
pub struct Access {
    /// Whose substate.
    pub of: Of,
    /// The number of the field.
    pub field: usize,
    /// Read at the centre.
    pub centre: bool,
    /// Read at neighbours, or of other items.
    pub others: bool,
    /// Written.
    pub write: bool,
}

/// One substate as a kernel reaches it.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// Of cells: the value in the row's first cell. Of items: the value of the first item of all.
    pub read: *const u8,
    /// Where results go: of cells, the row's first cell; of items, the row's first item. The same memory as `read` exactly where
    /// the process reads the substate at the centre only.
    pub write: *mut u8,
}

/// What is the same in all rows of a step.
#[derive(Debug, Clone, Copy)]
pub struct Frame<'a> {
    /// The number of cells along x, y, z.
    pub extents: [u32; 3],
    /// The side of a cell in metres.
    pub side: f64,
    /// Which axes are toroidal.
    pub toroidal: [bool; 3],
    /// The number of the step, from 0.
    pub step: u64,
    /// The seed of the run's random numbers.
    pub seed: u64,
    /// `P::Native<R>` of the model's parameters.
    pub parameters: &'a (dyn Any + Send + Sync),
    /// The distance in elements from a cell to each cell of its neighbourhood, index 0 being the cell itself.
    pub offsets: &'a [isize],
    /// Which cells a search can leave out; nothing to look at all of them.
    pub filter: Option<&'a CellFilter>,
}

/// Where the items of a row's cells and of their neighbours are.
#[derive(Debug, Clone, Copy)]
pub struct RowItems<'a> {
    /// The first item of the row's first cell; at an offset, of that neighbour.
    pub starts: *const u32,
    /// One past the last item, likewise.
    pub ends: *const u32,
    /// The labels of all items.
    pub labels: &'a [u32],
    /// The row's own items: no other row shares them.
    pub own: (usize, usize),
}

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

/// Where a kernel has panicked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StoppedAt {
    /// The linear index of the cell.
    pub cell: u32,
    /// The label of the item, in a process over items.
    pub label: Option<u32>,
}

/// Where a kernel is in its row. It tells the row when it is dropped, which only a panic does; a kernel that arrives leaves it by
/// [`Self::leave`]. So it lives in registers, and costs nothing where nothing can panic.
#[derive(Debug)]
pub struct Place<'r, 'a> {
    /// The number of the cell in the row.
    pub x: usize,
    /// The number of the item, in a process over items.
    pub item: Option<usize>,
    row: &'r Row<'a>,
}

impl Place<'_, '_> {
    /// At the end of the row.
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

/// A row of cells as a kernel sees it.
pub struct Row<'a> {
    frame: &'a Frame<'a>,
    entries: &'a [Entry],
    items: Option<RowItems<'a>>,
    destinations: Cell<Option<&'a mut [u32]>>,
    scratch: &'a Scratch,
    origin: [u32; 3],
    length: usize,
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
    /// For the lifetime `'a`, and for the process whose kernel runs on this row:
    /// - there is one entry for each access of the process, in order, aligned for its type;
    /// - an entry of cells can be read at every cell of the row and, where the access reads neighbours, at all of `frame.offsets` from there;
    ///   where it is written, `length` elements at `write` are this row's alone;
    /// - an entry of items can be read at every item up to `labels.len()`; where it is written, the elements of the row's own items at
    ///   `write` are this row's alone;
    /// - `write` is apart from everything readable, except that a substate read at the centre only is the same memory;
    /// - `starts` and `ends` can be read at every cell of the row and at all offsets from there, hold ranges within
    ///   `labels.len()`, and the ranges of the row's cells lie within `own`.
    pub unsafe fn new(
        frame: &'a Frame<'a>,
        entries: &'a [Entry],
        items: Option<RowItems<'a>>,
        destinations: Option<&'a mut [u32]>,
        scratch: &'a Scratch,
        origin: [u32; 3],
        length: usize,
    ) -> Self {
        Self {
            frame,
            entries,
            items,
            destinations: Cell::new(destinations),
            scratch,
            origin,
            length,
            fault: Cell::new(None),
            stopped: Cell::new(None),
        }
    }

    /// The first fault in the row, in the order of cells and labels.
    pub fn first_fault(&self) -> Option<RowFault> {
        self.fault.get()
    }

    /// Where the kernel was when it panicked: in the first cell if that was before it began.
    pub fn stopped_at(&self) -> StoppedAt {
        self.stopped.get().unwrap_or_else(|| StoppedAt { cell: self.cell(0), label: None })
    }

    /// Where a kernel is that is about to begin.
    #[inline(always)]
    pub fn place(&self) -> Place<'_, 'a> {
        Place { x: 0, item: None, row: self }
    }

    #[cold]
    fn stop(&self, x: usize, item: Option<usize>) {
        let label = self.items.zip(item).and_then(|(items, item)| items.labels.get(item).copied());
        self.stopped.set(Some(StoppedAt { cell: self.cell(x), label }));
    }

    /// The number of cells.
    #[inline(always)]
    pub fn length(&self) -> usize {
        self.length
    }

    /// The size of the neighbourhood.
    #[inline(always)]
    pub fn neighbours(&self) -> usize {
        self.frame.offsets.len()
    }

    /// The parameters; nothing where they are of another type, which building the model has excluded.
    #[inline(always)]
    pub fn parameters<P: 'static>(&self) -> Option<&'a P> {
        self.frame.parameters.downcast_ref()
    }

    /// The space.
    #[inline(always)]
    pub fn space<R: Float>(&self) -> NativeSpace<'a, R> {
        NativeSpace::new(self.frame)
    }

    /// The neighbourhood: of exactly `K` cells, or of any number where `K` is 0.
    #[inline(always)]
    pub fn offsets<const K: usize>(&self) -> Offsets<'a, K> {
        let fixed = self.frame.offsets.first_chunk().copied().unwrap_or([0; K]);
        Offsets { fixed, any: self.frame.offsets }
    }

    /// A substate of cells, to be read.
    #[inline(always)]
    pub fn read_cells<T: Pod>(&self, entry: usize) -> CellRead<'a, T> {
        CellRead { first: self.entries[entry].read.cast(), row: PhantomData }
    }

    /// A substate of the row's cells, to be written.
    #[inline(always)]
    #[allow(clippy::mut_from_ref, reason = "each written entry is asked for once, see the module")]
    pub fn write_cells<T: Pod>(&self, entry: usize) -> &'a mut [T] {
        // SAFETY: `Row::new`: `length` elements, aligned, this row's alone; asked for once.
        unsafe { std::slice::from_raw_parts_mut(self.entries[entry].write.cast(), self.length) }
    }

    /// A substate of all items, to be read.
    #[inline(always)]
    pub fn read_items<T: Pod>(&self, entry: usize) -> &'a [T] {
        let count = self.items.map_or(0, |items| items.labels.len());
        // SAFETY: `Row::new`: as many elements as labels, aligned, and not written through another entry.
        unsafe { std::slice::from_raw_parts(self.entries[entry].read.cast(), count) }
    }

    /// A substate of the row's own items, to be written; element 0 belongs to item [`Self::first_item`].
    #[inline(always)]
    #[allow(clippy::mut_from_ref, reason = "each written entry is asked for once, see the module")]
    pub fn write_items<T: Pod>(&self, entry: usize) -> &'a mut [T] {
        let (first, end) = self.items.map_or((0, 0), |items| items.own);
        // SAFETY: `Row::new`: the row's own items, aligned, this row's alone; asked for once.
        unsafe { std::slice::from_raw_parts_mut(self.entries[entry].write.cast(), end - first) }
    }

    /// The number of the row's first own item.
    #[inline(always)]
    pub fn first_item(&self) -> usize {
        self.items.map_or(0, |items| items.own.0)
    }

    /// The answers of a migration, one for each own item of the row.
    #[inline(always)]
    pub fn destinations(&self) -> &'a mut [u32] {
        self.destinations.take().unwrap_or_default()
    }

    /// The items of a cell of the row.
    #[inline(always)]
    pub fn items(&self, x: usize) -> Range<usize> {
        self.items_at(x, 0)
    }

    #[inline(always)]
    fn items_at(&self, x: usize, offset: isize) -> Range<usize> {
        debug_assert!(x < self.length);
        let Some(items) = &self.items else { return 0..0 };
        let at = x as isize + offset;
        // SAFETY: `Row::new`: readable at every cell of the row and at all offsets from there.
        unsafe { *items.starts.offset(at) as usize..*items.ends.offset(at) as usize }
    }

    /// The label of an item.
    #[inline(always)]
    pub fn label(&self, item: usize) -> u32 {
        self.items.map_or(0, |items| items.labels[item])
    }

    /// Records a fault of an item or cell of the row; the first one stays.
    #[cold]
    pub fn report<R: Float>(&self, x: usize, label: Option<u32>, code: u32, value: R) {
        if self.fault.get().is_none() {
            self.fault.set(Some(RowFault { cell: self.cell(x), label, code, value: value.to_f64() }));
        }
    }

    /// Records that a neighbour index lies beyond the neighbourhood.
    #[cold]
    pub fn beyond_neighbourhood(&self, x: usize, index: u32) {
        self.report(x, None, BEYOND_NEIGHBOURHOOD, f64::from(index));
    }

    /// The linear index of a cell of the row.
    #[inline(always)]
    pub fn cell(&self, x: usize) -> u32 {
        let [width, height, _] = self.frame.extents;
        (self.origin[2] * height + self.origin[1]) * width + self.origin[0] + x as u32
    }

    /// The indices of a cell of the row.
    #[inline(always)]
    pub fn index(&self, x: usize) -> Vector3<i32> {
        let [first, y, z] = self.origin;
        Vector3::new(first as i32 + x as i32, y as i32, z as i32)
    }

    /// Random bits of a cell of the row.
    #[inline]
    pub fn random_bits(&self, x: usize, draw: u32) -> u32 {
        random::draw_words(self.frame.seed, self.frame.step, Owner::Cell(self.cell(x)), draw)[0]
    }

    /// A random number of a cell of the row.
    #[inline]
    pub fn random<R: Float>(&self, x: usize, draw: u32) -> R {
        let words = random::draw_words(self.frame.seed, self.frame.step, Owner::Cell(self.cell(x)), draw);
        R::uniform([words[0], words[1]])
    }

    /// Random bits of an item.
    #[inline]
    pub fn item_random_bits(&self, item: usize, draw: u32) -> u32 {
        random::draw_words(self.frame.seed, self.frame.step, Owner::Item(self.label(item)), draw)[0]
    }

    /// A random number of an item.
    #[inline]
    pub fn item_random<R: Float>(&self, item: usize, draw: u32) -> R {
        let words = random::draw_words(self.frame.seed, self.frame.step, Owner::Item(self.label(item)), draw);
        R::uniform([words[0], words[1]])
    }
}

/// The neighbourhood of a row's cells: `K` offsets known to the compiler by number, or any number where `K` is 0.
#[derive(Debug, Clone, Copy)]
pub struct Offsets<'a, const K: usize> {
    fixed: [isize; K],
    any: &'a [isize],
}

impl<const K: usize> Offsets<'_, K> {
    /// The number of cells.
    #[inline(always)]
    pub fn count(&self) -> u32 {
        if K > 0 { K as u32 } else { self.any.len() as u32 }
    }

    /// The offset of the neighbour with this index. Beyond the neighbourhood it is a fault, and the cell itself is read.
    #[inline(always)]
    pub fn at(&self, index: u32, row: &Row<'_>, x: usize) -> isize {
        let offset = if K > 0 {
            self.fixed.get(index as usize).copied()
        } else {
            self.any.get(index as usize).copied()
        };
        offset.unwrap_or_else(|| {
            row.beyond_neighbourhood(x, index);
            0
        })
    }
}

/// A substate of cells, readable at a row's cells and their neighbours.
#[derive(Debug, Clone, Copy)]
pub struct CellRead<'a, T> {
    first: *const T,
    row: PhantomData<&'a T>,
}

impl<T: Pod> CellRead<'_, T> {
    /// The value at an offset from a cell of the row; `x` is below the row's length and the offset one of the neighbourhood.
    #[inline(always)]
    pub fn at(&self, x: usize, offset: isize) -> T {
        // SAFETY: `Row::new`: readable at every cell of the row and at all offsets from there.
        unsafe { *self.first.offset(x as isize + offset) }
    }
}
