//! The domain's faces, the laws by which they act as walls, and openings in them.

use crate::configuration::Configuration;
use crate::error::CademError;
use crate::substates::{BOUNDARY, Dem, FIRST_BOUNDARY_LABEL};
use serde::{Deserialize, Serialize};
use std::cmp::Reverse;
use std::collections::HashMap;
use std::fmt;
use xca_core::{Boundary, Item, Vector3};

/// How BOUNDARY slots act on particles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Walls {
    /// The wall is the domain face, and acts once: through the BOUNDARY slots of the particle's own cell.
    #[default]
    Single,
    /// The law of the authors' program. The wall stands one radius inside the domain, and every BOUNDARY slot among the 27 cells of the
    /// toroidal neighbourhood acts: nine pieces of each wall, so that k_n and eta are ninefold.
    PerSlot,
}

impl Walls {
    /// All laws.
    pub const ALL: [Self; 2] = [Self::Single, Self::PerSlot];

    /// The name, as in a configuration.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Single => "single",
            Self::PerSlot => "per-slot",
        }
    }

    /// How far inside the domain the walls stand, in m.
    pub fn inset(self, radius: f64) -> f64 {
        match self {
            Self::Single => 0.0,
            Self::PerSlot => radius,
        }
    }

    /// The boundary of the cellular space that the law needs.
    pub(crate) const fn boundary(self) -> Boundary {
        match self {
            Self::Single => Boundary::Flat,
            Self::PerSlot => Boundary::Toroidal,
        }
    }
}

impl fmt::Display for Walls {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A face of the domain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Face {
    /// x = 0.
    XLow,
    /// The largest x.
    XHigh,
    /// y = 0.
    YLow,
    /// The largest y.
    YHigh,
    /// z = 0: the floor.
    ZLow,
    /// The largest z: the lid.
    ZHigh,
}

impl Face {
    /// All faces, by number.
    pub const ALL: [Self; 6] = [Self::XLow, Self::XHigh, Self::YLow, Self::YHigh, Self::ZLow, Self::ZHigh];

    /// The number in the substate [`Dem::face`].
    pub const fn number(self) -> u8 {
        self as u8
    }

    /// The axis across the face: 0, 1 or 2 for x, y, z.
    pub const fn axis(self) -> usize {
        self as usize / 2
    }

    /// Whether it is the face at the larger coordinate.
    pub const fn is_high(self) -> bool {
        self as usize % 2 == 1
    }

    /// The two axes along the face, in ascending order.
    pub const fn along(self) -> [usize; 2] {
        match self.axis() {
            0 => [1, 2],
            1 => [0, 2],
            _ => [0, 1],
        }
    }

    /// The name, as in a configuration.
    pub const fn name(self) -> &'static str {
        match self {
            Self::XLow => "x-low",
            Self::XHigh => "x-high",
            Self::YLow => "y-low",
            Self::YHigh => "y-high",
            Self::ZLow => "z-low",
            Self::ZHigh => "z-high",
        }
    }
}

impl fmt::Display for Face {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A hole in a wall: a face, or a rectangle of its cells, without BOUNDARY slots. Particles that pass it leave the domain and are
/// counted. Under [`Walls::PerSlot`] the pieces of wall around a hole reach one cell into it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Opening {
    /// The face.
    pub face: Face,
    /// The cells; the whole face unless they are given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cells: Option<Rectangle>,
}

impl Opening {
    /// All six faces: no walls at all.
    pub fn all_faces() -> Vec<Self> {
        Face::ALL.map(Self::whole).to_vec()
    }

    /// A whole face.
    pub const fn whole(face: Face) -> Self {
        Self { face, cells: None }
    }
}

/// A rectangle of the cells of a face, by their indices along the two axes of the face in ascending order (on the floor: x, y).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rectangle {
    /// The smallest indices.
    pub first: [usize; 2],
    /// The largest indices; these cells belong to the rectangle too.
    pub last: [usize; 2],
}

impl Rectangle {
    fn contains(&self, cell: [usize; 2]) -> bool {
        (0..2).all(|axis| (self.first[axis]..=self.last[axis]).contains(&cell[axis]))
    }
}

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

    /// The largest number of domain faces that a cell touches: 3 where there are two cells or more along each axis.
    pub(crate) fn most_faces_of_a_cell(&self) -> usize {
        self.cells.iter().map(|&extent| if extent == 1 { 2 } else { 1 }).sum()
    }

    /// The BOUNDARY slots: one for each domain face that an outermost cell touches, except in openings. The point that a slot carries is the
    /// centre of its cell, moved onto the wall.
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
