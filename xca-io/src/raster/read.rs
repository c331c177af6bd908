//! The reader of rasters of any format.

use super::Raster;
use crate::ascii_grid::{self, ReadGridError};
use crate::geotiff::{self, ReadGeoTiffError};
use crate::placement::Placement;
use std::path::{Path, PathBuf};

/// The largest valid altitude or depth in metres.
pub const HIGHEST: f64 = 1e5;

impl Raster {
    /// Reads a GeoTIFF or an ESRI ASCII grid. The first bytes or the extension (`.tif`, `.tiff`) decide
    /// which.
    ///
    /// # Errors
    /// Returns [`ReadRasterError::GeoTiff`] or [`ReadRasterError::AsciiGrid`].
    pub fn read(path: &Path) -> Result<Self, ReadRasterError> {
        Self::read_either(path, None)
    }

    /// Like [`Raster::read`], but the file may lack its place. Examples are a GeoTIFF without georeference
    /// and a grid without a header. The file must have the columns and rows of `placement`.
    ///
    /// # Errors
    /// Those of [`Raster::read`].
    pub fn read_on(path: &Path, placement: Placement) -> Result<Self, ReadRasterError> {
        Self::read_either(path, Some(placement))
    }

    fn read_either(path: &Path, on: Option<Placement>) -> Result<Self, ReadRasterError> {
        if geotiff::is_geotiff(path) {
            Ok(geotiff::read_placed(path, on)?)
        } else {
            Ok(ascii_grid::read_placed(path, on)?)
        }
    }

    /// Like [`Raster::read`], for altitudes in metres. Rejects altitudes beyond [`HIGHEST`], those of -9999,
    /// and rasters without values.
    ///
    /// # Errors
    /// Those of [`Raster::read`], [`ReadRasterError::Height`] and [`ReadRasterError::Empty`].
    pub fn read_heights(path: &Path) -> Result<Self, ReadRasterError> {
        let raster = Self::read(path)?;
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
    /// No cell has a value.
    #[error("{}: no cell has a value", path.display())]
    Empty {
        /// The file.
        path: PathBuf,
    },
}
