//! Errors of GeoTIFF files.

use crate::placement::CoarsePlace;
use std::io;
use std::path::PathBuf;
use tiff::TiffError;

/// A GeoTIFF that cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadGeoTiffError {
    /// The file does not exist or is not readable.
    #[error("cannot open the GeoTIFF {}", path.display())]
    Open {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// The file is not a TIFF, is damaged, or has an unsupported encoding.
    #[error("cannot read the GeoTIFF {}", path.display())]
    Decode {
        /// The file.
        path: PathBuf,
        /// The error of the decoder.
        source: TiffError,
    },
    /// The samples have an unsupported type.
    #[error(
        "{}: the GeoTIFF has {found}; convert it with `gdal_translate -ot Float32`",
        path.display()
    )]
    Samples {
        /// The file.
        path: PathBuf,
        /// The type of the samples.
        found: String,
    },
    /// The samples stand for other numbers, by a scale or an offset.
    #[error(
        "{}: the {role} of the samples of the GeoTIFF is {found}; apply it with `gdal_translate -unscale -ot Float64`",
        path.display()
    )]
    Scaled {
        /// The file.
        path: PathBuf,
        /// `scale` or `offset`.
        role: &'static str,
        /// Its text in the file.
        found: String,
    },
    /// The heights are not in metres.
    #[error(
        "{}: the heights of the GeoTIFF are in {unit}, but models count in metres; convert them, for example \
         with `gdal_calc`, and set the unit with `gdal_edit -units m`",
        path.display()
    )]
    HeightUnit {
        /// The file.
        path: PathBuf,
        /// The unit in the file.
        unit: String,
    },
    /// The image has too many cells.
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
    /// The file has no georeference.
    #[error(
        "{}: the GeoTIFF has no position; set its corners with `gdal_edit.py -a_ullr`",
        path.display()
    )]
    NoPlace {
        /// The file.
        path: PathBuf,
    },
    /// The file has no georeference, and other extents than the model.
    #[error(
        "{}: the GeoTIFF has no position, and it has {} x {} cells, not {} x {} as the model",
        path.display(), found[0], found[1], wanted[0], wanted[1]
    )]
    Cells {
        /// The file.
        path: PathBuf,
        /// Columns and rows of the file.
        found: [usize; 2],
        /// Columns and rows of the model.
        wanted: [usize; 2],
    },
    /// The georeference is invalid.
    #[error("{}: the tag {tag} of the GeoTIFF {problem}", path.display())]
    Tag {
        /// The file.
        path: PathBuf,
        /// The name of the tag.
        tag: &'static str,
        /// The problem.
        problem: String,
    },
    /// The georeference is too far from the origin.
    #[error("{}: {problem}", path.display())]
    Place {
        /// The file.
        path: PathBuf,
        /// The coordinate.
        problem: CoarsePlace,
    },
    /// The rows do not run from west to east.
    #[error("{}: the GeoTIFF is rotated; warp it with `gdalwarp`", path.display())]
    Rotated {
        /// The file.
        path: PathBuf,
    },
    /// The cells are not square.
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
    /// A value is infinite.
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
