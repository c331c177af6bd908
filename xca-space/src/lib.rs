//! Cellular spaces: extents, boundaries, neighbourhoods and directions.
//!
//! Models import them from `xca_core`, which re-exports all of them.

pub mod directions;
mod geometry;
mod neighbourhood;

pub use geometry::{Boundary, Face, Faces, Geometry, Reached};
#[doc(hidden)]
pub use neighbourhood::shapes;
pub use neighbourhood::{Hexagons, Neighbourhood, NeighbourhoodError, Parity};
