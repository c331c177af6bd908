//! The forces of contacts: equation 2 of De Rango et al., with its sign made explicit.
//!
//! The same functions serve the processes on every engine and, as ordinary functions, the diagnostics.

use crate::material::Material;
use xca_core::prelude::*;

/// The size of the force between two bodies in contact, in N: `k_n delta - eta v`.
///
/// `overlap` is delta, in m. `parting` is the speed v at which the bodies move apart, in m/s. The spring
/// repels; the dashpot opposes approach and separation alike (eq. 2).
#[helper]
pub fn contact_law(p: &Material, overlap: Real, parting: Real) -> Real {
    p.stiffness * overlap - p.damping * parting
}

/// The force of another particle on a particle, in N; 0 where they do not touch.
///
/// `separation` is x_i - x_j, in m, and `relative_velocity` v_i - v_j, in m/s; the overlap is 2 p_r less the
/// distance (section II.A). Two centres at one place have no normal: the force is then no number, which
/// [`crate::processes::displace`] reports.
#[helper]
pub fn particle_force(
    p: &Material,
    separation: Vector3<Real>,
    relative_velocity: Vector3<Real>,
) -> Vector3<Real> {
    let distance = separation.length();
    let overlap = 2.0 * p.radius - distance;
    if overlap <= 0.0 {
        return Vector3::splat(0.0);
    }
    let normal = separation / distance;
    normal * contact_law(p, overlap, relative_velocity.dot(normal))
}

/// The force of a wall on a particle, in N; 0 where they do not touch.
///
/// `separation` is the particle's position less any point on the wall, in m; walls do not move.
#[helper]
pub fn wall_force(
    p: &Material,
    face: u8,
    separation: Vector3<Real>,
    velocity: Vector3<Real>,
) -> Vector3<Real> {
    let overlap = wall_overlap(p, face, separation);
    if overlap <= 0.0 {
        return Vector3::splat(0.0);
    }
    let normal = inward_normal(face);
    normal * contact_law(p, overlap, velocity.dot(normal))
}

/// How deep a particle is in a wall, in m: p_r less its distance from the plane (section II.A). The distance
/// has a sign: behind the plane the overlap is more than a radius.
#[helper]
pub fn wall_overlap(p: &Material, face: u8, separation: Vector3<Real>) -> Real {
    p.radius - separation.dot(inward_normal(face))
}

/// The unit vector from a domain face into the domain. The numbers of faces are those of [`crate::Face`].
#[helper]
pub fn inward_normal(face: u8) -> Vector3<Real> {
    match face {
        0 => Vector3::new(1.0, 0.0, 0.0),
        1 => Vector3::new(-1.0, 0.0, 0.0),
        2 => Vector3::new(0.0, 1.0, 0.0),
        3 => Vector3::new(0.0, -1.0, 0.0),
        4 => Vector3::new(0.0, 0.0, 1.0),
        _ => Vector3::new(0.0, 0.0, -1.0),
    }
}

/// Whether a place, in units of the cell side, is beyond this face of a domain of so many cells.
#[helper]
pub fn is_beyond(face: u8, place: Vector3<Real>, extents: Vector3<i32>) -> bool {
    match face {
        0 => place.x < 0.0,
        1 => place.x >= extents.x as Real,
        2 => place.y < 0.0,
        3 => place.y >= extents.y as Real,
        4 => place.z < 0.0,
        _ => place.z >= extents.z as Real,
    }
}
