//! Few buffers for a process.

use crate::common::{TestResult, assert_agrees, gpu, state_after};
use std::error::Error;
use xca_core::prelude::*;
use xca_gpu::Handicap;

const DIRECTIONS: usize = 19;

/// A fluid of 19 populations of particles, which are one substate.
#[derive(Substates, Clone, Copy)]
struct Fluid {
    f: [Real; DIRECTIONS],
    velocity: Vector3<Real>,
}

#[derive(Parameters, Clone, Copy, Debug)]
struct Flow {
    omega: Real,
}

#[elementary_process]
fn stream_and_relax(cell: &mut Cell<Fluid>, flow: &Flow) {
    let mut f = [0.0; DIRECTIONS];
    let mut density = 0.0;
    let mut momentum = Vector3::splat(0.0);
    for n in 0..DIRECTIONS {
        f[n] = cell.neighbour(cell.opposite(n)).f[n];
        density += f[n];
        let to = cell.displacement(n);
        momentum += Vector3::new(to.x as Real, to.y as Real, to.z as Real) * f[n];
    }
    cell.velocity = momentum / density;
    for n in 0..DIRECTIONS {
        let to = cell.displacement(n);
        let along =
            to.x as Real * cell.velocity.x + to.y as Real * cell.velocity.y + to.z as Real * cell.velocity.z;
        cell.f[n] = f[n] + flow.omega * (density * (1.0 + 3.0 * along) / 19.0 - f[n]);
    }
}

fn fluid() -> Result<Model, Box<dyn Error>> {
    let cube = Neighbourhood::moore(1);
    let near = |[x, y, z]: &&[i32; 3]| x * x + y * y + z * z <= 2;
    let nineteen = cube.displacements([0; 3]).iter().filter(near).copied().collect();
    Ok(Model::builder("fluid")
        .extents([9, 7, 5])
        .neighbourhood(Neighbourhood::custom(nineteen)?)
        .boundary(Boundary::Toroidal)
        .substates::<Fluid>()
        .parameters(Flow { omega: 1.2 })
        .process(stream_and_relax)
        .fill(|site| Fluid {
            f: std::array::from_fn(|n| 0.05 + 0.01 * site.random(n)),
            velocity: Vector3::splat(0.0),
        })
        .build()?)
}

/// The eight storage buffers that every adapter has are enough.
#[test]
fn a_fluid_in_space_needs_few_buffers() -> TestResult {
    let model = fluid()?;
    assert_agrees(&model, &gpu(Handicap { buffers: Some(8), ..Handicap::default() })?, 5);
    let error = state_after(&model, &gpu(Handicap { buffers: Some(3), ..Handicap::default() })?, 5);
    let error = error.err().ok_or("three buffers are enough")?;
    assert!(error.contains("`stream_and_relax`") && error.contains("can use 3 on this adapter"), "{error}");
    Ok(())
}
