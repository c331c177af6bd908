//! The items of a row, and their neighbour lists, as an engine describes them.

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
}
