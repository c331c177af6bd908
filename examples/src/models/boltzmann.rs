//! The lattice Boltzmann method in space (D3Q19, one relaxation time): Qian, d'Humières and Lallemand,
//! Europhysics Letters 17, 1992.

use xca_core::NeighbourhoodError;
use xca_core::prelude::*;

/// Particles at rest and in 18 directions.
pub const DIRECTIONS: usize = 19;

/// A fluid.
#[derive(Substates, Clone, Copy, Debug)]
pub struct Fluid {
    /// Particles that move towards the neighbour with this index.
    pub f: [Real; DIRECTIONS],
    /// The velocity before the collision, in cells a step.
    pub velocity: Vector3<Real>,
}

/// What the fluid is like.
#[derive(Parameters, Clone, Copy, Debug)]
pub struct Flow {
    /// Kinematic viscosity, in cells squared a step.
    #[parameter(positive)]
    pub viscosity: Real,
    /// Relaxation rate.
    #[parameter(computed)]
    pub omega: Real,
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
pub fn equilibrium(direction: Vector3<i32>, density: Real, velocity: Vector3<Real>) -> Real {
    let along = 3.0
        * (direction.x as Real * velocity.x
            + direction.y as Real * velocity.y
            + direction.z as Real * velocity.z);
    weight(direction) * density * (1.0 + along + 0.5 * along * along - 1.5 * velocity.dot(velocity))
}

/// What moves in a direction comes from the opposite neighbour, and relaxes towards equilibrium.
#[elementary_process]
pub fn stream_and_collide(cell: &mut Cell<Fluid>, flow: &Flow) {
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
    cell.velocity = velocity;
    for n in 0..DIRECTIONS {
        cell.f[n] = f[n] + flow.omega * (equilibrium(cell.displacement(n), density, velocity) - f[n]);
    }
}

/// The 19 cells at most the root of 2 away.
///
/// # Errors
/// None: the list is right.
pub fn neighbourhood() -> Result<Neighbourhood, NeighbourhoodError> {
    let cube = Neighbourhood::moore(1);
    let near = |[x, y, z]: &&[i32; 3]| x * x + y * y + z * z <= 2;
    Neighbourhood::custom(cube.displacements([0; 3]).iter().filter(near).copied().collect())
}

/// A periodic box of fluid at density 1, whose cells begin at equilibrium with the velocity that the
/// function says.
///
/// # Errors
/// Where the viscosity is not above 0.
pub fn model(
    extents: [usize; 3],
    viscosity: f64,
    velocity: impl Fn(Site) -> Vector3<f64> + Send + Sync + 'static,
) -> Result<Model, Box<dyn std::error::Error + Send + Sync>> {
    let directions = neighbourhood()?.displacements([0; 3]).to_vec();
    let begin = move |site: Site| {
        let velocity = velocity(site);
        let particles = |n: usize| {
            let [x, y, z] = directions[n];
            equilibrium(Vector3::new(x, y, z), 1.0, velocity)
        };
        Fluid { f: std::array::from_fn(particles), velocity }
    };
    let model = Model::builder("lattice Boltzmann")
        .extents(extents)
        .neighbourhood(neighbourhood()?)
        .boundary(Boundary::Toroidal)
        .substates::<Fluid>()
        .parameters(Flow { viscosity, omega: 1.0 })
        .compute_parameters(|flow: &mut Flow| flow.omega = 1.0 / (3.0 * flow.viscosity + 0.5))
        .process(stream_and_collide)
        .fill(begin)
        .build()?;
    Ok(model)
}
