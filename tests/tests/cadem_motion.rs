//! What CADEM must keep: free fall, rest, momentum, energy.

mod cadem_support;

use cadem::{Case, Configuration, Diagnostics, Face, Integrator, Particle, Walls};
use cadem_support::{Numbers, TestResult, close, start, weightless};
use xca_core::Simulation;
use xca_tests::{brute_force, restitution};

fn position(simulation: &mut Simulation) -> Result<[f64; 3], Box<dyn std::error::Error>> {
    Ok(cadem::particles(&simulation.state())?[0].position)
}

/// z = z0 - g dt^2 n (n + 1) / 2 with the semi-implicit integrator and n (n - 1) with the explicit one,
/// whatever cells are crossed.
#[test]
fn free_fall_is_that_of_the_integrator() -> TestResult {
    let integrators = [
        (Integrator::SemiImplicit, brute_force::Integrator::SymplecticEuler),
        (Integrator::Explicit, brute_force::Integrator::ExplicitEuler),
    ];
    for (integrator, same) in integrators {
        let configuration = Configuration { cells: [1, 1, 10], integrator, ..Case::Table1.configuration() };
        let mut simulation = start(&configuration, vec![Particle::at_rest(1, [0.001, 0.001, 0.0195])])?;
        let time_step = configuration.material().time_step;
        for steps in [1, 10, 100, 1000, 4000] {
            simulation.run(steps - simulation.step_number())?;
            let fallen = restitution::free_fall(same, 9.81, time_step, steps as u32);
            close(position(&mut simulation)?[2], 0.0195 - fallen, 1e-15);
        }
    }
    Ok(())
}

/// A particle whose contact with the floor bears its weight stays there; one that is dropped on a damping
/// floor comes to rest there.
#[test]
fn a_particle_at_rest_is_as_deep_in_the_floor_as_its_weight_presses() -> TestResult {
    let table1 = Case::Table1.configuration();
    for (walls, times) in [(Walls::Single, 1.0), (Walls::PerSlot, 9.0)] {
        let configuration = Configuration { cells: [3; 3], walls, damping: 0.5, ..table1.clone() };
        let depth = restitution::static_deflection(1e-4, 9.81, times * 8000.0);
        if walls == Walls::Single {
            close(depth, 1.226_25e-7, 1e-15);
        }
        let floor = configuration.wall(Face::ZLow) + configuration.radius;
        for height in [-depth, 1e-5] {
            let mut simulation =
                start(&configuration, vec![Particle::at_rest(1, [0.003, 0.003, floor + height])])?;
            simulation.run(3000)?;
            close(position(&mut simulation)?[2], floor - depth, 1e-14);
            let measured = Diagnostics::of(&simulation.state(), walls)?;
            assert_eq!((measured.contacts, measured.wall_contacts), (0, 1));
            close(measured.largest_overlap, depth, 1e-14);
            close(measured.elastic_energy, times * 4000.0 * depth * depth, 1e-15);
        }
    }
    Ok(())
}

/// A crowd that collides all the time: particles on a lattice, somewhat nearer than they would like.
fn crowd(speed: f64) -> Vec<Particle> {
    let mut numbers = Numbers::new(7);
    let mut particles = Vec::new();
    for place in 0..125 {
        let lattice = [place % 5, place / 5 % 5, place / 25].map(|index| 0.0035 + 0.00098 * f64::from(index));
        let shift = numbers.vector(2e-5);
        particles.push(Particle {
            label: place as u32 + 1,
            position: std::array::from_fn(|axis| lattice[axis] + shift[axis]),
            velocity: numbers.vector(speed),
        });
    }
    particles
}

#[test]
fn momentum_is_kept_without_walls_and_gravity() -> TestResult {
    let configuration = Configuration { allow_overlaps: true, ..weightless([6; 3]) };
    let mut simulation = start(&configuration, crowd(0.2))?;
    let before = Diagnostics::of(&simulation.state(), Walls::Single)?;
    assert!(before.contacts > 100, "{before:?}");
    let mut contacts = 0;
    for _ in 0..30 {
        simulation.run(10)?;
        let now = Diagnostics::of(&simulation.state(), Walls::Single)?;
        assert_eq!((now.particles, now.left), (125, 0));
        for axis in 0..3 {
            // The momenta of single particles are of the order of 1e-5 kg m/s.
            close(now.momentum[axis], before.momentum[axis], 1e-18);
        }
        contacts += now.contacts;
    }
    assert!(contacts > 500, "{contacts}");
    Ok(())
}

/// With no damping a collision gives back what it took but for the phase, which has no bias: energy neither
/// grows nor falls.
#[test]
fn energy_is_kept_without_damping() -> TestResult {
    let configuration = Configuration { damping: 0.0, allow_overlaps: true, ..weightless([6; 3]) };
    let mut simulation = start(&configuration, crowd(0.2))?;
    let before = Diagnostics::of(&simulation.state(), Walls::Single)?.total_energy();
    for _ in 0..30 {
        simulation.run(10)?;
        let now = Diagnostics::of(&simulation.state(), Walls::Single)?;
        close(now.total_energy() / before, 1.0, 0.02);
    }
    Ok(())
}

/// A particle that swings up and down on the floor, always in contact: its energy stays in the band of the
/// integrator, whose width is w dt, for ever.
#[test]
fn energy_of_an_endless_contact_has_no_trend() -> TestResult {
    let configuration = Configuration { cells: [1, 1, 1], damping: 0.0, ..Case::Table1.configuration() };
    let depth = restitution::static_deflection(1e-4, 9.81, 8000.0);
    let rest = configuration.radius - depth;
    let mut simulation =
        start(&configuration, vec![Particle::at_rest(1, [0.001, 0.001, rest + 0.5 * depth])])?;
    // At rest in equilibrium.
    let least = 1e-4 * 9.81 * rest + 0.5 * 8000.0 * depth * depth;
    let swing = 0.5 * 8000.0 * (0.5 * depth).powi(2);
    let mut largest = [0.0_f64; 2];
    for step in 0..20_000 {
        simulation.step()?;
        let now = Diagnostics::of(&simulation.state(), Walls::Single)?;
        assert_eq!(now.wall_contacts, 1);
        let share = (now.total_energy() - least) / swing;
        assert!((share - 1.0).abs() < 0.11, "step {step}: {share}");
        if !(1000..19_000).contains(&step) {
            let end = usize::from(step >= 1000);
            largest[end] = largest[end].max(share);
        }
    }
    close(largest[0], largest[1], 1e-4);
    Ok(())
}

/// With the paper's damping energy only falls, whatever collides.
#[test]
fn damping_takes_energy() -> TestResult {
    let configuration = Configuration { damping: 0.05, allow_overlaps: true, ..weightless([6; 3]) };
    let mut simulation = start(&configuration, crowd(0.2))?;
    let mut before = f64::INFINITY;
    for _ in 0..6 {
        let now = Diagnostics::of(&simulation.state(), Walls::Single)?.total_energy();
        assert!(now < before, "{now} {before}");
        before = now;
        simulation.run(30)?;
    }
    Ok(())
}
