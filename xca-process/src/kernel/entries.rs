//! The memory of the substates of a row.

/// One substate in memory.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// For cells: the first element's value in the row's first cell. For items: the value of the first item
    /// of all. Null if the kernel reads through `write`: the process writes the substate, and reads it only
    /// at the centre.
    pub read: *const u8,
    /// The place for results: the row's first cell, or the row's first item. Null if the process does not
    /// write.
    pub write: *mut u8,
    /// The layout of the memory.
    pub memory: Memory,
}

/// The layout of a substate in memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Memory {
    /// The size of an element in bytes.
    pub element: usize,
    /// The number of elements of a value: 1, or the length of an array.
    pub length: usize,
    /// The owners of the values, and the readable ones.
    pub of: MemoryOf,
}

/// The owners of the values of an entry, and the readable ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MemoryOf {
    /// The row's cells, with a plane for each element.
    Cells {
        /// The distance between planes for reading, in elements.
        read_stride: usize,
        /// The distance between planes for writing, in elements.
        write_stride: usize,
        /// Whether neighbours are readable too.
        around: bool,
    },
    /// Items, with whole values one after the other.
    Items {
        /// Whether items outside the row are readable.
        all: bool,
        /// The number of values. It equals the number of labels if these are the items of the row.
        count: usize,
    },
}
