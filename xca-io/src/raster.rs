//! A layer of square cells with a number for each, as geographic information systems have it.
//!
//! [`Raster::read`] reads GeoTIFF and ESRI ASCII grids; [`geotiff::write`] and [`ascii_grid::write`] write
//! them. Rows count from the south, as in a model: `[0, 0]` is the cell in the south-west.

use crate::ascii_grid::{self, ReadGridError};
use crate::geotiff::{self, GeoKeys, ReadGeoTiffError};
use crate::map::{Map, Placement};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A layer of square cells, each with a number or without one.
#[derive(Debug, Clone, PartialEq)]
pub struct Raster {
    pub(crate) placement: Placement,
    /// x fastest, from the south; NaN where there is none.
    pub(crate) values: Vec<f64>,
    pub(crate) coordinate_system: Option<Arc<GeoKeys>>,
}

impl Raster {
    /// A raster of so many columns and rows. `values` has one number for each cell, x fastest, from the
    /// south; NaN stands for NODATA. The south-west corner is at 0, 0 unless [`Raster::with_corner`] moves
    /// it.
    ///
    /// None if the number of values differs from that of the cells, or the side is not a positive number.
    #[must_use]
    pub fn new(extents: [usize; 2], side: f64, values: Vec<f64>) -> Option<Self> {
        let cells = extents[0].checked_mul(extents[1])?;
        let fits = cells > 0 && values.len() == cells && side.is_finite() && side > 0.0;
        let placement = Placement { extents, corner: [0.0; 2], side };
        fits.then_some(Self { placement, values, coordinate_system: None })
    }

    /// The same raster with its south-west corner elsewhere.
    #[must_use]
    pub fn with_corner(self, corner: [f64; 2]) -> Self {
        Self { placement: Placement { corner, ..self.placement }, ..self }
    }

    /// The same raster in this coordinate system, or in none.
    #[must_use]
    pub fn with_coordinate_system(self, coordinate_system: Option<Arc<GeoKeys>>) -> Self {
        Self { coordinate_system, ..self }
    }

    /// Where its cells lie.
    pub fn placement(&self) -> Placement {
        self.placement
    }

    /// The number of columns and rows.
    pub fn extents(&self) -> [usize; 2] {
        self.placement.extents
    }

    /// The south-west corner of the south-west cell, in the units of the map.
    pub fn corner(&self) -> [f64; 2] {
        self.placement.corner
    }

    /// The side of a cell, in the units of the map.
    pub fn side(&self) -> f64 {
        self.placement.side
    }

    /// The coordinate system of the map, if the file names one.
    pub fn coordinate_system(&self) -> Option<&Arc<GeoKeys>> {
        self.coordinate_system.as_ref()
    }

    /// The values, x fastest, from the south; NaN for NODATA.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The value of a cell, if it has one and lies in the raster.
    pub fn value(&self, [x, y]: [usize; 2]) -> Option<f64> {
        let [columns, rows] = self.placement.extents;
        let inside = x < columns && y < rows;
        inside.then(|| self.values[y * columns + x]).filter(|value| !value.is_nan())
    }

    /// The same raster with this value in the cells that have none.
    #[must_use]
    pub fn filled(mut self, value: f64) -> Self {
        self.values.iter_mut().filter(|own| own.is_nan()).for_each(|own| *own = value);
        self
    }

    /// Reads a GeoTIFF, which its first bytes or its extension (`.tif`, `.tiff`) tell, or an ESRI ASCII grid.
    ///
    /// # Errors
    /// [`ReadRasterError::GeoTiff`], [`ReadRasterError::AsciiGrid`].
    pub fn read(path: &Path) -> Result<Self, ReadRasterError> {
        Self::read_either(path, None)
    }

    /// As [`Raster::read`], of a file that may lack its place on the map: a GeoTIFF without georeference, a
    /// grid without a header. It must have the columns and rows of this place.
    ///
    /// # Errors
    /// As [`Raster::read`].
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

    /// As [`Raster::read`], of altitudes in m. Altitudes beyond [`HIGHEST`] and rasters without any value are
    /// refused.
    ///
    /// # Errors
    /// As [`Raster::read`]; [`ReadRasterError::Height`] and [`ReadRasterError::Empty`].
    pub fn read_heights(path: &Path) -> Result<Self, ReadRasterError> {
        let raster = Self::read(path)?;
        if let Some(cell) = raster.values.iter().position(|height| height.abs() > HIGHEST) {
            let (place, height) = (raster.placement.place(cell), raster.values[cell]);
            return Err(ReadRasterError::Height { path: path.to_owned(), place, height });
        }
        if raster.values.iter().all(|height| height.is_nan()) {
            return Err(ReadRasterError::Empty { path: path.to_owned() });
        }
        Ok(raster)
    }
}

impl From<&Raster> for Map {
    /// The place of the raster and its coordinate system, with ground where it has a value.
    fn from(raster: &Raster) -> Self {
        let missing = raster.values.iter().map(|value| value.is_nan()).collect();
        let map = Self::new(raster.placement).with_coordinate_system(raster.coordinate_system.clone());
        map.clone().without(missing).unwrap_or(map)
    }
}

/// The largest altitude, and depth, that the ground can have, in m.
pub const HIGHEST: f64 = 1e5;

/// Programs that write a NODATA value beyond this round it to few digits.
const HUGE: f64 = 1e38;

/// Whether a number of a file is the one that stands for NODATA, however many digits either is written with.
pub(crate) fn stands_for_none(number: f64, nothing: f64) -> bool {
    let is_same_f32 = number as f32 == nothing as f32 && number != 0.0 && nothing as f32 != 0.0;
    number == nothing || is_same_f32 || are_huge(number, nothing)
}

/// Whether both are beyond any value, on the same side.
pub(crate) fn are_huge(number: f64, nothing: f64) -> bool {
    number.abs() >= HUGE && nothing.abs() >= HUGE && number.signum() == nothing.signum()
}

/// Files begin with the northernmost row.
pub(crate) fn from_the_south(mut values: Vec<f64>, columns: usize) -> Vec<f64> {
    let rows = values.len() / columns.max(1);
    for row in 0..rows / 2 {
        let (before, after) = values.split_at_mut((rows - 1 - row) * columns);
        before[row * columns..][..columns].swap_with_slice(&mut after[..columns]);
    }
    values
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
    /// An altitude that no ground has.
    #[error(
        "{}: {height} in column {}, row {} from the north is no altitude in m; if it stands for no value, name \
         it in the line NODATA_value, or in the NODATA tag of a GeoTIFF",
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
