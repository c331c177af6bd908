//! The place of a layer of cells on a map.

use std::fmt;

/// The tolerance for equal corners and sides, and for the rounding of coordinates, in sides of a cell.
const TOLERANCE: f64 = 1e-6;

/// The place of a layer of square cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    /// The number of columns and rows.
    pub extents: [usize; 2],
    /// The south-west corner of the south-west cell, in the units of the map.
    pub corner: [f64; 2],
    /// The side of a cell, in the units of the map.
    pub side: f64,
}

impl Placement {
    /// Checks that `f64` holds the coordinates of the cells: the next number after the largest one is within
    /// 1e-6 of a cell.
    ///
    /// # Errors
    /// [`CoarsePlace`] with the largest coordinate.
    pub fn checked(self) -> Result<Self, CoarsePlace> {
        let Self { extents, corner, side } = self;
        let far = |axis: usize| corner[axis] + extents[axis] as f64 * side;
        let coordinates = [corner[0], corner[1], far(0), far(1)].map(f64::abs);
        let is_exact = |of: f64| of.is_finite() && of.next_up() - of <= TOLERANCE * side;
        match coordinates.into_iter().find(|coordinate| !is_exact(*coordinate)) {
            Some(coordinate) => Err(CoarsePlace { coordinate, side }),
            None => Ok(self),
        }
    }

    /// The first difference between two places: extents, side or corner. Sides and corners within 1e-6 of a
    /// cell are equal, so the number of written digits does not matter.
    pub fn difference(&self, other: &Self) -> Option<PlacementDifference> {
        let is_near = |one: f64, other: f64| (one - other).abs() <= TOLERANCE * self.side;
        let corners = || self.corner.iter().zip(other.corner);
        if self.extents != other.extents {
            Some(PlacementDifference::Extents { found: self.extents, wanted: other.extents })
        } else if !is_near(self.side, other.side) {
            Some(PlacementDifference::Side { found: self.side, wanted: other.side })
        } else if !corners().all(|(one, other)| is_near(*one, other)) {
            Some(PlacementDifference::Corner { found: self.corner, wanted: other.corner })
        } else {
            None
        }
    }

    /// Column and row of a cell as counted in a file: from 1, from the west and the north.
    pub fn place(&self, cell: usize) -> [usize; 2] {
        let [columns, rows] = self.extents;
        [cell % columns.max(1) + 1, rows.saturating_sub(cell / columns.max(1))]
    }
}

/// A place so far from the origin that its cells have no coordinates of their own.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "a coordinate of {coordinate:e} is too large for cells with a side of {side}: rounding moves them; correct \
     the corner, or count from a nearer origin"
)]
pub struct CoarsePlace {
    /// The size of the coordinate.
    pub coordinate: f64,
    /// The side of a cell.
    pub side: f64,
}

/// The difference of two places: the value of each.
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum PlacementDifference {
    Extents { found: [usize; 2], wanted: [usize; 2] },
    Side { found: f64, wanted: f64 },
    Corner { found: [f64; 2], wanted: [f64; 2] },
}

impl fmt::Display for PlacementDifference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Extents { found: [x, y], wanted: [u, v] } => {
                write!(f, "it has {x} x {y} cells, not {u} x {v}")
            }
            Self::Side { found, wanted } => write!(f, "its cells have a side of {found}, not {wanted}"),
            Self::Corner { found: [x, y], wanted: [u, v] } => {
                write!(f, "its south-west corner is {x}, {y}, not {u}, {v}")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Placement;

    /// Between 2^n and 2^(n + 1), numbers are 2^(n - 52) apart.
    #[test]
    fn cells_have_coordinates_of_their_own() {
        let place = |x: f64, columns: usize, side: f64| {
            let placement = Placement { extents: [columns, 2], corner: [x, 0.0], side };
            placement.checked().map_err(|problem| problem.coordinate)
        };
        let far = 2.0_f64.powi(40);
        let least = 2.0_f64.powi(40 - 52) / 1e-6;
        assert!(place(far, 3, 1.001 * least).is_ok() && place(-far, 3, 1.001 * least).is_ok());
        assert_eq!(place(far, 3, 0.999 * least), Err(far));
        assert_eq!(place(-far, 3, 0.999 * least), Err(far));
        // Only the eastern end is too far.
        assert!(place(0.0, 1000, 1e300).is_ok());
        assert_eq!(place(0.0, 1000, 1e306), Err(f64::INFINITY));
        // Degrees, a town in millimetres, and a laboratory.
        assert!(
            [place(-180.0, 43_200, 1.0 / 3600.0), place(6e6, 9, 1e-3), place(0.0, 9, 1e-12)]
                .iter()
                .all(Result::is_ok)
        );
        assert!([f64::NAN, f64::INFINITY, 1e20].iter().all(|x| place(*x, 4, 10.0).is_err()));
    }
}
