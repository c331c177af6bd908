//! A lid-driven cavity by the lattice Boltzmann method (D2Q9, one relaxation time, half-way bounce-back).
//!
//! The walls are the faces of the space. At a wall the particles come back the way they went; the lid, the
//! north face, gives them its speed.

use xca_core::prelude::*;

/// Particles at rest and in 8 directions.
const DIRECTIONS: usize = 9;

/// A fluid.
#[derive(Substates, Clone, Copy, Debug)]
pub struct Fluid {
    /// Particles that move towards the neighbour with this index.
    pub f: [Real; DIRECTIONS],
    /// The velocity, in cells a step.
    pub velocity: Vector2<Real>,
}

/// How the lid moves, and what the fluid is like.
#[derive(Parameters, Clone, Copy, Debug)]
pub struct Cavity {
    /// The Reynolds number of the lid's speed and the side of the cavity.
    #[parameter(positive)]
    pub reynolds: Real,
    /// Speed of the lid, in cells a step: small against the speed of sound.
    #[parameter(range = 0.0..=0.3)]
    pub lid_speed: Real,
    /// Cells along a side.
    #[parameter(computed, range = 3..)]
    pub size: u32,
    /// Relaxation rate.
    #[parameter(computed, range = 0.0..2.0)]
    pub omega: Real,
}

/// The share of particles at rest that move in a direction.
#[helper]
fn weight(direction: Vector3<i32>) -> Real {
    match direction.length_squared() {
        0 => 4.0 / 9.0,
        1 => 1.0 / 9.0,
        _ => 1.0 / 36.0,
    }
}

/// Streaming, walls, and relaxation towards equilibrium.
#[elementary_process]
pub fn stream_and_collide(cell: &mut Cell<Fluid>, cavity: &Cavity) {
    let mut f = [0.0; DIRECTIONS];
    let mut density = 0.0;
    let mut momentum = Vector2::splat(0.0);
    for n in 0..DIRECTIONS {
        let source = cell.opposite(n);
        let direction = cell.displacement(n);
        if cell.exists(source) {
            f[n] = cell.neighbour(source).f[n];
        } else {
            f[n] = cell.neighbour(0).f[source];
            if cell.index().y - direction.y == cavity.size as i32 {
                f[n] += 6.0 * weight(direction) * direction.x as Real * cavity.lid_speed;
            }
        }
        density += f[n];
        momentum += Vector2::new(direction.x as Real, direction.y as Real) * f[n];
    }
    let velocity = momentum / density;
    let square = 1.5 * velocity.dot(velocity);
    for n in 0..DIRECTIONS {
        let direction = cell.displacement(n);
        let along = 3.0 * (direction.x as Real * velocity.x + direction.y as Real * velocity.y);
        let equilibrium = weight(direction) * density * (1.0 + along + 0.5 * along * along - square);
        cell.f[n] = f[n] + cavity.omega * (equilibrium - f[n]);
    }
    cell.velocity = velocity;
}

/// A square cavity of fluid at rest, under a lid that begins to move to the east.
///
/// # Errors
/// Where a parameter is out of its range.
pub fn model(size: u32, reynolds: f64) -> Result<Model, ModelError> {
    let neighbourhood = Neighbourhood::moore_2d(1);
    let weights =
        neighbourhood.displacements([0; 3]).iter().map(|[x, y, z]| weight(Vector3::new(*x, *y, *z)));
    let weights: Vec<f64> = weights.collect();
    Model::builder("cavity")
        .extents([size as usize, size as usize, 1])
        .neighbourhood(neighbourhood)
        .substates::<Fluid>()
        .parameters(Cavity { reynolds, lid_speed: 0.1, size, omega: 1.0 })
        .compute_parameters(move |cavity: &mut Cavity| {
            cavity.size = size;
            let viscosity = cavity.lid_speed * f64::from(cavity.size) / cavity.reynolds;
            cavity.omega = 1.0 / (3.0 * viscosity + 0.5);
        })
        .process(stream_and_collide)
        .fill(move |_| Fluid { f: std::array::from_fn(|n| weights[n]), velocity: Vector2::splat(0.0) })
        .build()
}
