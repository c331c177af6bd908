//! The positions of the neighbours of a row's cells.
//!
//! Kernels are generic in the [shape](xca_space::shapes) of the neighbourhood. For a known shape,
//! indices, opposites and displacements are constants of the kernel.

use super::Row;
use super::cells::Offset;
use std::marker::PhantomData;
use xca_space::shapes::{self, ANY, HEXAGONAL, Shape, ShapeNumber};
use xca_space::{Boundary, Faces};
use xca_values::Vector3;

/// The neighbourhood of a row's cells as distances in memory. An index beyond it is a fault, and refers to
/// the cell itself.
#[derive(Debug, Clone, Copy)]
pub struct Offsets<'a, const SHAPE: ShapeNumber> {
    /// The distances of a known shape.
    fixed: [isize; shapes::MOST],
    any: &'a [isize],
}

impl<const SHAPE: ShapeNumber> Offsets<'_, SHAPE> {
    const KNOWN: Shape = shapes::shape(SHAPE);

    /// The number of cells.
    #[inline(always)]
    pub fn count(&self) -> usize {
        if SHAPE == ANY { self.any.len() } else { Self::KNOWN.size }
    }

    /// The offset of the neighbour with this index.
    #[inline(always)]
    pub fn at<'r>(&self, index: usize, row: &'r Row<'_>, x: usize) -> Offset<'r> {
        let distance = if index < self.count() {
            if SHAPE == ANY { self.any[index] } else { self.fixed[index] }
        } else {
            row.beyond_neighbourhood(x, index);
            0
        };
        Offset { distance, row: PhantomData }
    }

    /// The offset of a neighbour that will be requested. An invalid index is no fault here.
    #[inline(always)]
    pub fn foreseen<'r>(&self, index: usize) -> Offset<'r> {
        let distance = if index >= self.count() {
            0
        } else if SHAPE == ANY {
            self.any[index]
        } else {
            self.fixed[index]
        };
        Offset { distance, row: PhantomData }
    }
}

/// The neighbourhood of a row's cells as directions. An index beyond it is the same fault as in a read of a
/// neighbour, and refers to the cell itself.
#[derive(Debug, Clone, Copy)]
pub struct Directions<'a, const SHAPE: ShapeNumber> {
    displacements: &'a [[i32; 3]],
    opposites: &'a [Option<usize>],
    /// The faces beyond which neighbours can be outside.
    flat: Faces<bool>,
}

impl<const SHAPE: ShapeNumber> Directions<'_, SHAPE> {
    const KNOWN: Shape = shapes::shape(SHAPE);

    /// Whether there is a neighbour with this index. If not, it is a fault.
    #[inline(always)]
    fn check(&self, index: usize, row: &Row<'_>, x: usize) -> bool {
        let count = if SHAPE == ANY { self.displacements.len() } else { Self::KNOWN.size };
        if index >= count {
            row.beyond_neighbourhood(x, index);
        }
        index < count
    }

    /// The index of the neighbour in the opposite direction.
    #[inline(always)]
    pub fn opposite(&self, index: usize, row: &Row<'_>, x: usize) -> usize {
        if !self.check(index, row, x) {
            0
        } else if SHAPE == ANY {
            // Building the model ensures that no opposite is missing.
            self.opposites[index].unwrap_or(0)
        } else {
            Self::KNOWN.opposite(index)
        }
    }

    /// The opposite index of a neighbour that will be requested. An invalid index is no fault here.
    #[inline(always)]
    pub fn opposite_foreseen(&self, index: usize) -> usize {
        let known = if SHAPE == ANY { self.opposites.len() } else { Self::KNOWN.size };
        if index >= known {
            0
        } else if SHAPE == ANY {
            self.opposites[index].unwrap_or(0)
        } else {
            Self::KNOWN.opposite(index)
        }
    }

    /// The displacement from the cell to the neighbour.
    #[inline(always)]
    pub fn displacement(&self, index: usize, row: &Row<'_>, x: usize) -> Vector3<i32> {
        let [x, y, z] = if !self.check(index, row, x) {
            [0; 3]
        } else if SHAPE == ANY || SHAPE == HEXAGONAL {
            self.displacements[index]
        } else {
            Self::KNOWN.displacements[index]
        };
        Vector3::new(x, y, z)
    }

    /// Whether the neighbour is a cell of the space.
    #[inline(always)]
    pub fn exists(&self, index: usize, row: &Row<'_>, x: usize) -> bool {
        let (here, step) = (row.index(x), self.displacement(index, row, x));
        let [width, height, depth] = row.frame.extents;
        let inside = |here: i32, step: i32, extent: u32, low: bool, high: bool| {
            let there = here.wrapping_add(step);
            (step == 0) | !((low & (there < 0)) | (high & (there >= extent as i32)))
        };
        inside(here.x, step.x, width, self.flat.west, self.flat.east)
            & inside(here.y, step.y, height, self.flat.south, self.flat.north)
            & inside(here.z, step.z, depth, self.flat.bottom, self.flat.top)
    }
}

impl<'a> Row<'a> {
    /// The shape of the neighbourhood.
    #[inline(always)]
    pub fn shape(&self) -> ShapeNumber {
        self.frame.geometry.neighbourhood().shape()
    }

    /// The distances of the neighbours in memory.
    #[inline(always)]
    pub fn offsets<const SHAPE: ShapeNumber>(&self) -> Offsets<'a, SHAPE> {
        let any = self.frame.offsets;
        let mut fixed = [0; shapes::MOST];
        let size = Offsets::<SHAPE>::KNOWN.size;
        // The compiler knows this number of bytes, so that the offsets stay in registers.
        if let Some(any) = any.get(..size) {
            fixed[..size].copy_from_slice(any);
        }
        Offsets { fixed, any }
    }

    /// The neighbours. All cells of the row have the same neighbourhood.
    #[inline(always)]
    pub fn directions<const SHAPE: ShapeNumber>(&self) -> Directions<'a, SHAPE> {
        let geometry = self.frame.geometry;
        let neighbourhood = geometry.neighbourhood();
        Directions {
            displacements: neighbourhood.displacements(self.origin.map(|index| index as usize)),
            opposites: neighbourhood.opposites(),
            flat: geometry.boundaries().map(|boundary| *boundary == Boundary::Flat),
        }
    }
}
