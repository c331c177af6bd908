//! Where the neighbours of a row's cells lie.

use super::Row;
use crate::geometry::{Boundary, Faces};
use crate::vector::Vector3;

/// The neighbourhood of a row's cells as directions: `K` cells known to the compiler by number, or any number
/// where `K` is 0. An index beyond it is the same fault as for a neighbour's substate, and means the cell
/// itself.
#[derive(Debug, Clone, Copy)]
pub struct Directions<'a, const K: usize> {
    fixed: Listed<[[i32; 3]; K], [Option<usize>; K]>,
    any: Listed<&'a [[i32; 3]], &'a [Option<usize>]>,
    /// The faces beyond which neighbours may lie outside.
    flat: Faces<bool>,
}

/// What is known of each neighbour.
#[derive(Debug, Clone, Copy)]
struct Listed<D, O> {
    displacements: D,
    opposites: O,
}

impl<const K: usize> Directions<'_, K> {
    /// The index of the neighbour in the opposite direction.
    #[inline(always)]
    pub fn opposite(&self, index: usize, row: &Row<'_>, x: usize) -> usize {
        let opposite = if K > 0 {
            self.fixed.opposites.get(index).copied()
        } else {
            self.any.opposites.get(index).copied()
        };
        // Building the model has excluded that an opposite is missing.
        opposite.map_or_else(|| beyond(index, row, x), |opposite| opposite.unwrap_or(0))
    }

    /// The displacement from the cell to the neighbour.
    #[inline(always)]
    pub fn displacement(&self, index: usize, row: &Row<'_>, x: usize) -> Vector3<i32> {
        let displacement = if K > 0 {
            self.fixed.displacements.get(index).copied()
        } else {
            self.any.displacements.get(index).copied()
        };
        let [x, y, z] = displacement.unwrap_or_else(|| {
            beyond(index, row, x);
            [0; 3]
        });
        Vector3::new(x, y, z)
    }

    /// Whether the neighbour is a cell of the space.
    #[inline(always)]
    pub fn exists(&self, index: usize, row: &Row<'_>, x: usize) -> bool {
        let (here, step) = (row.index(x), self.displacement(index, row, x));
        let [width, height, depth] = row.frame.extents;
        let inside = |here: i32, step: i32, extent: u32, low: bool, high: bool| {
            let there = here.wrapping_add(step);
            !((low & (there < 0)) | (high & (there >= extent as i32)))
        };
        inside(here.x, step.x, width, self.flat.west, self.flat.east)
            & inside(here.y, step.y, height, self.flat.south, self.flat.north)
            & inside(here.z, step.z, depth, self.flat.bottom, self.flat.top)
    }
}

#[inline(always)]
fn beyond(index: usize, row: &Row<'_>, x: usize) -> usize {
    row.beyond_neighbourhood(x, index);
    0
}

impl<'a> Row<'a> {
    /// Where the neighbours lie. All cells of the row have the same neighbourhood.
    #[inline(always)]
    pub fn directions<const K: usize>(&self) -> Directions<'a, K> {
        let geometry = self.frame.geometry;
        let neighbourhood = geometry.neighbourhood();
        let any = Listed {
            displacements: neighbourhood.displacements(self.origin.map(|index| index as usize)),
            opposites: neighbourhood.opposites(),
        };
        let fixed = Listed {
            displacements: any.displacements.first_chunk().copied().unwrap_or([[0; 3]; K]),
            opposites: any.opposites.first_chunk().copied().unwrap_or([None; K]),
        };
        let flat = geometry.boundaries().map(|boundary| *boundary == Boundary::Flat);
        Directions { fixed, any, flat }
    }
}
