//! What can go wrong with GeoTIFF files.

use std::io;
use std::path::PathBuf;
use tiff::TiffError;

/// A GeoTIFF that cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadGeoTiffError {
    /// The file is not there or not readable.
    #[error("cannot open the GeoTIFF {}", path.display())]
    Open {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The file is no TIFF, is damaged, or is of a kind that cannot be decoded.
    #[error("cannot read the GeoTIFF {}", path.display())]
    Decode {
        /// The file.
        path: PathBuf,
        /// What the decoder said.
        source: TiffError,
    },
    /// Its samples are none that a cell can have.
    #[error(
        "{}: the GeoTIFF has {found}; convert it with `gdal_translate -ot Float32`",
        path.display()
    )]
    Samples {
        /// The file.
        path: PathBuf,
        /// What the samples are.
        found: String,
    },
    /// It has more cells than can be held.
    #[error(
        "{}: the GeoTIFF has {} x {} cells, which do not fit into memory",
        path.display(), extents[0], extents[1]
    )]
    Size {
        /// The file.
        path: PathBuf,
        /// Columns and rows.
        extents: [usize; 2],
    },
    /// It has no georeference.
    #[error(
        "{}: the GeoTIFF does not say where it lies; set its corners with `gdal_edit.py -a_ullr`",
        path.display()
    )]
    NoPlace {
        /// The file.
        path: PathBuf,
    },
    /// It has no georeference, and other cells than the model.
    #[error(
        "{}: the GeoTIFF does not say where it lies, and it has {} x {} cells, not {} x {} as the model",
        path.display(), found[0], found[1], wanted[0], wanted[1]
    )]
    Cells {
        /// The file.
        path: PathBuf,
        /// Its columns and rows.
        found: [usize; 2],
        /// Those of the model.
        wanted: [usize; 2],
    },
    /// A georeference that makes no sense.
    #[error("{}: the tag {tag} of the GeoTIFF {problem}", path.display())]
    Tag {
        /// The file.
        path: PathBuf,
        /// The name of the tag.
        tag: &'static str,
        /// What is wrong with it.
        problem: String,
    },
    /// Its rows do not run from west to east.
    #[error("{}: the GeoTIFF is rotated; warp it with `gdalwarp`", path.display())]
    Rotated {
        /// The file.
        path: PathBuf,
    },
    /// Its cells are not square.
    #[error(
        "{}: the cells are not square: {dx} along x and {dy} along y; resample the GeoTIFF to square cells",
        path.display()
    )]
    NotSquare {
        /// The file.
        path: PathBuf,
        /// The side along x.
        dx: f64,
        /// The side along y.
        dy: f64,
    },
    /// An infinite value.
    #[error(
        "{}: {value} in column {}, row {} from the north is not a finite number",
        path.display(), place[0], place[1]
    )]
    Infinite {
        /// The file.
        path: PathBuf,
        /// Column and row of the cell, from 1, from the west and the north.
        place: [usize; 2],
        /// The value.
        value: f64,
    },
}
