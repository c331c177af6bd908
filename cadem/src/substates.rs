//! The substates of a slot: Q of De Rango et al., section II.C.

use xca_core::prelude::*;

/// The id of an empty slot. Populations store occupied slots only, so no item carries it.
pub const VOID: u8 = 0;

/// The id of a slot that holds a particle.
pub const PARTICLE: u8 = 1;

/// The id of a slot that marks a piece of the domain's boundary.
pub const BOUNDARY: u8 = 2;

/// The label of the first BOUNDARY slot. Particles have smaller labels, so in a cell they come first.
pub const FIRST_BOUNDARY_LABEL: u32 = 0x8000_0000;

/// The state of a slot, q_s = (q_id, q_p, q_v, q_F).
#[derive(Substates, Clone, Copy, Debug, PartialEq)]
pub struct Dem {
    /// What the slot holds, Q_id: [`PARTICLE`] or [`BOUNDARY`].
    pub id: u8,
    /// Of a BOUNDARY slot, the number of the domain face that it is a piece of ([`crate::Face::number`]); 0
    /// of a particle.
    pub face: u8,
    /// The centre of the particle, or a point on the plane of the wall, in m (Q_p).
    #[position]
    pub position: Vector3<Real>,
    /// The velocity of the particle, in m/s (Q_v); walls stand still.
    pub velocity: Vector3<Real>,
    /// The force on the particle, in N (Q_F); 0 of a wall.
    pub force: Vector3<Real>,
}
