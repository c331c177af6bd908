//! Parts of a space, for engines that share it.

use std::ops::Range;
use xca_process::{Boundary, Face, Faces, Geometry};

/// A part of a space: whole rows along x, with these indices along y and z.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Part {
    /// Indices along y.
    pub y: Range<usize>,
    /// Indices along z.
    pub z: Range<usize>,
}

/// A part that does not fit the space.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PartError {
    /// The part is empty, or the space does not have its rows.
    #[error("the space has {rows} rows along {axis}; a part cannot have those from {start} to below {end}")]
    NoSuchRows {
        /// `y` or `z`.
        axis: char,
        /// The rows of the space.
        rows: usize,
        /// The first row of the part.
        start: usize,
        /// One past its last.
        end: usize,
    },
    /// The neighbourhood reaches beyond the next part.
    #[error(
        "a part of {rows} rows along {axis} is too thin: the model reaches {reach} rows along {axis}; use fewer parts"
    )]
    TooThin {
        /// `y` or `z`.
        axis: char,
        /// The rows of the part.
        rows: usize,
        /// The reach of the neighbourhood.
        reach: usize,
    },
}

impl Part {
    /// The whole space.
    pub fn whole(geometry: &Geometry) -> Self {
        let [_, height, depth] = geometry.extents();
        Self { y: 0..height, z: 0..depth }
    }

    /// Checks that the space has the rows, and that the neighbourhood stays within the next part.
    ///
    /// # Errors
    /// Returns an error otherwise.
    pub fn check(&self, geometry: &Geometry) -> Result<(), PartError> {
        for (axis, name, rows) in [(1, 'y', &self.y), (2, 'z', &self.z)] {
            let (all, reach) = (geometry.extents()[axis], geometry.neighbourhood().reach()[axis]);
            if rows.is_empty() || rows.end > all {
                return Err(PartError::NoSuchRows {
                    axis: name,
                    rows: all,
                    start: rows.start,
                    end: rows.end,
                });
            }
            if rows.len() < all && rows.len() < reach {
                return Err(PartError::TooThin { axis: name, rows: rows.len(), reach });
            }
        }
        Ok(())
    }

    /// The number of cells along x, y, z.
    pub fn extents(&self, geometry: &Geometry) -> [usize; 3] {
        [geometry.extents()[0], self.y.len(), self.z.len()]
    }

    /// The number of cells.
    pub fn cells(&self, geometry: &Geometry) -> usize {
        self.extents(geometry).iter().product()
    }

    /// The indices in the whole space of the cell with this number among those of the part.
    pub fn indices(&self, geometry: &Geometry, cell: usize) -> [usize; 3] {
        let [width, height, _] = self.extents(geometry);
        [cell % width, self.y.start + cell / width % height, self.z.start + cell / (width * height)]
    }

    /// Whether the cell with this linear index belongs to the part.
    pub fn holds(&self, geometry: &Geometry, cell: usize) -> bool {
        let [_, y, z] = geometry.indices(cell);
        self.y.contains(&y) && self.z.contains(&z)
    }

    /// The rows of the part by their numbers in the whole space, in order: those that follow each other
    /// together.
    pub fn runs(&self, geometry: &Geometry) -> impl Iterator<Item = Range<usize>> + use<> {
        let (height, y) = (geometry.extents()[1], self.y.clone());
        self.z.clone().map(move |z| z * height + y.start..z * height + y.end)
    }

    /// The faces of the part beyond which another part lies.
    pub fn borders(&self, geometry: &Geometry) -> Faces<bool> {
        Faces::from_fn(|face| {
            let rows = match face.axis() {
                0 => return false,
                1 => &self.y,
                _ => &self.z,
            };
            let all = geometry.extents()[face.axis()];
            let [low, _] = Face::ALONG[face.axis()];
            let at_face = if face == low { rows.start == 0 } else { rows.end == all };
            rows.len() < all && (!at_face || geometry.boundaries()[face] == Boundary::Toroidal)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{Part, PartError};
    use xca_process::{Boundary, Faces, Geometry, Neighbourhood};

    fn space(boundaries: Faces<Boundary>) -> Geometry {
        Geometry::new([3, 6, 4], 1.0, boundaries, Neighbourhood::moore(2))
    }

    #[test]
    fn rows_and_cells_by_hand() {
        let geometry = space(Faces::all(Boundary::Flat));
        let part = Part { y: 2..4, z: 1..3 };
        assert_eq!(part.check(&geometry), Ok(()));
        assert_eq!(part.runs(&geometry).collect::<Vec<_>>(), [8..10, 14..16]);
        let held: Vec<usize> = (0..72).filter(|cell| part.holds(&geometry, *cell)).collect();
        assert_eq!(held, (24..30).chain(42..48).collect::<Vec<_>>());
        let indices: Vec<usize> =
            (0..12).map(|cell| geometry.linear(part.indices(&geometry, cell))).collect();
        assert_eq!(indices, held);
        assert_eq!((part.extents(&geometry), part.cells(&geometry)), ([3, 2, 2], 12));
    }

    #[test]
    fn other_parts_lie_beyond_cuts_and_round_a_torus() {
        let ring = Faces { south: Boundary::Toroidal, north: Boundary::Toroidal, ..Faces::default() };
        for (geometry, south) in [(space(Faces::default()), false), (space(ring), true)] {
            let borders = Part { y: 0..3, z: 0..4 }.borders(&geometry);
            assert_eq!(borders, Faces { south, north: true, ..Faces::all(false) });
            assert_eq!(Part::whole(&geometry).borders(&geometry), Faces::all(false));
            let borders = Part { y: 0..6, z: 2..4 }.borders(&geometry);
            assert_eq!(borders, Faces { bottom: true, ..Faces::all(false) });
        }
    }

    #[test]
    fn what_cannot_be_is_refused() {
        let geometry = space(Faces::default());
        let check = |y, z| Part { y, z }.check(&geometry);
        assert_eq!(check(0..1, 0..4), Err(PartError::TooThin { axis: 'y', rows: 1, reach: 2 }));
        assert_eq!(check(0..6, 3..4), Err(PartError::TooThin { axis: 'z', rows: 1, reach: 2 }));
        assert_eq!(check(5..7, 0..4), Err(PartError::NoSuchRows { axis: 'y', rows: 6, start: 5, end: 7 }));
        assert_eq!(check(0..6, 2..2), Err(PartError::NoSuchRows { axis: 'z', rows: 4, start: 2, end: 2 }));
    }
}
