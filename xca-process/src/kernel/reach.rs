//! The cells to search, as constants for the macros.

/// The own cell.
pub const CELL: u8 = 0;
/// The neighbours.
pub const NEIGHBOURS: u8 = 1;
/// Both.
pub const ALL: u8 = 2;
