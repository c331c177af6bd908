//! The place of the pixels of a GeoTIFF.

use super::{GeoKeys, ReadGeoTiffError};
use crate::placement::Placement;
use std::path::Path;

/// The tags of the georeference. Missing tags are empty.
#[derive(Debug, Default)]
pub(super) struct Georeference {
    /// `ModelPixelScale`: the sides of a pixel along x and y.
    pub(super) scale: Vec<f64>,
    /// `ModelTiepoint`: column, row, depth; x, y, z.
    pub(super) tiepoint: Vec<f64>,
    /// `ModelTransformation`: a 4 x 4 matrix.
    pub(super) transformation: Vec<f64>,
}

/// The place of the pixels, and the direction of their rows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pixels {
    pub(super) placement: Placement,
    /// Whether the first row is the southernmost one.
    pub(super) from_the_south: bool,
}

/// The coordinates of the pixel corner `[0, 0]`, and the steps to the next column and to the next row.
#[derive(Debug, Clone, Copy)]
struct Axes {
    origin: [f64; 2],
    column: f64,
    row: f64,
}

impl Axes {
    /// Whether a tie point is where the axes put its pixel, within a hundredth of a side. A number that is
    /// not finite is another mistake.
    fn fits(&self, point: &[f64]) -> bool {
        let away = [
            (self.origin[0] + point[0] * self.column - point[3]) / self.column,
            (self.origin[1] + point[1] * self.row - point[4]) / self.row,
        ];
        !away.iter().any(|sides| sides.abs() > 0.01)
    }
}

impl Georeference {
    /// The place of an image with these columns and rows. `None` without georeference.
    pub(super) fn pixels(
        &self,
        path: &Path,
        extents: [usize; 2],
        keys: Option<&GeoKeys>,
    ) -> Result<Option<Pixels>, ReadGeoTiffError> {
        let Some(axes) = self.axes(path)? else { return Ok(None) };
        let is_point = keys.is_some_and(GeoKeys::pixel_is_point);
        let Axes { origin: [mut x, mut y], column, row } = axes;
        if is_point {
            (x, y) = (x - column / 2.0, y - row / 2.0);
        }
        let tag = if self.has_scale() { "ModelPixelScale" } else { "ModelTransformation" };
        let wrong =
            |problem: &str| ReadGeoTiffError::Tag { path: path.to_owned(), tag, problem: problem.to_owned() };
        if ![x, y, column, row].iter().all(|number| number.is_finite()) {
            return Err(wrong("has a number that is not finite"));
        }
        // GDAL takes a negative side as a positive one, against the standard: north would be in doubt.
        if column <= 0.0 || row == 0.0 || (self.has_scale() && row > 0.0) {
            return Err(wrong("has a side that is not more than 0"));
        }
        if (column - row.abs()).abs() > 1e-6 * column {
            return Err(ReadGeoTiffError::NotSquare { path: path.to_owned(), dx: column, dy: row.abs() });
        }
        let south = if row < 0.0 { y + row * extents[1] as f64 } else { y };
        let placement = Placement { extents, corner: [x, south], side: column }.checked();
        let placement =
            placement.map_err(|problem| ReadGeoTiffError::Place { path: path.to_owned(), problem })?;
        Ok(Some(Pixels { placement, from_the_south: row > 0.0 }))
    }

    fn has_scale(&self) -> bool {
        self.scale.len() >= 2 && self.tiepoint.len() >= 6
    }

    fn axes(&self, path: &Path) -> Result<Option<Axes>, ReadGeoTiffError> {
        if self.has_scale() {
            let (scale, tiepoint) = (&self.scale, &self.tiepoint);
            let origin = [tiepoint[3] - tiepoint[0] * scale[0], tiepoint[4] + tiepoint[1] * scale[1]];
            let axes = Axes { origin, column: scale[0], row: -scale[1] };
            if !tiepoint.chunks_exact(6).all(|point| axes.fits(point)) {
                let problem = "has points that do not fit its first one and ModelPixelScale".to_owned();
                return Err(ReadGeoTiffError::Tag { path: path.to_owned(), tag: "ModelTiepoint", problem });
            }
            return Ok(Some(axes));
        }
        let matrix = &self.transformation;
        if matrix.is_empty() {
            return Ok(None);
        }
        if matrix.len() < 16 {
            let problem = format!("has {} numbers, not 16", matrix.len());
            let tag = "ModelTransformation";
            return Err(ReadGeoTiffError::Tag { path: path.to_owned(), tag, problem });
        }
        if matrix[1] != 0.0 || matrix[4] != 0.0 {
            return Err(ReadGeoTiffError::Rotated { path: path.to_owned() });
        }
        Ok(Some(Axes { origin: [matrix[3], matrix[7]], column: matrix[0], row: matrix[5] }))
    }
}
