//! The domain's faces, the laws by which they act as walls, and openings in them.

use crate::face::Face;
use serde::{Deserialize, Serialize};
use std::fmt;
use xca_core::Boundary;

/// How BOUNDARY slots act on particles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Walls {
    /// The wall is the domain face, and acts once: through the BOUNDARY slots of the particle's own cell.
    #[default]
    Single,
    /// The law of the authors' program. The wall stands one radius inside the domain, and every BOUNDARY slot
    /// among the 27 cells of the toroidal neighbourhood acts: nine pieces of each wall, so that k_n and eta
    /// are ninefold.
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

    /// How many pieces of a wall act on a particle that touches it.
    pub const fn pieces(self) -> u32 {
        match self {
            Self::Single => 1,
            Self::PerSlot => 9,
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

/// A hole in a wall: a face, or a rectangle of its cells, without BOUNDARY slots. Particles that pass it
/// leave the domain and are counted. Under [`Walls::PerSlot`] the pieces of wall around a hole reach one cell
/// into it.
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

/// A rectangle of the cells of a face, by their indices along the two axes of the face in ascending order (on
/// the floor: x, y).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rectangle {
    /// The smallest indices.
    pub first: [usize; 2],
    /// The largest indices; these cells belong to the rectangle too.
    pub last: [usize; 2],
}

impl Rectangle {
    pub(crate) fn contains(&self, cell: [usize; 2]) -> bool {
        (0..2).all(|axis| (self.first[axis]..=self.last[axis]).contains(&cell[axis]))
    }
}
