//! Where cells lie in the device's memory: rows along x with a halo around the space, cut into parts that a
//! process can reach at once.

use xca_core::{Boundary, Face, Geometry, Reached};

/// Where the stored cells of a part begin is a multiple of this, so that each substate of theirs begins where
/// a binding may.
const ALIGNMENT: usize = 64;

/// The stored space.
#[derive(Debug, Clone)]
pub(crate) struct Space {
    geometry: Geometry,
    reach: [usize; 3],
    /// The stored cells from one row to the next, and from one layer to the next.
    row: usize,
    layer: usize,
    parts: Vec<Part>,
}

/// Cells that are worked on together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Part {
    /// The indices of the first.
    pub(crate) first: [usize; 3],
    /// How many along each axis.
    pub(crate) count: [usize; 3],
    /// The stored cells that they and their neighbours lie in.
    pub(crate) base: usize,
    /// How many these are.
    pub(crate) stored: usize,
}

impl Part {
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
    /// The cell of the space with this stored number.
    Cell(usize),
    /// What lies beyond a flat face.
    Outside(Face),
}

/// A space that cannot be cut so that its parts can be reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct TooLarge {
    /// The stored cells that would have to be reached at once.
    pub(crate) wanted: u128,
}

impl Space {
    /// Lays the cells out; at most so many stored cells can be reached at once.
    pub(crate) fn new(geometry: &Geometry, reachable: u64) -> Result<Self, TooLarge> {
        let (extents, reach) = (geometry.extents(), geometry.neighbourhood().reach());
        let padded: [usize; 3] = std::array::from_fn(|axis| extents[axis] + 2 * reach[axis]);
        let product = |row: usize, layers: usize| row as u128 * padded[1] as u128 * layers as u128;
        // Cells are numbered in 32 bits, and their distances with a sign.
        let all = product(padded[0].next_multiple_of(ALIGNMENT), padded[2]) + (padded[2] * ALIGNMENT) as u128;
        if all > i32::MAX as u128 {
            return Err(TooLarge { wanted: all });
        }
        let mut space = Self {
            geometry: geometry.clone(),
            reach,
            row: padded[0],
            layer: padded[0] * padded[1],
            parts: Vec::new(),
        };
        if product(padded[0], padded[2]) <= u128::from(reachable) {
            space.parts = vec![Part { first: [0; 3], count: extents, base: 0, stored: space.stored() }];
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
        space.parts = (0..extents[axis])
            .step_by(most - around)
            .map(|start| {
                let (mut first, mut count) = ([0; 3], extents);
                first[axis] = start;
                count[axis] = (most - around).min(extents[axis] - start);
                Part { first, count, base: start * step, stored: (count[axis] + around) * step }
            })
            .collect();
        Ok(space)
    }

    pub(crate) fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    pub(crate) fn reach(&self) -> [usize; 3] {
        self.reach
    }

    /// The parts, in the order of cells.
    pub(crate) fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// The part that a cell lies in.
    pub(crate) fn part_of(&self, cell: [usize; 3]) -> Option<&Part> {
        self.parts.iter().find(|part| (0..3).all(|axis| cell[axis] < part.first[axis] + part.count[axis]))
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
        self.layer * (self.geometry.extents()[2] + 2 * self.reach[2])
    }

    /// The number of rows of the space.
    pub(crate) fn rows(&self) -> usize {
        self.geometry.extents()[1] * self.geometry.extents()[2]
    }

    /// The stored number of the first cell of a row.
    pub(crate) fn row_start(&self, row: usize) -> usize {
        let height = self.geometry.extents()[1];
        self.number([0, row % height, row / height])
    }

    /// The stored number of a cell.
    pub(crate) fn number(&self, [x, y, z]: [usize; 3]) -> usize {
        x + self.reach[0] + (y + self.reach[1]) * self.row + (z + self.reach[2]) * self.layer
    }

    /// The cell with this stored number, which is no halo cell.
    pub(crate) fn cell(&self, number: usize) -> [usize; 3] {
        let rest = number % self.layer;
        let padded = [rest % self.row, rest / self.row, number / self.layer];
        std::array::from_fn(|axis| padded[axis].saturating_sub(self.reach[axis]))
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
        let extents = self.geometry.extents();
        let range = |axis: usize| -(self.reach[axis] as i64)..(extents[axis] + self.reach[axis]) as i64;
        let [width, height, depth] = extents.map(|extent| extent as i64);
        let mut halo = Vec::new();
        for z in range(2) {
            for y in range(1) {
                let of_space = (0..height).contains(&y) && (0..depth).contains(&z);
                let inner = if of_space { 0..width } else { 0..0 };
                for x in (range(0).start..inner.start).chain(inner.end..range(0).end) {
                    halo.push(HaloCell { number: self.halo_number([x, y, z]), shows: self.shown([x, y, z]) });
                }
            }
        }
        halo
    }

    fn halo_number(&self, at: [i64; 3]) -> usize {
        let [x, y, z]: [i64; 3] = std::array::from_fn(|axis| at[axis] + self.reach[axis] as i64);
        (x + y * self.row as i64 + z * self.layer as i64) as usize
    }

    /// What stands at these indices by the boundary rules.
    fn shown(&self, at: [i64; 3]) -> Shown {
        let extents = self.geometry.extents();
        // From the nearest cell of the space the rest of the way is a displacement.
        let nearest: [usize; 3] =
            std::array::from_fn(|axis| at[axis].clamp(0, extents[axis] as i64 - 1) as usize);
        let displacement = std::array::from_fn(|axis| (at[axis] - nearest[axis] as i64) as i32);
        match self.geometry.reach(nearest, displacement) {
            Reached::Cell(cell) => Shown::Cell(self.number(cell)),
            Reached::Outside(face) => Shown::Outside(face),
        }
    }

    /// Whether what lies in the halo follows what lies in the space.
    pub(crate) fn halo_follows(&self) -> bool {
        let boundaries = self.geometry.boundaries();
        Face::ALL.iter().any(|face| self.reach[face.axis()] > 0 && boundaries[*face] != Boundary::Flat)
    }
}

#[cfg(test)]
mod tests {
    use super::{ALIGNMENT, Geometry, Space, TooLarge};
    use xca_core::{Boundary, Model, Neighbourhood, Substates};

    #[derive(Substates, Clone, Copy)]
    struct Grey {
        level: u8,
    }

    fn geometry(extents: [usize; 3], neighbourhood: Neighbourhood) -> Geometry {
        let model = Model::builder("grey")
            .extents(extents)
            .neighbourhood(neighbourhood)
            .boundary(Boundary::Toroidal)
            .substates::<Grey>()
            .build();
        model.unwrap().geometry().clone()
    }

    #[test]
    fn what_fits_is_one_part() {
        let space = Space::new(&geometry([5, 4, 3], Neighbourhood::moore(1)), 7 * 6 * 5).unwrap();
        assert_eq!(space.parts().len(), 1);
        assert_eq!((space.row(), space.layer(), space.stored()), (7, 42, 210));
    }

    /// Each cell lies in one part, with all its neighbours in what is stored of the part.
    #[test]
    fn parts_hold_their_cells_with_their_neighbours() {
        for (extents, neighbourhood, reachable) in [
            ([5, 4, 9], Neighbourhood::moore(1), 300),
            ([5, 5, 9], Neighbourhood::von_neumann(2), 800),
            ([70, 30, 1], Neighbourhood::moore_2d(1), 600),
        ] {
            let geometry = geometry(extents, neighbourhood);
            let space = Space::new(&geometry, reachable).unwrap();
            assert!(space.parts().len() > 1);
            let mut seen = 0;
            for linear in 0..geometry.cells() {
                let cell = geometry.indices(linear);
                let part = space.part_of(cell).unwrap();
                assert!((0..3).all(|axis| cell[axis] >= part.first[axis]));
                seen += 1;
                let number = space.number(cell);
                assert_eq!(space.cell(number), cell);
                for offset in space.offsets() {
                    let there = (number as i64 + i64::from(offset)) as usize;
                    assert!((part.base..part.base + part.stored).contains(&there));
                }
            }
            assert_eq!(
                seen,
                space.parts().iter().map(|part| part.count.iter().product::<usize>()).sum::<usize>()
            );
            for part in space.parts() {
                assert!(part.stored as u64 <= reachable && part.base + part.stored <= space.stored());
                assert_eq!(part.base % ALIGNMENT, 0);
            }
        }
    }

    #[test]
    fn what_cannot_be_cut_is_refused() {
        let geometry = geometry([50, 40, 9], Neighbourhood::moore(1));
        assert_eq!(Space::new(&geometry, 2000).unwrap_err(), TooLarge { wanted: 3 * 2240 });
    }
}
