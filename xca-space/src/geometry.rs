//! The cellular space: extents, boundaries, and the positions of cells.

mod cover;
mod faces;

pub use faces::{Face, Faces};

use crate::neighbourhood::Neighbourhood;
use cover::Covering;
use std::fmt;
use xca_values::Precision;

/// What a cell at a face sees beyond it.
///
/// ```
/// use xca_core::prelude::*;
/// # #[derive(Substates, Clone, Copy)]
/// # struct Sand { height: Real }
/// # #[elementary_process]
/// # fn shift(cell: &mut Cell<Sand>) {
/// #     cell.height = cell.neighbour(directions::von_neumann_2d::WEST).height;
/// # }
///
/// let first_after_one_step = |boundary| -> Result<f64, Box<dyn std::error::Error>> {
///     let model = Model::builder("belt")
///         .extents([4, 1, 1])
///         .neighbourhood(Neighbourhood::von_neumann_2d(1))
///         .boundaries([boundary, Boundary::Flat, Boundary::Flat])
///         .substates_with_outside(Sand { height: 9.0 })
///         .process(shift) // each cell takes the value of its western neighbour
///         .fill(|site| Sand { height: site.cell()[0] as f64 })
///         .build()?;
///     let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
///     simulation.step()?;
///     Ok(simulation.state().get(Sand::HEIGHT, [0, 0, 0])?)
/// };
/// assert_eq!(first_after_one_step(Boundary::Flat)?, 9.0);
/// assert_eq!(first_after_one_step(Boundary::Toroidal)?, 3.0);
/// assert_eq!(first_after_one_step(Boundary::Reflecting)?, 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Boundary {
    /// A fixed value, the outside value of the face.
    #[default]
    Flat,
    /// Periodic: the cells of the opposite side. The opposite face is toroidal too.
    Toroidal,
    /// The mirror image: beyond cell 0 lies cell 0, then cell 1. With a reach of one cell, the gradient
    /// across the face is zero.
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

impl fmt::Display for Faces<Boundary> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if Face::ALL.iter().all(|face| self[*face] == self.west) {
            return self.west.fmt(f);
        }
        for (number, [low, high]) in Face::ALONG.into_iter().enumerate() {
            let separator = if number > 0 { ", " } else { "" };
            write!(f, "{separator}{} {}", ["x", "y", "z"][number], self[low])?;
            if self[high] != self[low] {
                write!(f, " ({low}) and {} ({high})", self[high])?;
            }
        }
        Ok(())
    }
}

/// The place to which a displacement leads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reached {
    /// The cell with these indices.
    Cell([usize; 3]),
    /// Outside the space, beyond this flat face.
    Outside(Face),
}

/// The cellular space: extents, cell side, boundaries and neighbourhood.
///
/// ```
/// use xca_core::prelude::*;
///
/// #[derive(Substates, Clone)]
/// struct Site {
///     height: Real,
/// }
///
/// let builder = Model::builder("site").extents([4, 3, 1]).cell_side(0.5).substates::<Site>();
/// let model = builder.boundary(Boundary::Toroidal).build()?;
/// let geometry = model.geometry();
/// assert_eq!(geometry.cell_containing([0.6, 1.4, 0.1]), Some([1, 2, 0]));
/// assert_eq!(geometry.linear([1, 2, 0]), 9);
/// assert_eq!(geometry.at([3, 2, 0], [1, 1, 0]), Some([0, 0, 0]));
/// # Ok::<(), ModelError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Geometry {
    extents: [usize; 3],
    side: f64,
    boundaries: Faces<Boundary>,
    neighbourhood: Neighbourhood,
    /// The radius that the neighbourhood covers, in sides of a cell.
    covered: f64,
}

impl Geometry {
    /// A space of cells with this side in metres.
    pub fn new(
        extents: [usize; 3],
        side: f64,
        boundaries: Faces<Boundary>,
        neighbourhood: Neighbourhood,
    ) -> Self {
        let mut geometry = Self { extents, side, boundaries, neighbourhood, covered: 0.0 };
        geometry.covered = cover::covered(Covering {
            extents,
            toroidal: geometry.toroidal(),
            neighbourhood: &geometry.neighbourhood,
        });
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

    /// The boundary of each face.
    pub fn boundaries(&self) -> Faces<Boundary> {
        self.boundaries
    }

    /// Whether the axes x, y, z are toroidal.
    pub fn toroidal(&self) -> [bool; 3] {
        // Both faces of an axis are toroidal, or neither: the model is checked.
        Face::ALONG.map(|[low, _]| self.boundaries[low] == Boundary::Toroidal)
    }

    /// The cells that a process sees.
    pub fn neighbourhood(&self) -> &Neighbourhood {
        &self.neighbourhood
    }

    /// The largest radius of a search for other items, in metres, at this precision. A search with a larger
    /// one is a fault.
    ///
    /// It is the distance from a cell to the nearest cell of the space that is not in its neighbourhood. A
    /// Moore neighbourhood of radius `r` covers `r` cell sides. Von Neumann and hexagonal neighbourhoods of
    /// radius 1 cover 0: they lack cells that touch at an edge or a corner. It is infinite if the
    /// neighbourhood holds the whole space.
    ///
    /// Within this radius an item finds all others, as long as every item is inside its cell.
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

    /// The centre of a cell in metres, from the corner of the space. It ignores the shift of odd rows or
    /// columns of hexagons.
    pub fn centre(&self, cell: [usize; 3]) -> [f64; 3] {
        cell.map(|index| (index as f64 + 0.5) * self.side)
    }

    /// The indices of the cell that contains a position, if there is one.
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

    /// The place to which a displacement leads, by the boundary rules.
    ///
    /// Each axis follows its own rule. Beyond several flat faces, z counts before y, and y before x.
    pub fn reach(&self, cell: [usize; 3], displacement: [i32; 3]) -> Reached {
        let mut target = [0; 3];
        for axis in [2, 1, 0] {
            match self.along(axis, cell[axis], displacement[axis]) {
                Ok(index) => target[axis] = index,
                Err(face) => return Reached::Outside(face),
            }
        }
        Reached::Cell(target)
    }

    /// The cell at a displacement, by the boundary rules; `None` beyond a flat face.
    pub fn at(&self, cell: [usize; 3], displacement: [i32; 3]) -> Option<[usize; 3]> {
        match self.reach(cell, displacement) {
            Reached::Cell(cell) => Some(cell),
            Reached::Outside(_) => None,
        }
    }

    /// The index to which a step along an axis leads, or the flat face that the step crosses.
    fn along(&self, axis: usize, index: usize, step: i32) -> Result<usize, Face> {
        let (mut target, extent) = (index as i64 + i64::from(step), self.extents[axis] as i64);
        let [low, high] = Face::ALONG[axis];
        let of = |face| self.boundaries[face];
        if of(low) == Boundary::Reflecting && of(high) == Boundary::Reflecting {
            // Between two mirrors the pattern repeats after twice the extent.
            target = target.rem_euclid(2 * extent);
        }
        // A mirror image may itself lie beyond the other face.
        while !(0..extent).contains(&target) {
            let face = if target < 0 { low } else { high };
            target = match of(face) {
                Boundary::Flat => return Err(face),
                Boundary::Toroidal => target.rem_euclid(extent),
                Boundary::Reflecting if face == low => -1 - target,
                Boundary::Reflecting => 2 * extent - 1 - target,
            };
        }
        Ok(target as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::{Boundary, Face, Faces, Geometry, Reached};
    use crate::neighbourhood::Neighbourhood;

    use Boundary::{Flat, Reflecting, Toroidal};

    fn geometry(extents: [usize; 3], boundaries: Faces<Boundary>) -> Geometry {
        Geometry::new(extents, 1.0, boundaries, Neighbourhood::moore(1))
    }

    /// A row of five cells, seen from the first one.
    fn row(west: Boundary, east: Boundary) -> [Option<usize>; 11] {
        let space = geometry([5, 1, 1], Faces { west, east, ..Faces::default() });
        std::array::from_fn(|step| space.at([0; 3], [step as i32 - 3, 0, 0]).map(|[x, ..]| x))
    }

    #[test]
    fn boundaries_by_hand() {
        let list = |text: &str| -> Vec<Option<usize>> {
            text.chars().map(|digit| digit.to_digit(10).map(|digit| digit as usize)).collect()
        };
        for (west, east, wanted) in [
            (Toroidal, Toroidal, "23401234012"),
            (Reflecting, Reflecting, "21001234432"),
            (Flat, Flat, "---01234---"),
            (Flat, Reflecting, "---01234432"),
            (Reflecting, Flat, "21001234---"),
        ] {
            assert_eq!(row(west, east).to_vec(), list(wanted), "{west} {east}");
        }
        // Between two mirrors, the pattern repeats. With a flat face opposite, a mirror shows the image of
        // the outside.
        let space = |east| geometry([5, 1, 1], Faces { west: Reflecting, east, ..Faces::default() });
        assert_eq!(space(Reflecting).at([1, 0, 0], [-12, 0, 0]), Some([0; 3]));
        assert_eq!(space(Flat).reach([1, 0, 0], [-7, 0, 0]), Reached::Outside(Face::East));
    }

    #[test]
    fn beyond_several_faces_the_last_axis_counts() {
        let space = geometry([2, 2, 2], Faces { top: Reflecting, ..Faces::default() });
        let reached = |displacement| space.reach([1, 1, 1], displacement);
        assert_eq!(reached([1, 0, 0]), Reached::Outside(Face::East));
        assert_eq!(reached([1, 1, 0]), Reached::Outside(Face::North));
        assert_eq!(reached([-2, -2, -2]), Reached::Outside(Face::Bottom));
        assert_eq!(reached([0, -2, 1]), Reached::Outside(Face::South));
        assert_eq!(reached([-1, 0, 1]), Reached::Cell([0, 1, 1]));
    }

    #[test]
    fn faces_as_text() {
        assert_eq!(Faces::all(Flat).to_string(), "flat");
        let mixed = Faces { north: Reflecting, ..Faces::from([Toroidal, Flat, Flat]) };
        assert_eq!(mixed.to_string(), "x toroidal, y flat (south) and reflecting (north), z flat");
    }
}
