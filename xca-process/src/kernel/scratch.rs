//! Buffers for the results of searches.

use super::walk::Walk;
use std::cell::RefCell;

/// Buffers for the results of searches, kept from row to row.
#[derive(Debug, Default)]
pub struct Scratch {
    pub(super) free: RefCell<Vec<Vec<u32>>>,
    pub(super) walk: RefCell<Walk>,
}

/// A buffer borrowed from a [`Scratch`].
#[derive(Debug)]
pub struct Found<'a> {
    /// The places of the items.
    pub items: Vec<u32>,
    pub(super) scratch: &'a Scratch,
}

impl Drop for Found<'_> {
    fn drop(&mut self) {
        self.scratch.free.borrow_mut().push(std::mem::take(&mut self.items));
    }
}
