//! Cuts of a space into parts.

use crate::bounds;
use crate::grid::{Grid, thinnest};
use serde::{Deserialize, Serialize};
use xca_core::engine::Part;
use xca_core::{Face, Geometry};

/// A cut of a space into parts: the bounds of their rows along y and along z.
///
/// The bounds along y are the same for all parts along z. A part therefore has one other part beyond each
/// face, and the parts at its corners are reached through these.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Cut {
    y: Vec<usize>,
    z: Vec<usize>,
}

/// In the work by which bounds are chosen, a row without work counts as this part of the mean work. Such rows
/// are then shared too: they may come to work, and they take memory.
const IDLE_ROW: u64 = 64;

/// How often the bounds along one axis are chosen anew for those along the other.
const ROUNDS: usize = 3;

impl Cut {
    /// The cut that distributes the rows evenly.
    pub(crate) fn even(geometry: &Geometry, grid: Grid) -> Self {
        let [_, height, depth] = geometry.extents();
        Self { y: bounds::even(height, grid.y), z: bounds::even(depth, grid.z) }
    }

    /// The cut that distributes the work, given for each row of the space. Along one axis, the largest work
    /// of a part is the least possible. Along both axes, the bounds along each are the best for the other.
    pub(crate) fn balanced(geometry: &Geometry, grid: Grid, work: &[u64]) -> Self {
        let mean = work.iter().fold(0_u64, |sum, work| sum.saturating_add(*work)) / work.len().max(1) as u64;
        let with_idle: Vec<u64> =
            work.iter().map(|work| work.saturating_mul(IDLE_ROW).saturating_add(mean.max(1))).collect();
        let work = Matrix { rows: &with_idle, height: geometry.extents()[1] };
        let mut best = Self::even(geometry, grid);
        for _ in 0..ROUNDS {
            let mut next = best.clone();
            if grid.y > 1 {
                next.y = bounds::balanced(&work.along_y(&next.z), grid.y, thinnest(geometry, 1));
            }
            if grid.z > 1 {
                next.z = bounds::balanced(&work.along_z(&next.y), grid.z, thinnest(geometry, 2));
            }
            let largest = |cut: &Self| cut.work_of_parts(geometry, &with_idle).into_iter().max();
            if largest(&next) >= largest(&best) {
                break;
            }
            best = next;
        }
        best
    }

    /// The numbers of parts.
    pub(crate) fn grid(&self) -> Grid {
        Grid { y: self.y.len() - 1, z: self.z.len() - 1 }
    }

    /// The number of parts.
    pub(crate) fn count(&self) -> usize {
        self.grid().count()
    }

    /// The part with this number.
    pub(crate) fn part(&self, number: usize) -> Part {
        let (y, z) = (number % self.grid().y, number / self.grid().y);
        Part { y: self.y[y]..self.y[y + 1], z: self.z[z]..self.z[z + 1] }
    }

    /// The number of the part that contains the row with these indices y and z.
    pub(crate) fn part_of(&self, [y, z]: [usize; 2]) -> usize {
        let part = |bounds: &[usize], row: usize| bounds[1..].partition_point(|end| *end <= row);
        part(&self.z, z) * self.grid().y + part(&self.y, y)
    }

    /// The number of the part beyond a face of the part with this number, with wrapping around the space.
    pub(crate) fn beyond(&self, number: usize, face: Face) -> usize {
        let next = |at: usize, count: usize, axis: usize| {
            let [low, high] = Face::ALONG[axis];
            match face {
                face if face == low => (at + count - 1) % count,
                face if face == high => (at + 1) % count,
                _ => at,
            }
        };
        let Grid { y, z } = self.grid();
        next(number / y, z, 2) * y + next(number % y, y, 1)
    }

    /// The work of each part, from that of each row of the space.
    pub(crate) fn work_of_parts(&self, geometry: &Geometry, work: &[u64]) -> Vec<u64> {
        let sum = |number: usize| {
            let rows = self.part(number).runs(geometry).flatten();
            rows.fold(0_u64, |sum, row| sum.saturating_add(work.get(row).copied().unwrap_or(0)))
        };
        (0..self.count()).map(sum).collect()
    }
}

/// The work of each row of the space.
struct Matrix<'a> {
    rows: &'a [u64],
    /// The number of rows along y.
    height: usize,
}

impl Matrix<'_> {
    /// For each part along z, the work of each row along y.
    fn along_y(&self, bounds: &[usize]) -> Vec<Vec<u64>> {
        let column = |part: &[usize]| {
            let mut column = vec![0_u64; self.height];
            for layer in self.rows.chunks(self.height.max(1)).take(part[1]).skip(part[0]) {
                column.iter_mut().zip(layer).for_each(|(sum, work)| *sum = sum.saturating_add(*work));
            }
            column
        };
        bounds.windows(2).map(column).collect()
    }

    /// For each part along y, the work of each row along z.
    fn along_z(&self, bounds: &[usize]) -> Vec<Vec<u64>> {
        let column = |part: &[usize]| {
            let layers = self.rows.chunks(self.height.max(1));
            let sum = |layer: &[u64]| {
                let rows = layer.get(part[0]..part[1]).unwrap_or_default();
                rows.iter().fold(0_u64, |sum, work| sum.saturating_add(*work))
            };
            layers.map(sum).collect()
        };
        bounds.windows(2).map(column).collect()
    }
}

#[cfg(test)]
mod tests;
