//! Where the substates of a row lie, and how a kernel is handed them: each is compared with what the kernel
//! takes it for, once a row.

use super::Row;
use super::cells::{AroundRead, CentreRead};
use super::values::{KernelElement, KernelValue};
use super::written::{Planes, Written};
use std::marker::PhantomData;

/// One substate as a kernel reaches it.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// Of cells: the first element's value in the row's first cell. Of items: the value of the first item of
    /// all. Null where the kernel reads through `write`: where the process writes the substate and reads it
    /// at the centre only.
    pub read: *const u8,
    /// Where results go: of cells, the row's first cell; of items, the row's first item. Null where the
    /// process does not write.
    pub write: *mut u8,
    /// What lies there.
    pub memory: Memory,
}

/// How a substate lies in memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Memory {
    /// The bytes of an element.
    pub element: usize,
    /// The elements of a value: 1, or the length of an array.
    pub length: usize,
    /// Whose values these are, and which of them can be read.
    pub of: MemoryOf,
}

/// Whose values an entry holds, and which of them can be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MemoryOf {
    /// Of cells, each element in a plane of its own; of the row's cells.
    Cells {
        /// The elements from one plane to the next, where values are read.
        read_stride: usize,
        /// The same where they are written.
        write_stride: usize,
        /// Whether neighbours can be read too.
        around: bool,
    },
    /// Of items, whole values one after the other.
    Items {
        /// Whether items can be read that are not the row's own.
        all: bool,
        /// How many values there are: as many as labels, if these are the items of the row.
        count: usize,
    },
}

impl Row<'_> {
    /// The entry with this number, compared with what a kernel takes it for.
    #[inline(always)]
    fn entry<T: KernelValue>(&self, number: usize) -> &Entry {
        let entry = &self.entries[number];
        let memory = entry.memory;
        let element = size_of::<<T::Element as KernelElement>::Memory>();
        assert!(memory.element == element && memory.length == T::LENGTH, "an entry of another type");
        // Kernels may bring types of their own; buffers are aligned for scalars.
        let alignment = align_of::<<T::Element as KernelElement>::Memory>();
        assert!(alignment <= align_of::<u64>(), "a type of another alignment");
        entry
    }

    /// The entry of items with this number, which must be those of the row; whether others than its own can
    /// be read, and how many there are.
    #[inline(always)]
    fn item_entry<T: KernelValue>(&self, number: usize) -> (&Entry, bool, usize) {
        let entry = self.entry::<T>(number);
        let MemoryOf::Items { all, count } = entry.memory.of else { panic!("an entry of cells") };
        assert!(count == self.items.map_or(0, |items| items.labels.len()), "an entry of other items");
        (entry, all, count)
    }

    /// The planes of cells that an entry lets read.
    #[inline(always)]
    fn planes<T: KernelValue>(&self, number: usize) -> (AroundRead<'_, T>, bool) {
        let entry = self.entry::<T>(number);
        let MemoryOf::Cells { read_stride: stride, around, .. } = entry.memory.of else {
            panic!("an entry of items")
        };
        assert!(!entry.read.is_null(), "an entry that is written in place");
        (AroundRead { first: entry.read.cast(), stride, row: PhantomData }, around)
    }

    /// A substate of the row's cells, to be read.
    #[inline(always)]
    pub fn read_cells<T: KernelValue>(&self, number: usize) -> CentreRead<'_, T> {
        CentreRead { around: self.planes(number).0 }
    }

    /// A substate of the row's cells and of their neighbours, to be read.
    #[inline(always)]
    pub fn read_around<T: KernelValue>(&self, number: usize) -> AroundRead<'_, T> {
        let (planes, around) = self.planes(number);
        assert!(around, "an entry whose neighbours cannot be read");
        planes
    }

    /// A substate of the row's cells, to be written. Each can be asked for once.
    #[inline(always)]
    pub fn write_cells<T: KernelValue>(&self, number: usize) -> T::Written<'_> {
        let entry = self.entry::<T>(number);
        let MemoryOf::Cells { write_stride: stride, .. } = entry.memory.of else {
            panic!("an entry of items")
        };
        self.take(number);
        let planes = Planes { first: entry.write.cast(), stride, cells: self.length };
        // SAFETY: `Row::new`: where it can be written, each plane has `length` elements, aligned, this row's
        // alone. It is, and is asked for once, see `take`; it is not read through the entry but where `read`
        // is other memory.
        unsafe { T::Written::new(planes) }
    }

    /// Checks that an entry can be written, and that no one else has asked for it.
    #[inline(always)]
    fn take(&self, number: usize) {
        assert!(!self.entries[number].write.is_null(), "an entry that cannot be written");
        let mark = 1_u128.checked_shl(number as u32).unwrap_or_default();
        let taken = self.taken.get();
        assert!(mark != 0 && taken & mark == 0, "an entry that is written already");
        self.taken.set(taken | mark);
    }

    /// A substate of all items, to be read.
    #[inline(always)]
    pub fn read_items<T: KernelValue>(&self, number: usize) -> &[T::Memory] {
        let (entry, all, count) = self.item_entry::<T>(number);
        assert!(all, "an entry whose other items cannot be read");
        assert!(!entry.read.is_null(), "an entry that is written in place");
        // SAFETY: `Row::new`: as many elements as labels, aligned, which no one writes.
        unsafe { std::slice::from_raw_parts(entry.read.cast(), count) }
    }

    /// A substate of the row's own items, to be read; element 0 belongs to item [`Self::first_item`].
    #[inline(always)]
    pub fn read_own_items<T: KernelValue>(&self, number: usize) -> &[T::Memory] {
        let (entry, ..) = self.item_entry::<T>(number);
        assert!(!entry.read.is_null(), "an entry that is written in place");
        let (first, end) = self.items.map_or((0, 0), |items| items.own);
        // SAFETY: `Row::new`: the row's own items, aligned, which no one else writes.
        unsafe {
            let values: *const T::Memory = entry.read.cast();
            std::slice::from_raw_parts(values.add(first), end - first)
        }
    }

    /// A substate of the row's own items, to be written; element 0 belongs to item [`Self::first_item`]. Each
    /// can be asked for once.
    #[inline(always)]
    #[allow(clippy::mut_from_ref, reason = "each written entry is asked for once, see `take`")]
    pub fn write_items<T: KernelValue>(&self, number: usize) -> &mut [T::Memory] {
        let (entry, ..) = self.item_entry::<T>(number);
        self.take(number);
        let (first, end) = self.items.map_or((0, 0), |items| items.own);
        // SAFETY: `Row::new`: where they can be written, the row's own items, aligned, this row's alone. They
        // are, and are asked for once, see `take`.
        unsafe { std::slice::from_raw_parts_mut(entry.write.cast(), end - first) }
    }
}
