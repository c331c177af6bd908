//! The items of a row, and their neighbour lists, as an engine describes them.

use std::sync::atomic::{AtomicU32, Ordering};

/// The places of the items of a row's cells and of their neighbours.
#[derive(Debug, Clone, Copy)]
pub struct RowItems<'a> {
    /// The first item of the row's first cell. At an offset: of that neighbour.
    pub starts: *const u32,
    /// One past the last item, addressed in the same way.
    pub ends: *const u32,
    /// The labels of all items.
    pub labels: &'a [u32],
    /// The row's own items. No other row has them.
    pub own: (usize, usize),
    /// The linear index of the cell, for each of the row's own items.
    pub cells: &'a [u32],
    /// Neighbour lists, if the engine has them.
    pub near: Option<&'a NearLists<'a>>,
}

/// The place in [`NearLists::places`] of an item that has left the space.
pub const NO_PLACE: u32 = u32::MAX;

/// The neighbour list of each item.
#[derive(Debug, Clone, Copy)]
pub struct NearLists<'a> {
    /// The number of the item at each place.
    pub numbers: &'a [u32],
    /// The place of the item with each number, or [`NO_PLACE`].
    pub places: &'a [u32],
    /// The start of the list in `candidates` for each number, then the length of `candidates`.
    pub starts: &'a [u32],
    /// The numbers in all lists.
    pub candidates: &'a [u32],
    /// The owner of the list of each candidate, as a number.
    pub owners: &'a [u32],
    /// The linear index of the cell of the item at each place.
    pub cells: &'a [u32],
    /// A search within this radius, in metres, gives the same result in the lists as in the cells.
    pub radius: f64,
    /// The bound of each candidate, as the bits of an `f32` in metres, at first 0. The candidate is farther
    /// away from the owner than a radius if its bound exceeds [`Self::travelled`] by more than the radius and
    /// the effect of rounding. Bounds are written by the row that has the owner.
    pub bounds: &'a [AtomicU32],
    /// An upper limit, in metres, of how much any two items can have approached each other: the sum over all
    /// passes since the lists were made.
    pub travelled: f64,
    /// The largest effect of rounding on a distance, in metres.
    pub rounding: f64,
}

/// A factor that exceeds the rounding of a few operations in `f32`.
const ROUNDED: f32 = 1.0 + 4.0 * f32::EPSILON;

impl NearLists<'_> {
    /// The largest bound of a candidate that may be within a radius.
    pub(super) fn limit(&self, radius: f64) -> f32 {
        (self.travelled + self.rounding + radius) as f32 * ROUNDED
    }

    /// Stores the bound of a candidate, from the square of its distance to the owner. The square root in
    /// `f32` is fast, and its rounding is allowed for.
    #[inline(always)]
    pub(super) fn bound(&self, candidate: usize, square: f64) {
        let bound = (self.travelled as f32 + (square as f32).sqrt()) * (2.0 - ROUNDED);
        self.bounds[candidate].store(bound.to_bits(), Ordering::Relaxed);
    }
}
