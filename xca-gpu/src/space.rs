//! Where cells lie in the device's memory: rows along x with a halo around the space, or around the own part
//! of it, cut into sections that a process can reach at once.
//!
//! Cells have their indices in the whole space everywhere.

use std::ops::Range;
use xca_core::engine::Part;
use xca_core::{Boundary, Face, Geometry, Reached};

/// Where the stored cells of a section begin is a multiple of this, so that each substate of theirs begins
/// where a binding may.
const ALIGNMENT: usize = 64;

/// The stored space.
#[derive(Debug, Clone)]
pub(crate) struct Space {
    geometry: Geometry,
    /// The part of the space whose cells are stored.
    part: Part,
    reach: [usize; 3],
    /// The stored cells from one row to the next, and from one layer to the next.
    row: usize,
    layer: usize,
    sections: Vec<Section>,
}

/// Cells that are worked on together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Section {
    /// The indices of the first.
    pub(crate) first: [usize; 3],
    /// How many along each axis.
    pub(crate) count: [usize; 3],
    /// The stored cells that they and their neighbours lie in.
    pub(crate) base: usize,
    /// How many these are.
    pub(crate) stored: usize,
}

impl Section {
    /// The workgroups of this size along each axis that cover its cells.
    pub(crate) fn workgroups(&self, size: [u32; 3]) -> [u32; 3] {
        std::array::from_fn(|axis| (self.count[axis] as u32).div_ceil(size[axis]))
    }
}

/// A cell of the halo.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct HaloCell {
    /// Its stored number.
    pub(crate) number: usize,
    pub(crate) shows: Shown,
}

/// What a cell of the halo shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Shown {
    /// The own cell with this stored number.
    Cell(usize),
    /// A cell of another part.
    Elsewhere,
    /// What lies beyond a flat face.
    Outside(Face),
}

/// A space that cannot be cut so that its sections can be reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct TooLarge {
    /// The stored cells that would have to be reached at once.
    pub(crate) wanted: u128,
}

impl Space {
    /// Lays the cells of a part out; at most so many stored cells can be reached at once.
    pub(crate) fn new(geometry: &Geometry, part: &Part, reachable: u64) -> Result<Self, TooLarge> {
        let (extents, reach) = (part.extents(geometry), geometry.neighbourhood().reach());
        let padded: [usize; 3] = std::array::from_fn(|axis| extents[axis] + 2 * reach[axis]);
        let product = |row: usize, layers: usize| row as u128 * padded[1] as u128 * layers as u128;
        // Cells are numbered in 32 bits, and their distances with a sign.
        let all = product(padded[0].next_multiple_of(ALIGNMENT), padded[2]) + (padded[2] * ALIGNMENT) as u128;
        if all > i32::MAX as u128 {
            return Err(TooLarge { wanted: all });
        }
        let mut space = Self {
            geometry: geometry.clone(),
            part: part.clone(),
            reach,
            row: padded[0],
            layer: padded[0] * padded[1],
            sections: Vec::new(),
        };
        if product(padded[0], padded[2]) <= u128::from(reachable) {
            let (first, stored) = (space.origin(), space.stored());
            space.sections = vec![Section { first, count: extents, base: 0, stored }];
            return Ok(space);
        }
        // Layers are cut apart, or where there is but one, rows.
        let axis = if padded[2] > 1 { 2 } else { 1 };
        if axis == 1 {
            space.row = padded[0].next_multiple_of(ALIGNMENT);
        }
        space.layer = (space.row * padded[1]).next_multiple_of(ALIGNMENT);
        let step = if axis == 1 { space.row } else { space.layer };
        let around = 2 * reach[axis];
        let most = usize::try_from(reachable).unwrap_or(usize::MAX) / step;
        if most <= around {
            return Err(TooLarge { wanted: (step * (around + 1)) as u128 });
        }
        space.sections = (0..extents[axis])
            .step_by(most - around)
            .map(|start| {
                let (mut first, mut count) = (space.origin(), extents);
                first[axis] += start;
                count[axis] = (most - around).min(extents[axis] - start);
                Section { first, count, base: start * step, stored: (count[axis] + around) * step }
            })
            .collect();
        Ok(space)
    }

    /// The whole space.
    pub(crate) fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    /// The part of the space whose cells are stored.
    pub(crate) fn part(&self) -> &Part {
        &self.part
    }

    /// The number of cells along each axis, without those of other parts.
    pub(crate) fn extents(&self) -> [usize; 3] {
        self.part.extents(&self.geometry)
    }

    /// The first cell.
    fn origin(&self) -> [usize; 3] {
        [0, self.part.y.start, self.part.z.start]
    }

    /// How many stored cells would come before the first stored one, if those of the whole space were stored
    /// in the same way. Shaders compute with it modulo 2^32.
    pub(crate) fn shift(&self) -> u32 {
        let [_, y, z] = self.origin();
        (y as u32).wrapping_mul(self.row as u32).wrapping_add((z as u32).wrapping_mul(self.layer as u32))
    }

    pub(crate) fn reach(&self) -> [usize; 3] {
        self.reach
    }

    /// The sections, in the order of cells.
    pub(crate) fn sections(&self) -> &[Section] {
        &self.sections
    }

    /// The section that a cell lies in.
    pub(crate) fn section_of(&self, cell: [usize; 3]) -> Option<&Section> {
        self.sections
            .iter()
            .find(|section| (0..3).all(|axis| cell[axis] < section.first[axis] + section.count[axis]))
    }

    /// The number of stored cells from one row to the next.
    pub(crate) fn row(&self) -> usize {
        self.row
    }

    /// The number of stored cells from one layer to the next.
    pub(crate) fn layer(&self) -> usize {
        self.layer
    }

    /// The number of stored cells.
    pub(crate) fn stored(&self) -> usize {
        self.layer * (self.part.z.len() + 2 * self.reach[2])
    }

    /// The number of rows of cells.
    pub(crate) fn rows(&self) -> usize {
        self.part.y.len() * self.part.z.len()
    }

    /// The stored number of the first cell of a row.
    pub(crate) fn row_start(&self, row: usize) -> usize {
        let height = self.part.y.len();
        self.number([0, self.part.y.start + row % height, self.part.z.start + row / height])
    }

    /// The stored number of a cell.
    pub(crate) fn number(&self, cell: [usize; 3]) -> usize {
        let origin = self.origin();
        let [x, y, z] = std::array::from_fn(|axis| cell[axis] + self.reach[axis] - origin[axis]);
        x + y * self.row + z * self.layer
    }

    /// The cell with this stored number, which is no halo cell.
    pub(crate) fn cell(&self, number: usize) -> [usize; 3] {
        let rest = number % self.layer;
        let padded = [rest % self.row, rest / self.row, number / self.layer];
        let origin = self.origin();
        std::array::from_fn(|axis| (padded[axis] + origin[axis]).saturating_sub(self.reach[axis]))
    }

    /// The distances of the neighbours in stored cells, for cells in even and in odd rows or columns.
    pub(crate) fn offsets(&self) -> Vec<i32> {
        let neighbourhood = self.geometry.neighbourhood();
        let of = |cell| neighbourhood.displacements(cell).iter();
        of([0, 0, 0])
            .chain(of([1, 1, 0]))
            .map(|[x, y, z]| x + y * self.row as i32 + z * self.layer as i32)
            .collect()
    }

    /// The displacements of the neighbours, each with the index of its opposite, for cells in even and in odd
    /// rows or columns. Where there is no opposite no process asks for it.
    pub(crate) fn directions(&self) -> Vec<[i32; 4]> {
        let neighbourhood = self.geometry.neighbourhood();
        let of = |cell| neighbourhood.displacements(cell).iter().enumerate();
        of([0, 0, 0])
            .chain(of([1, 1, 0]))
            .map(|(index, [x, y, z])| {
                let opposite = neighbourhood.opposite(index).unwrap_or(0);
                [*x, *y, *z, opposite as i32]
            })
            .collect()
    }

    /// The cells of the halo.
    pub(crate) fn halo(&self) -> Vec<HaloCell> {
        let extents = self.extents();
        let [width, height, depth] = extents.map(|extent| extent as i64);
        let [x_range, y_range, z_range] = [0, 1, 2].map(|axis| self.padded(axis));
        let mut halo = Vec::new();
        for z in z_range {
            for y in y_range.clone() {
                let is_own = (0..height).contains(&y) && (0..depth).contains(&z);
                let inner = if is_own { 0..width } else { 0..0 };
                for x in (x_range.start..inner.start).chain(inner.end..x_range.end) {
                    halo.push(HaloCell { number: self.halo_number([x, y, z]), shows: self.shown([x, y, z]) });
                }
            }
        }
        halo
    }

    /// The indices along an axis from the first own cell, with those of the halo.
    fn padded(&self, axis: usize) -> Range<i64> {
        let reach = self.reach[axis] as i64;
        -reach..self.extents()[axis] as i64 + reach
    }

    /// The stored number of a cell from its indices from the first own cell.
    fn halo_number(&self, at: [i64; 3]) -> usize {
        let [x, y, z]: [i64; 3] = std::array::from_fn(|axis| at[axis] + self.reach[axis] as i64);
        (x + y * self.row as i64 + z * self.layer as i64) as usize
    }

    /// What stands at these indices from the first own cell, by the boundary rules.
    fn shown(&self, at: [i64; 3]) -> Shown {
        let (extents, origin) = (self.extents(), self.origin());
        // From the nearest own cell the rest of the way is a displacement.
        let nearest: [usize; 3] =
            std::array::from_fn(|axis| at[axis].clamp(0, extents[axis] as i64 - 1) as usize);
        let displacement = std::array::from_fn(|axis| (at[axis] - nearest[axis] as i64) as i32);
        let nearest = std::array::from_fn(|axis| nearest[axis] + origin[axis]);
        match self.geometry.reach(nearest, displacement) {
            Reached::Cell([_, y, z]) if !(self.part.y.contains(&y) && self.part.z.contains(&z)) => {
                Shown::Elsewhere
            }
            Reached::Cell(cell) => Shown::Cell(self.number(cell)),
            Reached::Outside(face) => Shown::Outside(face),
        }
    }

    /// The stored numbers of the cells that the part beyond a face sees, and of those that are seen there, in
    /// the same order. Whole lines with their ends beyond x; those along z include what has arrived along y,
    /// so corners need no messages of their own.
    pub(crate) fn edges(&self, face: Face) -> [Vec<usize>; 2] {
        let axis = face.axis();
        let (reach, extent) = (self.reach[axis] as i64, self.extents()[axis] as i64);
        let is_low = face == Face::ALONG[axis][0];
        let own = if is_low { 0..reach } else { extent - reach..extent };
        let beyond = if is_low { -reach..0 } else { extent..extent + reach };
        let borders = self.part.borders(&self.geometry);
        [own, beyond].map(|rows| {
            let [y_range, z_range] = if axis == 2 {
                [self.padded(1), rows]
            } else {
                // Layers beyond a border arrive later, along z.
                let [below, above] =
                    Face::ALONG[2].map(|face| if borders[face] { self.reach[2] as i64 } else { 0 });
                let padded = self.padded(2);
                [rows, padded.start + below..padded.end - above]
            };
            let lines = z_range.flat_map(|z| y_range.clone().map(move |y| [y, z]));
            lines.flat_map(|[y, z]| self.padded(0).map(move |x| self.halo_number([x, y, z]))).collect()
        })
    }

    /// Whether what lies in the halo follows what lies in the space.
    pub(crate) fn halo_follows(&self) -> bool {
        let boundaries = self.geometry.boundaries();
        Face::ALL.iter().any(|face| self.reach[face.axis()] > 0 && boundaries[*face] != Boundary::Flat)
    }
}

#[cfg(test)]
mod tests;
