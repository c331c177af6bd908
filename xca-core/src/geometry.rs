//! The cellular space: extents, boundaries, and which cell lies where.

use crate::neighbourhood::Neighbourhood;
use crate::value::Precision;
use std::fmt;

mod cover;

/// What lies beyond the faces of the space along one axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Boundary {
    /// Cells that hold a fixed value, the model's outside state.
    #[default]
    Flat,
    /// The opposite side.
    Toroidal,
    /// The mirror image: beyond cell 0 lies cell 0, then cell 1.
    Reflecting,
}

impl fmt::Display for Boundary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Flat => "flat",
            Self::Toroidal => "toroidal",
            Self::Reflecting => "reflecting",
        })
    }
}

/// The shape of the cellular space.
#[derive(Debug, Clone, PartialEq)]
pub struct Geometry {
    extents: [usize; 3],
    side: f64,
    boundaries: [Boundary; 3],
    neighbourhood: Neighbourhood,
    /// The radius that the neighbourhood covers, in sides of a cell.
    covered: f64,
}

impl Geometry {
    pub(crate) fn new(
        extents: [usize; 3],
        side: f64,
        boundaries: [Boundary; 3],
        neighbourhood: Neighbourhood,
    ) -> Self {
        let mut geometry = Self { extents, side, boundaries, neighbourhood, covered: 0.0 };
        geometry.covered = cover::covered(&geometry);
        geometry
    }

    /// The number of cells along x, y, z.
    pub fn extents(&self) -> [usize; 3] {
        self.extents
    }

    /// The side of a cell in metres.
    pub fn side(&self) -> f64 {
        self.side
    }

    /// What lies beyond the faces along x, y, z.
    pub fn boundaries(&self) -> [Boundary; 3] {
        self.boundaries
    }

    /// Which cells a cell sees.
    pub fn neighbourhood(&self) -> &Neighbourhood {
        &self.neighbourhood
    }

    /// The largest radius of a search for other items, in metres, as a run of this precision computes it. A
    /// search with a larger one is a fault.
    ///
    /// It is the distance from a cell to the nearest cell of the space that is not in its neighbourhood,
    /// cells being boxes: within it, an item that is inside its cell finds all others that are inside theirs.
    /// A Moore neighbourhood of radius `r` covers `r` sides of a cell; von Neumann and hexagonal
    /// neighbourhoods of radius 1 cover 0, as they lack cells that touch at an edge or a corner. It is
    /// infinite where the neighbourhood holds the whole space.
    #[inline]
    pub fn covered_radius(&self, precision: Precision) -> f64 {
        match precision {
            Precision::F32 => f64::from(self.covered as f32 * self.side as f32),
            Precision::F64 => self.covered * self.side,
        }
    }

    /// The number of cells.
    pub fn cells(&self) -> usize {
        self.extents.iter().product()
    }

    /// The linear index of a cell: x fastest, z slowest.
    pub fn linear(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.extents[1] + y) * self.extents[0] + x
    }

    /// The indices of the cell with this linear index.
    pub fn indices(&self, linear: usize) -> [usize; 3] {
        let [width, height, _] = self.extents;
        [linear % width, linear / width % height, linear / (width * height)]
    }

    /// The indices of the cell that contains a position, where there is one.
    pub fn cell_containing(&self, position: [f64; 3]) -> Option<[usize; 3]> {
        let mut cell = [0; 3];
        for axis in 0..3 {
            let number = (position[axis] / self.side).floor();
            if !(number >= 0.0 && number < self.extents[axis] as f64) {
                return None;
            }
            cell[axis] = number as usize;
        }
        Some(cell)
    }

    /// The cell at a displacement, by the boundary rules; nothing where it lies beyond a flat face.
    pub fn at(&self, cell: [usize; 3], displacement: [i32; 3]) -> Option<[usize; 3]> {
        let mut target = [0; 3];
        for axis in 0..3 {
            target[axis] = along(cell[axis], displacement[axis], self.extents[axis], self.boundaries[axis])?;
        }
        Some(target)
    }
}

fn along(index: usize, step: i32, extent: usize, boundary: Boundary) -> Option<usize> {
    let (target, extent) = (index as i64 + i64::from(step), extent as i64);
    let inside = match boundary {
        _ if (0..extent).contains(&target) => target,
        Boundary::Flat => return None,
        Boundary::Toroidal => target.rem_euclid(extent),
        // A mirror at each face: the pattern repeats after twice the extent.
        Boundary::Reflecting => {
            let folded = target.rem_euclid(2 * extent);
            if folded < extent { folded } else { 2 * extent - 1 - folded }
        }
    };
    usize::try_from(inside).ok()
}

#[cfg(test)]
mod tests {
    use super::{Boundary, along};

    #[test]
    fn boundaries_by_hand() {
        let row = |boundary| (-3..8).map(|step| along(0, step, 5, boundary)).collect::<Vec<_>>();
        let some = |list: [usize; 11]| list.map(Some).to_vec();
        assert_eq!(row(Boundary::Toroidal), some([2, 3, 4, 0, 1, 2, 3, 4, 0, 1, 2]));
        assert_eq!(row(Boundary::Reflecting), some([2, 1, 0, 0, 1, 2, 3, 4, 4, 3, 2]));
        let flat = row(Boundary::Flat);
        assert_eq!(flat[..3], [None; 3]);
        assert_eq!(flat[3..8], some([2, 3, 4, 0, 1, 2, 3, 4, 0, 1, 2])[3..8]);
        assert_eq!(flat[8..], [None; 3]);
    }
}
