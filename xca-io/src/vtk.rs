//! VTK XML files, for ParaView, VisIt and VTK.
//!
//! | function | file | holds |
//! |---|---|---|
//! | [`write_particles`] | `.vtp`, PolyData | particles: one vertex each, with arrays of values |
//! | [`write_dense`] | `.vti`, ImageData | dense substates: one value, or vector, a cell |
//! | [`write_hexagons`] | `.vtp`, PolyData | dense substates on hexagons: a polygon a cell |
//! | [`Collection`] | `.pvd` | the files of a run with their times; open it to play the run |
//!
//! [`read_particles`], [`read_dense`], [`read_hexagons`] and [`read_collection`] read these files back. They
//! read no other VTK files. [`read_poly_data`] takes either kind of `.vtp`.
//!
//! Values are binary, little-endian, in `AppendedData` with raw encoding, and compressed with zlib without
//! loss. Units are those of the model. Every file holds its time as the field `TimeValue`.

mod appended;
mod blocks;
mod collection;
mod dense;
mod hexagons;
mod number_type;
mod particles;
mod read;
mod values;

use std::path::PathBuf;

use super::atomic::WriteError;

pub use collection::Collection;
pub use dense::{GHOST_TYPE, Grid, ghost_types, write_dense};
pub use hexagons::{HexagonGrid, write_hexagons};
pub use number_type::NumberType;
pub use particles::write_particles;
pub use read::{
    DenseFile, HexagonFile, ListedFile, ParticleFile, PolyDataFile, ReadArray, ReadVtkError, read_collection,
    read_dense, read_hexagons, read_particles, read_poly_data,
};
pub use values::{DataArray, ValueSource, Values};

/// Data that cannot be written as a VTK file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum VtkError {
    /// An array does not have one value, or vector, for each particle or cell.
    #[error("cannot write {}: array `{array}` has {found} entries, not {expected}", path.display())]
    ArrayLength {
        /// The file.
        path: PathBuf,
        /// The array.
        array: String,
        /// The number of particles or cells.
        expected: usize,
        /// The number of entries.
        found: usize,
    },
    /// Two arrays have the same name.
    #[error("cannot write {}: two arrays are named `{array}`", path.display())]
    RepeatedArray {
        /// The file.
        path: PathBuf,
        /// The name.
        array: String,
    },
    /// Positions are not 3-vectors of `f32` or `f64`.
    #[error("cannot write {}: positions must be 3-vectors of f32 or f64", path.display())]
    Positions {
        /// The file.
        path: PathBuf,
    },
    /// There are more points, or cells along an axis, than VTK can count with 32 bits.
    #[error("cannot write {}: {found} is more than VTK's limit of {}", path.display(), i32::MAX)]
    TooMany {
        /// The file.
        path: PathBuf,
        /// The number of particles, or of cells along an axis.
        found: usize,
    },
    /// A time, origin or spacing is not finite, or a spacing is not positive.
    #[error("cannot write {}: {what} is {value}", path.display())]
    Geometry {
        /// The file.
        path: PathBuf,
        /// The name of the quantity.
        what: &'static str,
        /// The value.
        value: f64,
    },
    /// A collection can only list files in its own folder or below.
    #[error("cannot list {} in {}: it is not in the same folder or below", file.display(), path.display())]
    OutsideFolder {
        /// The collection.
        path: PathBuf,
        /// The file.
        file: PathBuf,
    },
    /// The system returned an error.
    #[error(transparent)]
    Write(#[from] WriteError),
}
