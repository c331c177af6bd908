//! Damaged files: mutations of valid ones, always the same from the same seed.
//!
//! A [`Mutator`] damages bytes and texts. [`Container`] takes a file with compressed or summed parts to
//! pieces, so that a mutation of a part reaches the reader behind the checksum.

mod container;
mod mutator;

pub use container::{Checkpoint, Container, Png, Vtk};
pub use mutator::Mutator;
