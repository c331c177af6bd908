//! Where cells lie in memory: rows along x, with a halo around the space.

use xca_core::{Boundary, Geometry, Parity};

/// The padded space.
#[derive(Debug, Clone)]
pub(crate) struct Layout {
    extents: [usize; 3],
    reach: [usize; 3],
    padded: [usize; 3],
    boundaries: [Boundary; 3],
}

impl Layout {
    pub(crate) fn new(geometry: &Geometry) -> Self {
        let (extents, reach) = (geometry.extents(), geometry.neighbourhood().reach());
        let padded = std::array::from_fn(|axis| extents[axis] + 2 * reach[axis]);
        Self { extents, reach, padded, boundaries: geometry.boundaries() }
    }

    /// The number of padded cells, unless that overflows.
    pub(crate) fn checked_cells(&self) -> Option<usize> {
        self.padded.iter().try_fold(1_usize, |cells, &extent| cells.checked_mul(extent))
    }

    /// The number of padded cells.
    pub(crate) fn cells(&self) -> usize {
        self.padded.iter().product()
    }

    /// The offsets from a cell to the next one along y and along z.
    pub(crate) fn steps(&self) -> [isize; 2] {
        [self.padded[0] as isize, (self.padded[0] * self.padded[1]) as isize]
    }

    /// The number of rows of the space.
    pub(crate) fn rows(&self) -> usize {
        self.extents[1] * self.extents[2]
    }

    /// The number of cells in a row.
    pub(crate) fn width(&self) -> usize {
        self.extents[0]
    }

    /// The indices y and z of a row.
    pub(crate) fn row(&self, row: usize) -> [usize; 2] {
        [row % self.extents[1], row / self.extents[1]]
    }

    /// The padded number of a row's first cell.
    pub(crate) fn first(&self, row: usize) -> usize {
        let [y, z] = self.row(row);
        self.first_at(y, z)
    }

    /// The padded number of the first cell of the row with these indices.
    pub(crate) fn first_at(&self, y: usize, z: usize) -> usize {
        ((z + self.reach[2]) * self.padded[1] + y + self.reach[1]) * self.padded[0] + self.reach[0]
    }

    /// The padded number of the cell with this linear index.
    pub(crate) fn padded(&self, cell: usize) -> usize {
        self.first(cell / self.extents[0]) + cell % self.extents[0]
    }

    /// The offsets of the neighbours for cells in even and odd rows or columns.
    pub(crate) fn offsets(&self, geometry: &Geometry) -> [Vec<isize>; 2] {
        let odd = match geometry.neighbourhood().parity() {
            Parity::None => [0, 0, 0],
            Parity::Row => [0, 1, 0],
            Parity::Column => [1, 0, 0],
        };
        [[0, 0, 0], odd].map(|cell| {
            let displacements = geometry.neighbourhood().displacements(cell);
            let line = self.padded[0] as isize;
            let layer = line * self.padded[1] as isize;
            displacements
                .iter()
                .map(|[x, y, z]| *z as isize * layer + *y as isize * line + *x as isize)
                .collect()
        })
    }

    /// Whether what lies in the halo follows what lies in the space.
    pub(crate) fn halo_follows(&self) -> bool {
        (0..3).any(|axis| self.reach[axis] > 0 && self.boundaries[axis] != Boundary::Flat)
    }

    /// Fills the halo: each halo cell is told by the number of its source, or by nothing where it lies beyond a flat face.
    /// Runs of cells along x come in one call: `fill(target, source, count)`.
    pub(crate) fn fill_halo(&self, mut fill: impl FnMut(usize, Option<usize>, usize)) {
        let [line, layer] = [self.padded[0], self.padded[0] * self.padded[1]];
        // Along x, for the rows of the space; then whole rows along y; then whole layers along z.
        for row in 0..self.rows() {
            let first = self.first(row);
            for (target, source) in self.along(0) {
                let start = first - self.reach[0];
                fill(start + target, source.map(|source| start + source), 1);
            }
        }
        for z in self.reach[2]..self.reach[2] + self.extents[2] {
            for (target, source) in self.along(1) {
                fill(z * layer + target * line, source.map(|source| z * layer + source * line), line);
            }
        }
        for (target, source) in self.along(2) {
            fill(target * layer, source.map(|source| source * layer), layer);
        }
    }

    /// The padded indices of the halo along an axis, each with that of its source.
    fn along(&self, axis: usize) -> impl Iterator<Item = (usize, Option<usize>)> {
        let (reach, extent, boundary) = (self.reach[axis], self.extents[axis], self.boundaries[axis]);
        (0..reach).chain(reach + extent..2 * reach + extent).map(move |target| {
            let source = match boundary {
                Boundary::Flat => None,
                Boundary::Toroidal => Some(if target < reach { target + extent } else { target - extent }),
                Boundary::Reflecting if target < reach => Some(2 * reach - 1 - target),
                Boundary::Reflecting => Some(2 * (reach + extent) - 1 - target),
            };
            (target, source)
        })
    }
}
