//! Numbers with a meaning: results of a migration, and codes of faults.

/// The result of a migration: the item stays in its cell.
pub const STAY: u32 = u32::MAX;
/// The result of a migration: the item leaves the space.
pub const OUTSIDE: u32 = u32::MAX - 1;
/// The result of a migration: the position is NaN.
pub const NOWHERE: u32 = u32::MAX - 2;
/// The fault code of a neighbour index beyond the neighbourhood.
pub const BEYOND_NEIGHBOURHOOD: u32 = u32::MAX;
/// The fault code of a search radius that is too large, negative or NaN.
pub const WRONG_RADIUS: u32 = u32::MAX - 1;
