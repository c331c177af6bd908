//! The fluid of the gallery without its velocity, which the loop by hand does not keep.

use std::error::Error;
use std::f64::consts::TAU;
use xca_core::prelude::*;
use xca_examples::models::boltzmann::{DIRECTIONS, equilibrium};

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
