//! The place of a layer of cells on a map, and its cells without ground.

pub use crate::map_unit::MapUnit;
pub use crate::placement::{CoarsePlace, Placement, PlacementDifference};

use crate::geotiff::GeoKeys;
use crate::raster::Raster;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The place of a layer of cells, with a mask of the cells without ground (NODATA).
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    placement: Placement,
    /// By linear index, x fastest, from the south. `None` if every cell has ground.
    missing: Option<Arc<[bool]>>,
    coordinate_system: Option<Arc<GeoKeys>>,
}

impl Map {
    /// A map with ground in every cell.
    pub fn new(placement: Placement) -> Self {
        Self { placement, missing: None, coordinate_system: None }
    }

    /// The same map, without ground in the cells where the mask is true (x fastest, from the south). `None`
    /// if the mask does not have one entry for each cell.
    #[must_use]
    pub fn without(self, missing: Vec<bool>) -> Option<Self> {
        let [columns, rows] = self.placement.extents;
        let has_any = missing.contains(&true);
        (missing.len() == columns.checked_mul(rows)?)
            .then(|| Self { missing: has_any.then(|| missing.into()), ..self })
    }

    /// The same map in this coordinate system, or without one.
    #[must_use]
    pub fn with_coordinate_system(self, coordinate_system: Option<Arc<GeoKeys>>) -> Self {
        Self { coordinate_system, ..self }
    }

    /// The place of the layer.
    pub fn placement(&self) -> Placement {
        self.placement
    }

    /// The coordinate system of its corner and side, if a file has given one.
    pub fn coordinate_system(&self) -> Option<&Arc<GeoKeys>> {
        self.coordinate_system.as_ref()
    }

    /// The unit of its corner and side. Metres without a coordinate system.
    pub fn unit(&self) -> MapUnit {
        self.coordinate_system.as_ref().map_or(MapUnit::Metre, |keys| keys.unit())
    }

    /// The mask of the cells without ground, x fastest, from the south. `None` if every cell has ground.
    pub fn missing(&self) -> Option<&[bool]> {
        self.missing.as_deref()
    }

    /// Whether the cell with this linear index lies on the map and has ground.
    pub fn has_ground(&self, cell: usize) -> bool {
        let [columns, rows] = self.placement.extents;
        cell < columns * rows && !self.missing().is_some_and(|missing| missing[cell])
    }

    /// The linear indices of the cells at the edge. Such a cell has ground, and lies at the border of the map
    /// or shares a side with a cell without ground.
    pub fn edge(&self) -> Vec<usize> {
        let [columns, rows] = self.placement.extents;
        let is_edge = |cell: usize| {
            let (x, y) = (cell % columns, cell / columns);
            let is_border = x == 0 || y == 0 || x + 1 == columns || y + 1 == rows;
            let beside = || [cell - 1, cell + 1, cell - columns, cell + columns];
            is_border || beside().into_iter().any(|other| !self.has_ground(other))
        };
        (0..columns * rows).filter(|cell| self.has_ground(*cell) && is_edge(*cell)).collect()
    }

    /// Checks that a layer fits the map: same place, no other coordinate system, and 0 or NaN where the map
    /// has no ground. `path` is the file of the layer. `on` describes the map in the error message.
    ///
    /// # Errors
    /// [`OverlayError`] with both values of the first difference, or with the cell.
    pub fn check(&self, path: &Path, layer: &Raster, on: &str) -> Result<(), OverlayError> {
        let names = || (path.to_owned(), on.to_owned());
        if let Some(difference) = layer.placement().difference(&self.placement) {
            let (path, on) = names();
            return Err(OverlayError::Elsewhere { path, on, difference });
        }
        let codes = [layer.coordinate_system(), self.coordinate_system()].map(|keys| keys?.epsg());
        if let [Some(found), Some(wanted)] = codes
            && found != wanted
        {
            let (path, on) = names();
            return Err(OverlayError::CoordinateSystem { path, on, found, wanted });
        }
        let is_lost =
            |(cell, value): &(usize, &f64)| !value.is_nan() && **value != 0.0 && !self.has_ground(*cell);
        match layer.values().iter().enumerate().find(is_lost) {
            Some((cell, value)) => {
                let (path, on) = names();
                Err(OverlayError::NoGround { path, on, place: self.placement.place(cell), value: *value })
            }
            None => Ok(()),
        }
    }
}

impl From<&Raster> for Map {
    /// The place of the raster and its coordinate system, with ground where it has a value.
    fn from(raster: &Raster) -> Self {
        let missing = raster.values().iter().map(|value| value.is_nan()).collect();
        let map = Self::new(raster.placement()).with_coordinate_system(raster.coordinate_system().cloned());
        map.clone().without(missing).unwrap_or(map)
    }
}

/// A layer does not fit a map.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OverlayError {
    /// The layer has another place or other cells.
    #[error("{} does not lie on {on}: {difference}", path.display())]
    Elsewhere {
        /// The file of the layer.
        path: PathBuf,
        /// The description of the map.
        on: String,
        /// The first difference.
        difference: PlacementDifference,
    },
    /// The layer is in another coordinate system.
    #[error(
        "{} does not lie on {on}: its coordinate system is EPSG:{found}, not EPSG:{wanted}; warp it with `gdalwarp`",
        path.display()
    )]
    CoordinateSystem {
        /// The file of the layer.
        path: PathBuf,
        /// The description of the map.
        on: String,
        /// The EPSG code of the layer.
        found: u16,
        /// The EPSG code of the map.
        wanted: u16,
    },
    /// The layer has a value where the map has no ground.
    #[error("{}: {value} in column {}, row {} from the north, where {on} has no ground (NODATA); clip the grid to \
             the ground, or set it to 0 there", path.display(), place[0], place[1])]
    NoGround {
        /// The file of the layer.
        path: PathBuf,
        /// The description of the map.
        on: String,
        /// Column and row of the cell, from 1, from the west and the north.
        place: [usize; 2],
        /// The value of the layer there.
        value: f64,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLACE: Placement = Placement { extents: [4, 3], corner: [2600.0, 5100.0], side: 10.0 };

    #[test]
    fn places_are_the_same_within_a_millionth_of_a_cell() {
        let same = |other: Placement| assert_eq!(PLACE.difference(&other), None, "{other:?}");
        same(PLACE);
        same(Placement { corner: [2_600.000_009, 5_099.999_991], ..PLACE });
        same(Placement { side: 10.000_009, ..PLACE });
        // An arc second, with other digits.
        let fine = Placement { side: 1.0 / 3600.0, corner: [15.0, 37.5], ..PLACE };
        assert_eq!(fine.difference(&Placement { side: 0.000_277_777_778, ..fine }), None);
        let differs = |other: Placement, wanted: &str| {
            assert_eq!(PLACE.difference(&other).unwrap().to_string(), wanted);
        };
        differs(Placement { extents: [3, 4], ..PLACE }, "it has 4 x 3 cells, not 3 x 4");
        differs(Placement { side: 10.000_02, ..PLACE }, "its cells have a side of 10, not 10.00002");
        let corner = "its south-west corner is 2600, 5100, not 2600, 5100.00002";
        differs(Placement { corner: [2600.0, 5_100.000_02], ..PLACE }, corner);
        differs(
            Placement { corner: [f64::NAN, 5100.0], ..PLACE },
            "its south-west corner is 2600, 5100, not NaN, 5100",
        );
    }

    #[test]
    fn the_edge_is_where_ground_ends() {
        let all = Map::new(PLACE);
        assert_eq!(all.edge(), [0, 1, 2, 3, 4, 7, 8, 9, 10, 11]);
        let wide = Placement { extents: [5, 5], ..PLACE };
        let mut mask = vec![false; 25];
        mask[7] = true;
        let map = Map::new(wide).without(mask).unwrap();
        assert!(!map.has_ground(7) && map.has_ground(6) && !map.has_ground(25));
        let inner: Vec<usize> =
            map.edge().into_iter().filter(|cell| [6, 7, 8, 11, 12, 13].contains(cell)).collect();
        assert_eq!(inner, [6, 8, 12]);
        assert_eq!(Map::new(wide).without(vec![true; 24]), None);
        assert_eq!(Map::new(wide).without(vec![false; 25]), Some(Map::new(wide)));
    }

    #[test]
    fn layers_have_nothing_where_there_is_no_ground() {
        let mut mask = vec![false; 12];
        mask[9] = true;
        let map = Map::new(PLACE).without(mask).unwrap();
        let check = |Placement { extents, corner, side }, values: &[f64]| {
            let layer = Raster::new(extents, side, values.to_vec()).unwrap().with_corner(corner);
            map.check(Path::new("d.asc"), &layer, "g.asc").map_err(|error| error.to_string())
        };
        let mut values = vec![5.0; 12];
        values[9] = 0.0;
        assert_eq!(check(PLACE, &values), Ok(()));
        values[9] = f64::NAN;
        assert_eq!(check(PLACE, &values), Ok(()));
        values[9] = 2.5;
        let said = check(PLACE, &values).unwrap_err();
        assert!(
            said.starts_with("d.asc: 2.5 in column 2, row 1 from the north, where g.asc has no ground"),
            "{said}"
        );
        let said = check(Placement { corner: [0.0; 2], ..PLACE }, &values).unwrap_err();
        assert_eq!(said, "d.asc does not lie on g.asc: its south-west corner is 0, 0, not 2600, 5100");
    }
}
