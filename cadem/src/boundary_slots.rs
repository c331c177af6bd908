//! The BOUNDARY slots of a system: one for each face that an outermost cell touches.

use crate::configuration::Configuration;
use crate::error::CademError;
use crate::face::Face;
use crate::substates::{BOUNDARY, Dem, FIRST_BOUNDARY_LABEL};
use crate::walls::{Opening, Rectangle};
use std::cmp::Reverse;
use std::collections::HashMap;
use xca_core::{Item, Vector3};

impl Configuration {
    /// Checks that openings lie within their faces.
    pub(crate) fn check_openings(&self) -> Result<(), CademError> {
        for opening in &self.openings {
            let Some(Rectangle { first, last }) = opening.cells else { continue };
            let extents = opening.face.along().map(|axis| self.cells[axis]);
            if (0..2).any(|axis| first[axis] > last[axis] || last[axis] >= extents[axis]) {
                return Err(CademError::Opening { face: opening.face, first, last, extents });
            }
        }
        Ok(())
    }

    /// Checks that there are enough labels for the BOUNDARY slots, and enough slots in each cell.
    pub(crate) fn check_boundary_slots(&self) -> Result<(), CademError> {
        let area = |face: Face| {
            face.along().iter().fold(1_u64, |n, &axis| n.saturating_mul(self.cells[axis] as u64))
        };
        let wanted = Face::ALL.into_iter().fold(0_u64, |n, face| n.saturating_add(area(face)));
        let limit = u64::from(u32::MAX - FIRST_BOUNDARY_LABEL);
        if wanted > limit {
            return Err(CademError::ManyBoundarySlots { cells: self.cells, wanted, limit });
        }
        let slots = self.slots();
        if slots >= self.most_faces_of_a_cell() {
            return Ok(());
        }
        let mut counts: HashMap<[usize; 3], usize> = HashMap::new();
        for item in self.boundary_slots() {
            *counts.entry(item.cell).or_default() += 1;
        }
        // The fullest cell, the first one of several.
        match counts.into_iter().max_by_key(|(cell, count)| (*count, Reverse(*cell))) {
            Some((cell, faces)) if faces > slots => Err(CademError::FewSlots { slots, cell, faces }),
            _ => Ok(()),
        }
    }

    /// Where the wall on this face stands along the face's axis, in m, whether or not it has openings.
    pub fn wall(&self, face: Face) -> f64 {
        let inset = self.walls.inset(self.radius);
        if face.is_high() { self.sides()[face.axis()] - inset } else { inset }
    }

    /// The largest number of domain faces that a cell touches: 3 where there are two cells or more along each
    /// axis.
    pub(crate) fn most_faces_of_a_cell(&self) -> usize {
        self.cells.iter().map(|&extent| if extent == 1 { 2 } else { 1 }).sum()
    }

    /// The BOUNDARY slots: one for each domain face that an outermost cell touches, except in openings. The
    /// point that a slot carries is the centre of its cell, moved onto the wall.
    pub(crate) fn boundary_slots(&self) -> impl Iterator<Item = Item<Dem>> + '_ {
        let cells =
            Face::ALL.into_iter().flat_map(|face| self.closed_cells(face).map(move |cell| (face, cell)));
        cells.zip(FIRST_BOUNDARY_LABEL..).map(|((face, cell), label)| {
            let mut point = cell.map(|index| (index as f64 + 0.5) * self.cell_side);
            point[face.axis()] = self.wall(face);
            let zero = Vector3::splat(0.0);
            let [x, y, z] = point;
            let state = Dem {
                id: BOUNDARY,
                face: face.number(),
                position: Vector3::new(x, y, z),
                velocity: zero,
                force: zero,
            };
            Item { label, cell, state }
        })
    }

    /// The cells that have a BOUNDARY slot of this face.
    fn closed_cells(&self, face: Face) -> impl Iterator<Item = [usize; 3]> + '_ {
        let [along, across] = face.along();
        let at = if face.is_high() { self.cells[face.axis()].saturating_sub(1) } else { 0 };
        let openings: Vec<Opening> =
            self.openings.iter().filter(|opening| opening.face == face).copied().collect();
        (0..self.cells[across])
            .flat_map(move |j| (0..self.cells[along]).map(move |i| [i, j]))
            .filter(move |cell| {
                !openings.iter().any(|opening| opening.cells.is_none_or(|cells| cells.contains(*cell)))
            })
            .map(move |[i, j]| {
                let mut cell = [at; 3];
                cell[along] = i;
                cell[across] = j;
                cell
            })
    }
}

#[cfg(test)]
mod tests;
