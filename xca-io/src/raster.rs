//! Rasters of geographic information systems: a layer of square cells, each with a number.
//!
//! [`Raster::read`] reads GeoTIFF and ESRI ASCII grids; [`crate::geotiff::write`] and
//! [`crate::ascii_grid::write`] write them. Rows count from the south, as in a model: `[0, 0]` is the cell in
//! the south-west.

mod read;

pub use read::{HIGHEST, ReadRasterError};

use crate::geotiff::GeoKeys;
use crate::placement::Placement;
use std::sync::Arc;

/// A layer of square cells, each with a number or NODATA.
///
/// ```
/// # let temporary = tempfile::tempdir()?;
/// # let path = temporary.path().join("dem.asc");
/// use xca_io::ascii_grid;
/// use xca_io::raster::Raster;
///
/// let altitudes = vec![10.0, 11.0, f64::NAN, 20.0, 21.0, 22.0];
/// let raster = Raster::new([3, 2], 5.0, altitudes).ok_or("no raster")?.with_corner([1000.0, 2000.0]);
/// assert_eq!(raster.value([1, 0]), Some(11.0));
/// assert_eq!(raster.value([2, 0]), None); // NODATA
///
/// ascii_grid::write(&path, &raster)?;
/// assert_eq!(Raster::read(&path)?.value([2, 1]), Some(22.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Raster {
    pub(crate) placement: Placement,
    /// x fastest, from the south. NaN is NODATA.
    pub(crate) values: Vec<f64>,
    pub(crate) coordinate_system: Option<Arc<GeoKeys>>,
}

impl Raster {
    /// Creates a raster with these columns and rows. `values` has one number for each cell, x fastest, from
    /// the south. NaN is NODATA. The south-west corner is at 0, 0; [`Raster::with_corner`] moves it.
    ///
    /// Returns `None` if the number of values is not that of the cells, or if the side is not a positive
    /// number.
    #[must_use]
    pub fn new(extents: [usize; 2], side: f64, values: Vec<f64>) -> Option<Self> {
        let cells = extents[0].checked_mul(extents[1])?;
        let fits = cells > 0 && values.len() == cells && side.is_finite() && side > 0.0;
        let placement = Placement { extents, corner: [0.0; 2], side };
        fits.then_some(Self { placement, values, coordinate_system: None })
    }

    /// Moves the south-west corner.
    #[must_use]
    pub fn with_corner(self, corner: [f64; 2]) -> Self {
        Self { placement: Placement { corner, ..self.placement }, ..self }
    }

    /// Sets the coordinate system.
    #[must_use]
    pub fn with_coordinate_system(self, coordinate_system: Option<Arc<GeoKeys>>) -> Self {
        Self { coordinate_system, ..self }
    }

    /// The position and size of the cells on the map.
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

    /// The coordinate system of the map, if there is one.
    pub fn coordinate_system(&self) -> Option<&Arc<GeoKeys>> {
        self.coordinate_system.as_ref()
    }

    /// The values, x fastest, from the south; NaN for NODATA.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The value of a cell. `None` for NODATA and outside the raster.
    pub fn value(&self, [x, y]: [usize; 2]) -> Option<f64> {
        let [columns, rows] = self.placement.extents;
        let inside = x < columns && y < rows;
        inside.then(|| self.values[y * columns + x]).filter(|value| !value.is_nan())
    }

    /// Replaces NODATA by this value.
    #[must_use]
    pub fn filled(mut self, value: f64) -> Self {
        self.values.iter_mut().filter(|own| own.is_nan()).for_each(|own| *own = value);
        self
    }
}

/// A limit: programs round NODATA values beyond it to few digits.
const HUGE: f64 = 1e38;

/// Whether a number of a file is NODATA, with any number of digits.
pub(crate) fn stands_for_none(number: f64, nothing: f64) -> bool {
    let is_same_f32 = number as f32 == nothing as f32 && number != 0.0 && nothing as f32 != 0.0;
    number == nothing || is_same_f32 || are_huge(number, nothing)
}

/// Whether both numbers are beyond [`HUGE`], with the same sign.
pub(crate) fn are_huge(number: f64, nothing: f64) -> bool {
    number.abs() >= HUGE && nothing.abs() >= HUGE && number.signum() == nothing.signum()
}

/// Reverses the rows: files begin with the northernmost one.
pub(crate) fn from_the_south(mut values: Vec<f64>, columns: usize) -> Vec<f64> {
    let rows = values.len() / columns.max(1);
    for row in 0..rows / 2 {
        let (before, after) = values.split_at_mut((rows - 1 - row) * columns);
        before[row * columns..][..columns].swap_with_slice(&mut after[..columns]);
    }
    values
}
