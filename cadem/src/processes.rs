//! The elementary processes sigma_1 to sigma_5 of De Rango et al., section II.C.
//!
//! | paper | here |
//! |---|---|
//! | sigma_1 | [`reset_forces`] |
//! | sigma_2 | [`inner_contacts`] |
//! | sigma_3 | [`outer_contacts`], and [`outer_walls`] under the law [`crate::Walls::PerSlot`] |
//! | sigma_4 | [`accelerate`] and [`displace`]; which comes first is the integrator; before the latter [`guard_walls`], where walls have openings |
//! | sigma_5 | [`reassign`] |
//!
//! Each particle computes the force on itself, so that a process writes its own slot only. BOUNDARY slots
//! have no force and do not move.

use crate::contact::{is_beyond, particle_force, wall_force};
use crate::material::Material;
use crate::substates::{BOUNDARY, Dem, PARTICLE};
use xca_core::prelude::*;

/// The code of the fault that a particle moves further than its radius in one step; the value is its speed,
/// in m/s.
pub const TOO_FAST: u32 = 1;

/// The code of the fault that a velocity is no number.
pub const NOT_A_NUMBER: u32 = 2;

/// The code of the fault that a particle passes a wall where it has no opening; the value is its speed, in
/// m/s.
pub const THROUGH_WALL: u32 = 3;

/// sigma_1: the force on a particle becomes its weight.
#[elementary_process]
pub fn reset_forces(me: &mut Slot<Dem>, p: &Material) {
    if me.id == PARTICLE {
        me.force = Vector3::new(0.0, 0.0, -p.mass * p.gravity);
    }
}

/// sigma_2: adds the forces of the particles and the walls in the own cell.
#[elementary_process]
pub fn inner_contacts(me: &mut Slot<Dem>, p: &Material) {
    if me.id != PARTICLE {
        return;
    }
    for other in me.others_in_cell_within(2.0 * p.radius) {
        if other.id == PARTICLE {
            me.force += particle_force(p, me.position - other.position, me.velocity - other.velocity);
        }
    }
    for other in me.others_in_cell() {
        if other.id == BOUNDARY {
            me.force += wall_force(p, other.face, me.position - other.position, me.velocity);
        }
    }
}

/// sigma_3: adds the forces of the particles in the neighbours.
#[elementary_process]
pub fn outer_contacts(me: &mut Slot<Dem>, p: &Material) {
    if me.id != PARTICLE {
        return;
    }
    for other in me.others_in_neighbours_within(2.0 * p.radius) {
        if other.id == PARTICLE {
            me.force += particle_force(p, me.position - other.position, me.velocity - other.velocity);
        }
    }
}

/// sigma_3 under the law [`crate::Walls::PerSlot`]: adds the forces of the walls through the BOUNDARY slots
/// of the neighbours.
#[elementary_process]
pub fn outer_walls(me: &mut Slot<Dem>, p: &Material) {
    if me.id != PARTICLE {
        return;
    }
    for other in me.others_in_neighbours() {
        if other.id == BOUNDARY {
            me.force += wall_force(p, other.face, me.position - other.position, me.velocity);
        }
    }
}

/// sigma_4, the velocity: v' = v + (F / m) dt (eq. 4).
#[elementary_process]
pub fn accelerate(me: &mut Slot<Dem>, p: &Material) {
    if me.id == PARTICLE {
        me.velocity += me.force * (p.time_step / p.mass);
    }
}

/// Where walls have openings, so that particles may leave: reports those that [`displace`] would take through
/// a face of the domain that is closed at their cell ([`THROUGH_WALL`]). It changes nothing.
#[elementary_process]
pub fn guard_walls(me: &mut Slot<Dem>, p: &Material, space: &Space) {
    if me.id != PARTICLE {
        return;
    }
    let position = me.position + me.velocity * p.time_step;
    for other in me.others_in_cell() {
        if other.id == BOUNDARY && is_beyond(other.face, position / space.side(), space.extents()) {
            me.fault(THROUGH_WALL, me.velocity.length());
        }
    }
}

/// sigma_4, the position: x' = x + v dt (eq. 4), with the velocity that it finds.
///
/// After [`accelerate`] that is semi-implicit Euler, before it the explicit form as printed.
///
/// A particle that would move further than its radius is the fault [`TOO_FAST`]. So two particles come nearer
/// to each other by at most a diameter d in a step. The straight way between two places outside of a sphere
/// of radius d keeps sqrt(3) / 2 d from its centre where it is no longer than d: any closer approach is a
/// contact at the end of a step.
///
/// A velocity that is NaN is the fault [`NOT_A_NUMBER`].
#[elementary_process]
pub fn displace(me: &mut Slot<Dem>, p: &Material) {
    if me.id != PARTICLE {
        return;
    }
    let displacement = me.velocity * p.time_step;
    let square = displacement.length_squared();
    let limit = p.radius * p.radius;
    if square > limit {
        me.fault(TOO_FAST, me.velocity.length());
    } else if !(square <= limit) {
        me.fault(NOT_A_NUMBER, me.velocity.length());
    }
    me.position += displacement;
}

/// sigma_5: a particle belongs to the cell that now contains it.
#[migration]
pub fn reassign(me: &Slot<Dem>, space: &Space) -> Destination {
    if me.id == PARTICLE { space.cell_containing(me.position) } else { Destination::Stay }
}
