//! The reader of rasters of any format.

use super::Raster;
use crate::ascii_grid::{self, ReadGridError};
use crate::geotiff::{self, ReadGeoTiffError};
use crate::placement::Placement;
use crate::quantity::Quantity;
use std::path::{Path, PathBuf};

/// The largest valid altitude or depth in metres. No place of a rocky planet is as high or as deep. Below the
/// numbers for NODATA that programs leave undeclared: 32767, 65535, 99999, with either sign.
pub const HIGHEST: f64 = 3e4;

impl Raster {
    /// Reads a GeoTIFF or an ESRI ASCII grid. The first bytes or the extension (`.tif`, `.tiff`) decide
    /// which.
    ///
    /// # Errors
    /// Returns [`ReadRasterError::GeoTiff`] or [`ReadRasterError::AsciiGrid`].
    pub fn read(path: &Path) -> Result<Self, ReadRasterError> {
        Self::read_either(path, None, Quantity::Any)
    }

    /// Like [`Raster::read`], but the file may lack its place. Examples are a GeoTIFF without georeference
    /// and a grid without a header. The file must have the columns and rows of `placement`.
    ///
    /// # Errors
    /// Those of [`Raster::read`].
    pub fn read_on(path: &Path, placement: Placement) -> Result<Self, ReadRasterError> {
        Self::read_either(path, Some(placement), Quantity::Any)
    }

    fn read_either(path: &Path, on: Option<Placement>, quantity: Quantity) -> Result<Self, ReadRasterError> {
        if geotiff::is_geotiff(path) {
            Ok(geotiff::read_placed(path, on, quantity)?)
        } else {
            Ok(ascii_grid::read_placed(path, on)?)
        }
    }

    /// Like [`Raster::read`], for altitudes in metres. Rejects altitudes beyond [`HIGHEST`], those of -9999,
    /// rasters without values, and GeoTIFFs that name another unit of heights.
    ///
    /// # Errors
    /// Those of [`Raster::read`], [`ReadRasterError::Height`] and [`ReadRasterError::Empty`].
    pub fn read_heights(path: &Path) -> Result<Self, ReadRasterError> {
        let raster = Self::read_either(path, None, Quantity::Height)?;
        // The usual number for NODATA is no altitude where the file declares another one, or none.
        let is_impossible = |height: &f64| height.abs() > HIGHEST || *height == ascii_grid::NOTHING;
        if let Some(cell) = raster.values.iter().position(is_impossible) {
            let (place, height) = (raster.placement.place(cell), raster.values[cell]);
            return Err(ReadRasterError::Height { path: path.to_owned(), place, height });
        }
        if raster.values.iter().all(|height| height.is_nan()) {
            return Err(ReadRasterError::Empty { path: path.to_owned() });
        }
        Ok(raster)
    }

    /// Like [`Raster::read`], for the thickness of a layer in metres: of debris, snow or water. Rejects
    /// thicknesses below 0 or beyond [`HIGHEST`].
    ///
    /// # Errors
    /// Those of [`Raster::read`] and [`ReadRasterError::Thickness`].
    pub fn read_thickness(path: &Path) -> Result<Self, ReadRasterError> {
        let raster = Self::read_either(path, None, Quantity::Height)?;
        match raster.values.iter().position(|metres| *metres < 0.0 || *metres > HIGHEST) {
            None => Ok(raster),
            Some(cell) => {
                let (place, metres) = (raster.placement.place(cell), raster.values[cell]);
                Err(ReadRasterError::Thickness { path: path.to_owned(), place, metres })
            }
        }
    }
}

/// A raster that cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadRasterError {
    /// An ESRI ASCII grid that cannot be read.
    #[error(transparent)]
    AsciiGrid(#[from] ReadGridError),
    /// A GeoTIFF that cannot be read.
    #[error(transparent)]
    GeoTiff(#[from] ReadGeoTiffError),
    /// An altitude is impossible.
    #[error(
        "{}: {height} in column {}, row {} from the north is not an altitude in m; \
         if it means NODATA, declare it in the line NODATA_value, or in the NODATA tag of a GeoTIFF",
        path.display(), place[0], place[1]
    )]
    Height {
        /// The file.
        path: PathBuf,
        /// Column and row of the cell, from 1, from the west and the north.
        place: [usize; 2],
        /// The altitude.
        height: f64,
    },
    /// A thickness is impossible.
    #[error(
        "{}: a thickness of {metres} m in column {}, row {} from the north; it must be from 0 to {HIGHEST}; \
         if it means NODATA, declare it in the line NODATA_value, or in the NODATA tag of a GeoTIFF",
        path.display(), place[0], place[1]
    )]
    Thickness {
        /// The file.
        path: PathBuf,
        /// Column and row of the cell, from 1, from the west and the north.
        place: [usize; 2],
        /// The thickness.
        metres: f64,
    },
    /// No cell has a value.
    #[error("{}: no cell has a value", path.display())]
    Empty {
        /// The file.
        path: PathBuf,
    },
}
