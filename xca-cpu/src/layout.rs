//! The layout of cells in memory: rows along x, with a halo around the space or around a part of it.

mod lag;

use rayon::prelude::*;
use std::ops::Range;
use xca_core::engine::Part;
use xca_core::{Boundary, Face, Faces, Geometry, Parity};

/// The least number of bytes of a halo that is worth the start of a thread.
const BYTES_WORTH_A_START: usize = 1 << 15;

/// The padded space, or a padded part of it. Its rows are numbered from 0.
#[derive(Debug, Clone)]
pub(crate) struct Layout {
    extents: [usize; 3],
    /// The indices y and z of the first row in the whole space.
    start: [usize; 2],
    /// The number of rows of the whole space along y.
    height: usize,
    reach: [usize; 3],
    padded: [usize; 3],
    /// The number of cells before the first line. It aligns the first cell of each row.
    lead: usize,
    /// The sizes of planes and lines, and the cells before a row, are multiples of this.
    alignment: usize,
    boundaries: Faces<Boundary>,
    /// The faces at which other parts fill the halo.
    borders: Faces<bool>,
}

/// The source of a halo cell along an axis.
enum Source {
    /// A cell of another part.
    Part,
    /// The cell with this padded index.
    Cell(usize),
    /// The outside value of a flat face.
    Outside(Face),
}

impl Layout {
    pub(crate) fn new(geometry: &Geometry) -> Self {
        Self::of_part(geometry, &Part::whole(geometry))
    }

    pub(crate) fn of_part(geometry: &Geometry, part: &Part) -> Self {
        let (extents, reach) = (part.extents(geometry), geometry.neighbourhood().reach());
        let alignment = alignment(extents[0]);
        let mut padded: [usize; 3] = std::array::from_fn(|axis| extents[axis] + 2 * reach[axis]);
        padded[0] = padded[0].next_multiple_of(alignment);
        Self {
            extents,
            start: [part.y.start, part.z.start],
            height: geometry.extents()[1],
            reach,
            padded,
            lead: reach[0].next_multiple_of(alignment) - reach[0],
            alignment,
            boundaries: geometry.boundaries(),
            borders: part.borders(geometry),
        }
    }

    /// The faces at which other parts fill the halo.
    pub(crate) fn borders(&self) -> Faces<bool> {
        self.borders
    }

    /// The number of padded cells. `None` if it overflows.
    pub(crate) fn checked_cells(&self) -> Option<usize> {
        let lines = self.padded.iter().try_fold(1_usize, |cells, &extent| cells.checked_mul(extent))?;
        lines.checked_add(self.lead)?.checked_next_multiple_of(self.alignment)
    }

    /// The number of padded cells.
    pub(crate) fn cells(&self) -> usize {
        (self.lead + self.padded.iter().product::<usize>()).next_multiple_of(self.alignment)
    }

    /// The offsets from a cell to the next one along y and along z.
    pub(crate) fn steps(&self) -> [isize; 2] {
        [self.padded[0] as isize, (self.padded[0] * self.padded[1]) as isize]
    }

    /// The reach of the neighbourhood along x, y, z.
    pub(crate) fn reach(&self) -> [usize; 3] {
        self.reach
    }

    /// The number of rows of the space.
    pub(crate) fn rows(&self) -> usize {
        self.extents[1] * self.extents[2]
    }

    /// The number of cells in a row.
    pub(crate) fn width(&self) -> usize {
        self.extents[0]
    }

    /// The indices y and z of a row in the part.
    pub(crate) fn row(&self, row: usize) -> [usize; 2] {
        [row % self.extents[1], row / self.extents[1]]
    }

    /// The indices in the whole space of the first cell of a row.
    pub(crate) fn origin(&self, row: usize) -> [usize; 3] {
        let [y, z] = self.row(row);
        [0, self.start[0] + y, self.start[1] + z]
    }

    /// The linear index in the whole space of the first cell of a row.
    pub(crate) fn linear(&self, row: usize) -> usize {
        let [x, y, z] = self.origin(row);
        (z * self.height + y) * self.extents[0] + x
    }

    /// The rows that lie in this range of rows of the whole space.
    pub(crate) fn rows_within(&self, rows: Range<usize>) -> impl Iterator<Item = usize> + Clone + use<> {
        let ([_, height, depth], [y, z], whole) = (self.extents, self.start, self.height);
        (0..depth).flat_map(move |layer| {
            let first = (z + layer) * whole + y;
            let own = |row: usize| layer * height + row.clamp(first, first + height) - first;
            own(rows.start)..own(rows.end)
        })
    }

    /// The row of the cell with this linear index in the whole space.
    pub(crate) fn row_of(&self, cell: usize) -> usize {
        let row = cell / self.extents[0];
        let (y, z) = (row % self.height - self.start[0], row / self.height - self.start[1]);
        z * self.extents[1] + y
    }

    /// The rows from which an item can enter a row by moving to the next cell. These are the row itself, and
    /// the rows beside it along y and z, including those across a toroidal face.
    pub(crate) fn rows_beside(&self, row: usize) -> impl Iterator<Item = usize> {
        let [_, height, depth] = self.extents;
        let [y, z] = self.row(row);
        let beside =
            |index: usize, extent: usize| [(index + extent - 1) % extent, index, (index + 1) % extent];
        let layers = beside(z, depth);
        layers.into_iter().flat_map(move |z| beside(y, height).map(|y| z * height + y))
    }

    /// The rows that see a row: the row itself, and all rows within reach along y and z, including those
    /// across toroidal faces. A row may be listed twice.
    pub(crate) fn rows_around(&self, row: usize) -> impl Iterator<Item = usize> {
        self.rows_that_see(self.row(row).map(|index| index as isize))
    }

    /// The rows that see the row with these indices y and z in the part or in its halo. A row may be listed
    /// twice.
    pub(crate) fn rows_that_see(&self, [y, z]: [isize; 2]) -> impl Iterator<Item = usize> {
        let height = self.extents[1];
        let along = move |axis: usize, index: isize| {
            let (reach, extent) = (self.reach[axis] as isize, self.extents[axis] as isize);
            let [low, _] = Face::ALONG[axis];
            let is_ring = self.boundaries[low] == Boundary::Toroidal && !self.borders[low];
            (-reach..=reach).filter_map(move |step| {
                let place = index + step;
                match (0..extent).contains(&place) {
                    true => Some(place as usize),
                    false => is_ring.then(|| place.rem_euclid(extent) as usize),
                }
            })
        };
        along(2, z).flat_map(move |z| along(1, y).map(move |y| z * height + y))
    }

    /// The indices y and z in the part of the halo lines that repeat a row.
    pub(crate) fn images(&self, row: usize) -> impl Iterator<Item = [isize; 2]> {
        let [y, z] = self.row(row);
        let images = move |axis: usize, index: usize| {
            let reach = self.reach[axis];
            let of_index = move |(target, source): (usize, Source)| match source {
                Source::Cell(source) if source == index + reach => Some(target as isize - reach as isize),
                Source::Cell(_) | Source::Outside(_) | Source::Part => None,
            };
            std::iter::once(index as isize).chain(self.along(axis).filter_map(of_index))
        };
        images(2, z).flat_map(move |z| images(1, y).map(move |y| [y, z])).skip(1)
    }

    /// The padded index of a row's first cell.
    pub(crate) fn first(&self, row: usize) -> usize {
        let [y, z] = self.row(row);
        self.first_at(y, z)
    }

    /// The padded index of the first cell of the row with these indices.
    pub(crate) fn first_at(&self, y: usize, z: usize) -> usize {
        let line = (z + self.reach[2]) * self.padded[1] + y + self.reach[1];
        self.lead + line * self.padded[0] + self.reach[0]
    }

    /// The padded index of the cell with this linear index in the whole space.
    pub(crate) fn padded(&self, cell: usize) -> usize {
        let row = cell / self.extents[0];
        let (y, z) = (row % self.height - self.start[0], row / self.height - self.start[1]);
        self.first_at(y, z) + cell % self.extents[0]
    }

    /// The padded lines that another part sees across a face. With `beyond`, the lines of that part that are
    /// seen from here. A line is given by its indices y and z in the part. Along z, the lines include the
    /// halo along y.
    pub(crate) fn lines_at(&self, face: Face, beyond: bool) -> impl Iterator<Item = [isize; 2]> {
        let axis = face.axis();
        let (reach, extent) =
            (self.reach.map(|reach| reach as isize), self.extents.map(|extent| extent as isize));
        let is_low = face == Face::ALONG[axis][0];
        let across: Range<isize> = match (is_low, beyond) {
            (true, false) => 0..reach[axis],
            (true, true) => -reach[axis]..0,
            (false, false) => extent[axis] - reach[axis]..extent[axis],
            (false, true) => extent[axis]..extent[axis] + reach[axis],
        };
        let [y, z] =
            if axis == 1 { [across, 0..extent[2]] } else { [-reach[1]..extent[1] + reach[1], across] };
        z.flat_map(move |z| y.clone().map(move |y| [y, z]))
    }

    /// The padded cells of a line without its halo along x.
    pub(crate) fn cells_of_line(&self, line: [isize; 2]) -> Range<usize> {
        let start = self.line(line).start + self.reach[0];
        start..start + self.extents[0]
    }

    /// Fills the halo of a line along x, except beyond flat faces.
    pub(crate) fn fill_line<T: Copy>(&self, plane: &mut [T], line: [isize; 2]) {
        let cells = self.line(line);
        self.fill_along(0, &mut plane[cells], 1, None);
    }

    /// The padded cells of a line, which may be in the halo.
    pub(crate) fn line(&self, [y, z]: [isize; 2]) -> Range<usize> {
        let [y, z] = [(1, y), (2, z)].map(|(axis, index)| (index + self.reach[axis] as isize) as usize);
        let start = self.lead + (z * self.padded[1] + y) * self.padded[0];
        start..start + self.padded[0]
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

    /// Whether the halo depends on the cells of the space: along x, where it continues rows, and along y or
    /// z.
    pub(crate) fn halo_follows(&self) -> [bool; 2] {
        let follows = |face| self.boundaries[face] != Boundary::Flat || self.borders[face];
        let [x, y, z] =
            [0, 1, 2].map(|axis| self.reach[axis] > 0 && Face::ALONG[axis].into_iter().any(follows));
        [x, y || z]
    }

    /// Whether halo cells repeat cells of the part: along x, where they continue rows, and along y or z.
    pub(crate) fn halo_repeats(&self) -> [bool; 2] {
        let [x, y, z] = [0, 1, 2].map(|axis| self.fills(axis, false));
        [x, y || z]
    }

    /// The halo cells that continue a row, if they depend on the space. For each cell, its index and that of
    /// its source, counted from the row's first cell.
    pub(crate) fn continuation(&self) -> Vec<(isize, isize)> {
        let counted = |index: usize| index as isize - self.reach[0] as isize;
        let follows = |(target, source)| match source {
            Source::Cell(source) => Some((counted(target), counted(source))),
            Source::Outside(_) | Source::Part => None,
        };
        self.along(0).filter_map(follows).collect()
    }

    /// Fills the halo of a plane with `values` values per cell, by the boundary rules. Beyond flat faces it
    /// uses the outside values, if they are given. Beyond several flat faces the last axis counts, because it
    /// is filled last. Skips the halo along x if the rows are `continued` already. Skips cells that other
    /// parts fill.
    pub(crate) fn fill_halo<T: Copy + Send + Sync>(
        &self,
        plane: &mut [T],
        values: usize,
        outside: Option<&Faces<Vec<T>>>,
        continued: bool,
    ) {
        self.fill_rows(plane, values, outside, continued);
        self.fill_layers(plane, values, outside);
    }

    /// Fills the halo along x for the rows of the space, then whole rows along y.
    pub(crate) fn fill_rows<T: Copy + Send + Sync>(
        &self,
        plane: &mut [T],
        values: usize,
        outside: Option<&Faces<Vec<T>>>,
        continued: bool,
    ) {
        let continued = continued || !self.fills(0, outside.is_some());
        if continued && !self.fills(1, outside.is_some()) {
            return;
        }
        let line = self.padded[0] * values;
        let layer = line * self.padded[1];
        let space = &mut self.lines(plane, values)[self.reach[2] * layer..][..self.extents[2] * layer];
        let across = if continued { 0 } else { self.extents[1] * 2 * self.reach[0] * values };
        let work = across + 2 * self.reach[1] * line;
        space.par_chunks_mut(layer).with_min_len(worth::<T>(work)).for_each(|layer| {
            if !continued {
                for row in layer.chunks_exact_mut(line).skip(self.reach[1]).take(self.extents[1]) {
                    self.fill_along(0, row, values, outside);
                }
            }
            self.fill_along(1, layer, line, outside);
        });
    }

    /// Fills the halo along z with whole layers, including their halo along x and y.
    pub(crate) fn fill_layers<T: Copy + Send + Sync>(
        &self,
        plane: &mut [T],
        values: usize,
        outside: Option<&Faces<Vec<T>>>,
    ) {
        if !self.fills(2, outside.is_some()) {
            return;
        }
        let layer = self.padded[0] * values * self.padded[1];
        let (below, rest) = self.lines(plane, values).split_at_mut(self.reach[2] * layer);
        let (space, above) = rest.split_at_mut(self.extents[2] * layer);
        let space = &*space;
        let layers = below.par_chunks_mut(layer).chain(above.par_chunks_mut(layer));
        let places: Vec<_> = self.along(2).collect();
        layers.zip(places).with_min_len(worth::<T>(layer)).for_each(|(target, (_, source))| match source {
            Source::Cell(source) => {
                target.copy_from_slice(&space[(source - self.reach[2]) * layer..][..layer]);
            }
            Source::Outside(face) => fill_outside(target, outside.map(|outside| &*outside[face])),
            Source::Part => {}
        });
    }

    /// The lines of a plane with `values` values per cell, without the cells for alignment.
    fn lines<'a, T>(&self, plane: &'a mut [T], values: usize) -> &'a mut [T] {
        &mut plane[self.lead * values..][..self.padded.iter().product::<usize>() * values]
    }

    /// Fills the halo along an axis. `line` is one padded line of pieces of length `piece`.
    fn fill_along<T: Copy>(
        &self,
        axis: usize,
        line: &mut [T],
        piece: usize,
        outside: Option<&Faces<Vec<T>>>,
    ) {
        for (target, source) in self.along(axis) {
            match source {
                Source::Cell(source) => {
                    line.copy_within(source * piece..(source + 1) * piece, target * piece);
                }
                Source::Outside(face) => {
                    let outside = outside.map(|outside| &*outside[face]);
                    fill_outside(&mut line[target * piece..(target + 1) * piece], outside);
                }
                Source::Part => {}
            }
        }
    }

    /// Whether halo cells along an axis are filled here, with or without outside values.
    fn fills(&self, axis: usize, outside: bool) -> bool {
        self.along(axis).any(|(_, source)| match source {
            Source::Cell(_) => true,
            Source::Outside(_) => outside,
            Source::Part => false,
        })
    }

    /// The padded indices of the halo along an axis, each with its source.
    fn along(&self, axis: usize) -> impl Iterator<Item = (usize, Source)> {
        let (reach, extent) = (self.reach[axis], self.extents[axis]);
        (0..reach).chain(reach + extent..2 * reach + extent).map(move |target| {
            let is_low = target < reach;
            let face = Face::ALONG[axis][usize::from(!is_low)];
            let source = match self.boundaries[face] {
                _ if self.borders[face] => Source::Part,
                Boundary::Flat => Source::Outside(face),
                Boundary::Toroidal => Source::Cell(if is_low { target + extent } else { target - extent }),
                Boundary::Reflecting if is_low => Source::Cell(2 * reach - 1 - target),
                Boundary::Reflecting => Source::Cell(2 * (reach + extent) - 1 - target),
            };
            (target, source)
        })
    }
}

/// The alignment of rows in cells, a power of two. Eight numbers of 64 bits fill a register or a cache line.
/// Long rows can have a larger alignment. In short rows it would waste much memory.
fn alignment(width: usize) -> usize {
    let cells = (width / 16).clamp(1, 8).max(width / 64).min(64);
    1 << cells.ilog2()
}

/// The number of pieces with this work that are worth the start of a thread.
fn worth<T>(work: usize) -> usize {
    (BYTES_WORTH_A_START / (work * size_of::<T>()).max(1)).max(1)
}

fn fill_outside<T: Copy>(cells: &mut [T], outside: Option<&[T]>) {
    if let Some(outside) = outside {
        for value in cells.chunks_exact_mut(outside.len()) {
            value.copy_from_slice(outside);
        }
    }
}

#[cfg(test)]
mod tests;
