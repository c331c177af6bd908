//! CADEM against a plain particle code that has no cells and no slots.

mod cadem_support;

use cadem::{Case, Configuration, Diagnostics, Integrator, Particle, Walls};
use cadem_support::{Numbers, TestResult, close, start};
use xca_tests::brute_force::{self, BruteForce};

/// A box of 1 cm full of particles that fly about, and that fall 30 times as fast as on Earth so that all
/// walls get their share.
fn crowded(walls: Walls, integrator: Integrator) -> (Configuration, Vec<Particle>) {
    let configuration =
        Configuration { cells: [5; 3], gravity: 300.0, walls, integrator, ..Case::Table1.configuration() };
    let mut numbers = Numbers::new(3);
    let particles = (0..343_u32)
        .map(|place| {
            let lattice =
                [place % 7, place / 7 % 7, place / 49].map(|index| 0.0017 + 0.0011 * f64::from(index));
            let shift = numbers.vector(4e-5);
            Particle {
                label: 1000 - place,
                position: std::array::from_fn(|axis| lattice[axis] + shift[axis]),
                velocity: numbers.vector(0.5),
            }
        })
        .collect();
    (configuration, particles)
}

fn brute_force_of(configuration: &Configuration, particles: &[Particle]) -> BruteForce {
    let Configuration { stiffness, damping, mass, radius, gravity, .. } = *configuration;
    let material = brute_force::Material { stiffness, damping, mass, radius };
    BruteForce {
        particles: particles
            .iter()
            .map(|particle| brute_force::Particle {
                position: particle.position,
                velocity: particle.velocity,
            })
            .collect(),
        walls: match configuration.walls {
            Walls::Single => brute_force::Walls::Single,
            Walls::PerSlot => brute_force::Walls::PerSlot,
        },
        integrator: match configuration.integrator {
            Integrator::SemiImplicit => brute_force::Integrator::SymplecticEuler,
            Integrator::Explicit => brute_force::Integrator::ExplicitEuler,
        },
        time_step: configuration.material().time_step,
        gravity,
        ..BruteForce::new(material, configuration.sides())
    }
}

/// The largest difference of a coordinate after so many steps, having compared what both say of the state.
fn difference_after(
    steps: u64,
    walls: Walls,
    integrator: Integrator,
) -> Result<f64, Box<dyn std::error::Error>> {
    let (configuration, particles) = crowded(walls, integrator);
    let mut plain = brute_force_of(&configuration, &particles);
    let mut simulation = start(&configuration, particles.clone())?;
    let (mut contacts, mut wall_contacts) = (0, 0);
    for _ in 0..steps / 10 {
        simulation.run(10)?;
        plain.advance(10);
        let measured = Diagnostics::of(&simulation.state(), walls)?;
        let energy = plain.energy();
        let scale = energy.total();
        close(measured.kinetic_energy, energy.kinetic, 1e-12 * scale);
        close(measured.potential_energy, energy.potential, 1e-12 * scale);
        close(measured.elastic_energy, energy.elastic, 1e-12 * scale);
        assert_eq!(measured.contacts, plain.contacts().len() as u64);
        assert_eq!(measured.wall_contacts, plain.wall_contacts().len() as u64);
        for (found, expected) in measured.momentum.into_iter().zip(plain.momentum()) {
            close(found, expected, 1e-15);
        }
        contacts += measured.contacts;
        wall_contacts += measured.wall_contacts;
    }
    assert!(contacts > 500 && wall_contacts > 100, "{contacts} {wall_contacts}");
    // The plain code keeps the order of the list; states are sorted by label.
    let mut expected: Vec<(u32, [f64; 3])> =
        particles.iter().zip(&plain.particles).map(|(one, same)| (one.label, same.position)).collect();
    expected.sort_unstable_by_key(|(label, _)| *label);
    let mut largest = 0.0_f64;
    for (particle, (label, position)) in cadem::particles(&simulation.state())?.iter().zip(expected) {
        assert_eq!(particle.label, label);
        for (found, expected) in particle.position.into_iter().zip(position) {
            largest = largest.max((found - expected).abs());
        }
    }
    Ok(largest)
}

#[test]
fn agrees_under_the_law_single() -> TestResult {
    let largest = difference_after(400, Walls::Single, Integrator::SemiImplicit)?;
    assert!(largest < 1e-14, "{largest:e}");
    Ok(())
}

#[test]
fn agrees_under_the_law_per_slot() -> TestResult {
    let largest = difference_after(400, Walls::PerSlot, Integrator::SemiImplicit)?;
    assert!(largest < 1e-14, "{largest:e}");
    Ok(())
}

#[test]
fn agrees_with_the_printed_integrator() -> TestResult {
    let largest = difference_after(200, Walls::Single, Integrator::Explicit)?;
    assert!(largest < 1e-14, "{largest:e}");
    Ok(())
}
