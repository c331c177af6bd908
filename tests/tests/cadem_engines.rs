//! CADEM gives the same bits on every engine, at any number of threads.

mod cadem_support;

use cadem::{Case, Configuration, Diagnostics, Face, Integrator, Opening, Particle, Walls};
use cadem_support::{Numbers, TestResult};
use xca_core::prelude::*;
use xca_cpu::Cpu;

/// A box with uneven sides and a crowd that falls towards one of its walls.
fn crowd(walls: Walls, integrator: Integrator) -> (Configuration, Vec<Particle>) {
    let configuration = Configuration {
        cells: [3, 4, 5],
        gravity: 300.0,
        walls,
        integrator,
        openings: vec![Opening::whole(Face::XHigh)],
        ..Case::Table1.configuration()
    };
    let mut numbers = Numbers::new(11);
    let particles = (0..120_u32)
        .map(|place| {
            let lattice =
                [place % 4, place / 4 % 5, place / 20].map(|index| 0.0015 + 0.0011 * f64::from(index));
            let shift = numbers.vector(4e-5);
            Particle {
                label: 7 * place,
                position: std::array::from_fn(|axis| lattice[axis] + shift[axis]),
                velocity: numbers.vector(0.7),
            }
        })
        .collect();
    (configuration, particles)
}

#[test]
fn same_bits_everywhere() -> TestResult {
    for (walls, integrator, precision) in [
        (Walls::Single, Integrator::SemiImplicit, Precision::F64),
        (Walls::Single, Integrator::Explicit, Precision::F32),
        (Walls::PerSlot, Integrator::SemiImplicit, Precision::F32),
        (Walls::PerSlot, Integrator::Explicit, Precision::F64),
    ] {
        let (configuration, particles) = crowd(walls, integrator);
        let model = cadem::model(&configuration, particles)?;
        let options = RunOptions { precision, ..RunOptions::default() };
        let mut reference = Simulation::new(&model, &Reference, options)?;
        reference.run(300)?;
        let seen = Diagnostics::of(&reference.state(), walls)?;
        assert!(seen.contacts > 10 && seen.wall_contacts > 3 && seen.left > 0, "{seen:?}");
        for threads in [1, 2, 3, 8] {
            let mut simulation = Simulation::new(&model, &Cpu::with_threads(threads)?, options)?;
            simulation.run(300)?;
            assert!(
                simulation.snapshot()? == reference.snapshot()?,
                "{walls} {integrator} {precision} {threads}"
            );
            assert_eq!(Diagnostics::of(&simulation.state(), walls)?, seen);
        }
    }
    Ok(())
}

/// The two precisions tell the same story for a while.
#[test]
fn f32_follows_f64() -> TestResult {
    let (configuration, particles) = crowd(Walls::Single, Integrator::SemiImplicit);
    let model = cadem::model(&configuration, particles)?;
    let mut positions = Vec::new();
    for precision in [Precision::F32, Precision::F64] {
        let mut simulation =
            Simulation::new(&model, &Reference, RunOptions { precision, ..RunOptions::default() })?;
        simulation.run(100)?;
        positions.push(cadem::particles(&simulation.state())?);
    }
    assert_eq!(positions[0].len(), positions[1].len());
    let mut largest = 0.0_f64;
    for (one, same) in positions[0].iter().zip(&positions[1]) {
        assert_eq!(one.label, same.label);
        for axis in 0..3 {
            largest = largest.max((one.position[axis] - same.position[axis]).abs());
        }
    }
    assert!(largest > 0.0 && largest < 1e-6, "{largest:e}");
    Ok(())
}
