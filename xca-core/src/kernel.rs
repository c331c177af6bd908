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
use std::cell::{Cell, RefCell};
use std::marker::PhantomData;
use std::ops::Range;

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

/// Lists that searches fill, kept from row to row.
#[derive(Debug, Default)]
pub struct Scratch {
    free: RefCell<Vec<Vec<u32>>>,
}

/// A list borrowed from a [`Scratch`].
#[derive(Debug)]
pub struct Found<'a> {
    /// The numbers of the items.
    pub items: Vec<u32>,
    scratch: &'a Scratch,
}

impl Drop for Found<'_> {
    fn drop(&mut self) {
        self.scratch.free.borrow_mut().push(std::mem::take(&mut self.items));
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
    #[expect(clippy::too_many_arguments, reason = "called by engines alone, which have all of it at hand")]
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
        }
    }

    /// The first fault in the row, in the order of cells and labels.
    pub fn first_fault(&self) -> Option<RowFault> {
        self.fault.get()
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
        NativeSpace { frame: self.frame, real: PhantomData }
    }

    /// The neighbourhood: of exactly `K` cells, or of any number where `K` is 0.
    #[inline(always)]
    pub fn offsets<const K: usize>(&self) -> Offsets<'a, K> {
        let mut fixed = [0; K];
        for (fixed, offset) in fixed.iter_mut().zip(self.frame.offsets) {
            *fixed = *offset;
        }
        Offsets { fixed, any: self.frame.offsets }
    }

    /// A substate of cells, to be read.
    #[inline(always)]
    pub fn read_cells<T: Pod>(&self, entry: usize) -> CellRead<'a, T> {
        CellRead { first: self.entries[entry].read.cast(), row: PhantomData }
    }

    /// A substate of the row's cells, to be written.
    #[inline(always)]
    #[expect(clippy::mut_from_ref, reason = "each written entry is asked for once, see the module")]
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
    #[expect(clippy::mut_from_ref, reason = "each written entry is asked for once, see the module")]
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

    /// A list for the results of searches.
    pub fn found(&self) -> Found<'a> {
        let items = self.scratch.free.borrow_mut().pop().unwrap_or_default();
        Found { items, scratch: self.scratch }
    }

    /// Fills the list with the items of the reached cells of the neighbourhood, without the item itself.
    #[inline]
    pub fn others<const REACH: u8>(&self, x: usize, item: usize, found: &mut Vec<u32>) {
        found.clear();
        for range in self.reached::<REACH>(x) {
            found.extend(range.filter(|&other| other != item).map(|other| other as u32));
        }
    }

    /// Fills the list with those items of the reached cells whose position is nearer to `position` than `radius`, without the
    /// item itself.
    #[inline]
    pub fn others_within<R: Float, const REACH: u8>(
        &self,
        x: usize,
        item: usize,
        position: Vector3<R>,
        radius: R,
        positions: &[Vector3<R>],
        found: &mut Vec<u32>,
    ) {
        found.clear();
        let reach = radius * radius;
        let nearest_image = self.frame.toroidal.contains(&true);
        for range in self.reached::<REACH>(x) {
            let first = range.start;
            found.reserve(range.len());
            for (index, other) in positions[range].iter().enumerate() {
                let mut separation = position - *other;
                if nearest_image {
                    separation = self.nearest_image(separation);
                }
                let near =
                    separation.x * separation.x + separation.y * separation.y + separation.z * separation.z
                        < reach;
                let number = first + index;
                if near && number != item {
                    found.push(number as u32);
                }
            }
        }
    }

    /// The separation by the shorter way round each toroidal axis.
    #[inline]
    fn nearest_image<R: Float>(&self, separation: Vector3<R>) -> Vector3<R> {
        let along = |value: R, axis: usize| {
            if !self.frame.toroidal[axis] {
                return value;
            }
            let period = R::from_f64(f64::from(self.frame.extents[axis])) * R::from_f64(self.frame.side);
            let half = R::from_f64(0.5) * period;
            if value > half {
                value - period
            } else if value < R::default() - half {
                value + period
            } else {
                value
            }
        };
        Vector3::new(along(separation.x, 0), along(separation.y, 1), along(separation.z, 2))
    }

    /// The ranges of items in the reached cells in order of the neighbour index, joined where one continues the other.
    #[inline(always)]
    fn reached<const REACH: u8>(&self, x: usize) -> Reached<'_, 'a> {
        let (next, end) = match REACH {
            reach::CELL => (0, 1),
            reach::NEIGHBOURS => (1, self.frame.offsets.len()),
            _ => (0, self.frame.offsets.len()),
        };
        Reached { row: self, x, next, end }
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

/// Where a search looks; the constants are those of the macros.
pub mod reach {
    /// The own cell.
    pub const CELL: u8 = 0;
    /// The neighbours.
    pub const NEIGHBOURS: u8 = 1;
    /// Both.
    pub const ALL: u8 = 2;
}

struct Reached<'r, 'a> {
    row: &'r Row<'a>,
    x: usize,
    next: usize,
    end: usize,
}

impl Iterator for Reached<'_, '_> {
    type Item = Range<usize>;

    #[inline(always)]
    fn next(&mut self) -> Option<Range<usize>> {
        let mut joined: Range<usize> = 0..0;
        while self.next < self.end {
            let range = self.row.items_at(self.x, self.row.frame.offsets[self.next]);
            if range.is_empty() {
                self.next += 1;
            } else if joined.is_empty() {
                joined = range;
                self.next += 1;
            } else if joined.end == range.start {
                joined.end = range.end;
                self.next += 1;
            } else {
                break;
            }
        }
        (!joined.is_empty()).then_some(joined)
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

/// The cellular space in a kernel.
#[derive(Debug, Clone, Copy)]
pub struct NativeSpace<'a, R> {
    frame: &'a Frame<'a>,
    real: PhantomData<R>,
}

impl<R: Float> NativeSpace<'_, R> {
    /// The side of a cell in metres.
    #[inline(always)]
    pub fn side(&self) -> R {
        R::from_f64(self.frame.side)
    }

    /// The number of cells along x, y, z.
    #[inline(always)]
    pub fn extents(&self) -> Vector3<i32> {
        let [x, y, z] = self.frame.extents;
        Vector3::new(x as i32, y as i32, z as i32)
    }

    /// The low 32 bits of the number of the step.
    #[inline(always)]
    pub fn step(&self) -> u32 {
        self.frame.step as u32
    }

    /// The answer of a migration that sends an item to where its position is.
    #[inline(always)]
    pub fn cell_containing(&self, position: Vector3<R>) -> u32 {
        let side = self.side();
        let [width, height, depth] = self.frame.extents;
        let (Some(x), Some(y), Some(z)) = (
            R::cell_number(position.x, side),
            R::cell_number(position.y, side),
            R::cell_number(position.z, side),
        ) else {
            return if position.x == position.x && position.y == position.y && position.z == position.z {
                OUTSIDE
            } else {
                NOWHERE
            };
        };
        let inside = |number: i64, extent: u32| number >= 0 && number < i64::from(extent);
        if inside(x, width) && inside(y, height) && inside(z, depth) {
            (z as u32 * height + y as u32) * width + x as u32
        } else {
            OUTSIDE
        }
    }
}

/// Comparisons that give the same bits on every engine, whatever a processor's own minimum does with NaN and signed zeros.
pub trait Ordered: Copy + PartialOrd {
    /// `if other < self { other } else { self }`
    #[inline(always)]
    fn ordered_min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }

    /// `if self < other { other } else { self }`
    #[inline(always)]
    fn ordered_max(self, other: Self) -> Self {
        if self < other { other } else { self }
    }

    /// `self.max(low).min(high)`
    #[inline(always)]
    fn ordered_clamp(self, low: Self, high: Self) -> Self {
        self.ordered_max(low).ordered_min(high)
    }
}

impl<T: Copy + PartialOrd> Ordered for T {}

/// A constant of the user's code as a kernel of precision `R` sees it: `f64`, which is `Real` there, becomes `R`.
pub trait KernelConstant<R> {
    /// The type in the kernel.
    type Native;

    /// Converts it.
    fn native(self) -> Self::Native;
}

macro_rules! same_constant {
    ($($type:ident)*) => {$(
        impl<R> KernelConstant<R> for $type {
            type Native = $type;
            #[inline(always)]
            fn native(self) -> $type {
                self
            }
        }
    )*};
}

same_constant!(bool u8 i32 u32 usize f32);

impl<R: Float> KernelConstant<R> for f64 {
    type Native = R;
    #[inline(always)]
    fn native(self) -> R {
        R::from_f64(self)
    }
}

impl<R, T: KernelConstant<R>, const N: usize> KernelConstant<R> for [T; N] {
    type Native = [T::Native; N];
    #[inline(always)]
    fn native(self) -> Self::Native {
        self.map(T::native)
    }
}

macro_rules! vector_constant {
    ($($vector:ident { $($lane:ident),+ })*) => {$(
        impl<R, T: KernelConstant<R>> KernelConstant<R> for crate::vector::$vector<T> {
            type Native = crate::vector::$vector<T::Native>;
            #[inline(always)]
            fn native(self) -> Self::Native {
                crate::vector::$vector::new($(self.$lane.native()),+)
            }
        }
    )*};
}

vector_constant!(Vector2 { x, y } Vector3 { x, y, z } Vector4 { x, y, z, w });

/// Converts a constant of the user's code; called by what the macros write.
#[inline(always)]
pub fn constant<R, T: KernelConstant<R>>(value: T) -> T::Native {
    value.native()
}
