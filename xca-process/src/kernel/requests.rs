//! The requests of a kernel for the substates of a row. Each entry is compared with the kernel's use of it,
//! once a row.
#![allow(unsafe_code)]

use super::values::{KernelElement, KernelValue, Planes, Written};
use super::{AroundRead, CentreRead, Entry, MemoryOf, Row};
use std::marker::PhantomData;

impl Row<'_> {
    /// The entry with this index, after comparing it with the kernel's use.
    #[inline(always)]
    fn entry<T: KernelValue>(&self, number: usize) -> &Entry {
        let entry = &self.entries[number];
        let memory = entry.memory;
        let element = size_of::<<T::Element as KernelElement>::Memory>();
        assert!(memory.element == element && memory.length == T::LENGTH, "an entry of another type");
        // Kernels may use their own types. Buffers are aligned for scalars.
        let alignment = align_of::<<T::Element as KernelElement>::Memory>();
        assert!(alignment <= align_of::<u64>(), "a type of another alignment");
        entry
    }

    /// The entry of items with this index, which must be the row's items. Also returns whether items outside
    /// the row are readable, and the number of items.
    #[inline(always)]
    fn item_entry<T: KernelValue>(&self, number: usize) -> (&Entry, bool, usize) {
        let entry = self.entry::<T>(number);
        let MemoryOf::Items { all, count } = entry.memory.of else { panic!("an entry of cells") };
        assert!(count == self.items.map_or(0, |items| items.labels.len()), "an entry of other items");
        (entry, all, count)
    }

    /// The readable planes of cells of an entry.
    #[inline(always)]
    fn planes<T: KernelValue>(&self, number: usize) -> (AroundRead<'_, T>, bool) {
        let entry = self.entry::<T>(number);
        let MemoryOf::Cells { read_stride: stride, around, .. } = entry.memory.of else {
            panic!("an entry of items")
        };
        assert!(!entry.read.is_null(), "an entry that is written in place");
        (AroundRead { first: entry.read.cast(), stride, row: PhantomData }, around)
    }

    /// A substate of the row's cells, for reading.
    #[inline(always)]
    pub fn read_cells<T: KernelValue>(&self, number: usize) -> CentreRead<'_, T> {
        CentreRead { around: self.planes(number).0 }
    }

    /// A substate of the row's cells and of their neighbours, for reading.
    #[inline(always)]
    pub fn read_around<T: KernelValue>(&self, number: usize) -> AroundRead<'_, T> {
        let (planes, around) = self.planes(number);
        assert!(around, "an entry whose neighbours cannot be read");
        planes
    }

    /// A substate of the row's cells, for writing. Each can be requested once.
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

    /// Checks that an entry is writable, and has not been requested before.
    #[inline(always)]
    fn take(&self, number: usize) {
        assert!(!self.entries[number].write.is_null(), "an entry that cannot be written");
        let mark = 1_u128.checked_shl(number as u32).unwrap_or_default();
        let taken = self.taken.get();
        assert!(mark != 0 && taken & mark == 0, "an entry that is written already");
        self.taken.set(taken | mark);
    }

    /// A substate of all items, for reading.
    #[inline(always)]
    pub fn read_items<T: KernelValue>(&self, number: usize) -> &[T::Memory] {
        let (entry, all, count) = self.item_entry::<T>(number);
        assert!(all, "an entry whose other items cannot be read");
        assert!(!entry.read.is_null(), "an entry that is written in place");
        // SAFETY: `Row::new`: as many elements as labels, aligned, which no one writes.
        unsafe { std::slice::from_raw_parts(entry.read.cast(), count) }
    }

    /// A substate of the row's own items, for reading. Element 0 belongs to item [`Self::first_item`].
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

    /// A substate of the row's own items, for writing. Element 0 belongs to item [`Self::first_item`]. Each
    /// can be requested once.
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
