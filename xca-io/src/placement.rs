//! The place of a layer of cells on a map.

use std::fmt;

/// The tolerance for equal corners and sides, in sides of a cell.
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
