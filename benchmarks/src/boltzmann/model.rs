//! The fluid as its equations are: arrays, and loops over 19 directions.

use std::error::Error;
use std::f64::consts::TAU;
use xca_core::prelude::*;

/// Particles at rest and in 18 directions.
pub(crate) const DIRECTIONS: usize = 19;

/// A fluid.
#[derive(Substates, Clone, Copy, Debug)]
pub(crate) struct Fluid {
    /// Particles that move towards the neighbour with this index.
    pub(crate) f: [Real; DIRECTIONS],
}

/// What the fluid is like.
#[derive(Parameters, Clone, Copy, Debug)]
pub(crate) struct Flow {
    /// Relaxation rate.
    pub(crate) omega: Real,
}

/// The share of particles at rest that move in a direction.
#[helper]
fn weight(direction: Vector3<i32>) -> Real {
    match direction.length_squared() {
        0 => 1.0 / 3.0,
        1 => 1.0 / 18.0,
        _ => 1.0 / 36.0,
    }
}

/// The particles in a direction at equilibrium.
#[helper]
fn equilibrium(direction: Vector3<i32>, density: Real, velocity: Vector3<Real>) -> Real {
    let along = 3.0
        * (direction.x as Real * velocity.x
            + direction.y as Real * velocity.y
            + direction.z as Real * velocity.z);
    weight(direction) * density * (1.0 + along + 0.5 * along * along - 1.5 * velocity.dot(velocity))
}

/// What moves in a direction comes from the opposite neighbour, and relaxes towards equilibrium.
#[elementary_process]
fn stream_and_collide(cell: &mut Cell<Fluid>, flow: &Flow) {
    let mut f = [0.0; DIRECTIONS];
    let mut density = 0.0;
    let mut momentum = Vector3::splat(0.0);
    for n in 0..DIRECTIONS {
        f[n] = cell.neighbour(cell.opposite(n)).f[n];
        density += f[n];
        let direction = cell.displacement(n);
        momentum += Vector3::new(direction.x as Real, direction.y as Real, direction.z as Real) * f[n];
    }
    let velocity = momentum / density;
    for n in 0..DIRECTIONS {
        cell.f[n] = f[n] + flow.omega * (equilibrium(cell.displacement(n), density, velocity) - f[n]);
    }
}

/// A periodic cube with a shear wave: velocity along x that changes along z.
pub(crate) fn model(
    size: usize,
    neighbourhood: Neighbourhood,
    omega: f64,
) -> Result<Model, Box<dyn Error + Send + Sync>> {
    let directions = neighbourhood.displacements([0; 3]).to_vec();
    let begin = move |site: Site| {
        let along = 0.05 * (TAU * site.cell()[2] as f64 / size as f64).sin();
        let particles = |n: usize| {
            let [x, y, z] = directions[n];
            equilibrium(Vector3::new(x, y, z), 1.0, Vector3::new(along, 0.0, 0.0))
        };
        Fluid { f: std::array::from_fn(particles) }
    };
    let model = Model::builder("D3Q19")
        .extents([size; 3])
        .neighbourhood(neighbourhood)
        .boundary(Boundary::Toroidal)
        .substates::<Fluid>()
        .parameters(Flow { omega })
        .process(stream_and_collide)
        .fill(begin)
        .build()?;
    Ok(model)
}
