use super::*;
use crate::restitution::{Collision, free_fall, static_deflection};

mod published;

const INTEGRATORS: [Integrator; 2] = [Integrator::SymplecticEuler, Integrator::ExplicitEuler];

/// Nothing but the particles: no walls, no gravity.
fn in_free_space(particles: Vec<Particle>) -> BruteForce {
    let empty = BruteForce::new(Material::TABLE_1, [0.04; 3]);
    BruteForce { particles, walls: Walls::Off, gravity: 0.0, ..empty }
}

/// A cloud of numbers in 0 to 1, by Weyl's method.
fn spread_out(count: usize) -> impl Iterator<Item = Vector> {
    let steps = [2.0_f64, 3.0, 5.0].map(f64::sqrt);
    (1..=count).map(move |n| steps.map(|step| (n as f64 * step).fract()))
}

/// Particles at random places in a cube, with random velocities of up to `speed` in each direction.
fn cloud(count: usize, side: f64, speed: f64) -> Vec<Particle> {
    let velocities = spread_out(2 * count).skip(count).map(|u| u.map(|u| speed * (2.0 * u - 1.0)));
    spread_out(count)
        .map(|u| u.map(|u| u * side))
        .zip(velocities)
        .map(|(position, velocity)| Particle { position, velocity })
        .collect()
}

fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found:e} is not {expected:e} within {tolerance:e}");
}

/// Steps until nothing touches any more. Returns the largest overlap and the number of time steps that began
/// with one.
fn collide(system: &mut BruteForce) -> (f64, u32) {
    let (mut largest, mut steps) = (0.0, 0);
    loop {
        system.step();
        let overlaps = system.contacts().into_iter().map(|contact| contact.overlap);
        let at_walls = system.wall_contacts().into_iter().map(|contact| contact.overlap);
        match overlaps.chain(at_walls).reduce(f64::max) {
            Some(overlap) => (largest, steps) = (f64::max(largest, overlap), steps + 1),
            None if steps > 0 => return (largest, steps),
            None => {}
        }
        assert!(steps < 100_000, "they do not part");
    }
}

/// Two particles that approach each other along a slanted line, and overlap by `phase` of a time step's way
/// after a step.
fn pair(speed: f64, phase: f64, integrator: Integrator, time_step: f64) -> BruteForce {
    let along = [2.0 / 7.0, -3.0 / 7.0, 6.0 / 7.0];
    let apart = 0.001 + (1.0 - phase) * speed * time_step;
    let particles = [-0.5, 0.5].map(|half| Particle {
        position: along.map(|component| 0.02 + half * apart * component),
        velocity: along.map(|component| -half * speed * component),
    });
    BruteForce { integrator, time_step, ..in_free_space(particles.to_vec()) }
}

fn restitution_of_pair(phase: f64, integrator: Integrator) -> f64 {
    let speed = 0.3;
    let mut system = pair(speed, phase, integrator, Material::TABLE_1.time_step());
    collide(&mut system);
    let [one, other] = [0, 1].map(|n| system.particles[n].velocity);
    let parting = difference(other, one);
    dot(parting, parting).sqrt() / speed
}

/// A particle that flies towards a face of the box, and overlaps the wall by `phase` of a time step's way
/// after a step.
fn at_wall(walls: Walls, axis: usize, normal: f64, phase: f64, integrator: Integrator) -> BruteForce {
    let (speed, side) = (0.3, [0.04, 0.03, 0.05]);
    let time_step = Material::TABLE_1.time_step();
    let inset = if walls == Walls::PerSlot { 0.0005 } else { 0.0 };
    let away = 0.0005 + inset + (1.0 - phase) * speed * time_step;
    let mut particle = Particle::at_rest([0.01; 3]);
    particle.position[axis] = if normal > 0.0 { away } else { side[axis] - away };
    particle.velocity[axis] = -normal * speed;
    BruteForce { particles: vec![particle], walls, integrator, side, ..in_free_space(Vec::new()) }
}

#[test]
fn forces_of_a_pair_by_hand() {
    // 0.0008 apart, so they overlap by 0.0002; of the velocity of the first against the other only x counts.
    let one = Particle { position: [0.01, 0.02, 0.02], velocity: [0.4, 7.0, 1.0] };
    let other = Particle { position: [0.0108, 0.02, 0.02], velocity: [-0.1, 3.0, -2.0] };
    let system = in_free_space(vec![one, other]);
    let push = 8000.0 * 0.0002 + 0.0015 * 0.5;
    let forces = system.forces();
    close(forces[0][0], -push, 1e-12);
    assert_eq!((forces[0][1], forces[0][2]), (0.0, 0.0));
    assert_eq!(forces[1], forces[0].map(|component| 0.0 - component));
    assert_eq!(in_free_space(vec![other, one]).forces(), [forces[1], forces[0]]);
}

#[test]
fn forces_of_walls_by_hand() {
    // In the corner of x-low and z-high, 0.0003 from both faces, moving towards x-low and away from z-high.
    let corner = Particle { position: [0.0003, 0.02, 0.0397], velocity: [-0.2, 5.0, -0.4] };
    let with = |walls| {
        let empty = BruteForce::new(Material::TABLE_1, [0.04; 3]);
        BruteForce { particles: vec![corner], walls, ..empty }
    };
    let weight = 1e-4 * 9.81;
    assert_eq!(with(Walls::Off).forces()[0], [0.0, 0.0, -weight]);
    for (walls, overlap, count) in [(Walls::Single, 0.0002, 1.0), (Walls::PerSlot, 0.0007, 9.0)] {
        let [x, y, z] = with(walls).forces()[0];
        close(x, count * (8000.0 * overlap + 0.0015 * 0.2), 1e-11);
        close(y, 0.0, 0.0);
        close(z, -count * (8000.0 * overlap - 0.0015 * 0.4) - weight, 1e-11);
        close(with(walls).energy().elastic, count * 8000.0 * overlap * overlap, 1e-15);
    }
}

#[test]
fn the_sweep_finds_what_all_pairs_have() {
    let system = in_free_space(cloud(400, 0.005, 0.0));
    let mut found: Vec<_> = system.contacts().iter().map(|contact| (contact.first, contact.second)).collect();
    found.sort_unstable();
    let mut expected = Vec::new();
    for (i, one) in system.particles.iter().enumerate() {
        for (j, other) in system.particles.iter().enumerate().skip(i + 1) {
            let apart = difference(one.position, other.position);
            if dot(apart, apart).sqrt() < 0.001 {
                expected.push((i, j));
            }
        }
    }
    assert!(expected.len() > 1000, "{} contacts", expected.len());
    assert_eq!(found, expected);
}

#[test]
fn pairs_bounce_as_the_oscillator_does() {
    let oscillator = Collision::of_particles(8000.0, 0.0015, 1e-4).expect("it bounces");
    for integrator in INTEGRATORS {
        for n in 0..50 {
            let phase = (f64::from(n) + 0.5) / 50.0;
            let expected = oscillator.discrete_restitution(integrator, Material::TABLE_1.time_step(), phase);
            close(restitution_of_pair(phase, integrator), expected.expect("it bounces"), 1e-9);
        }
    }
}

#[test]
fn pairs_bounce_on_average_as_table_1_says() {
    let mean = |integrator| {
        (0..200).map(|n| restitution_of_pair((f64::from(n) + 0.5) / 200.0, integrator)).sum::<f64>() / 200.0
    };
    close(mean(Integrator::SymplecticEuler), 0.996_281_458, 1e-5);
    close(mean(Integrator::ExplicitEuler), 1.2432, 5e-5);
}

#[test]
fn walls_bounce_as_the_oscillator_does() {
    for (walls, count) in [(Walls::Single, 1.0), (Walls::PerSlot, 9.0)] {
        let oscillator = Collision::with_wall(count * 8000.0, count * 0.0015, 1e-4).expect("it bounces");
        for (axis, normal) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0), (2, 1.0), (2, -1.0)] {
            for (n, integrator) in (0..8).zip(INTEGRATORS.into_iter().cycle()) {
                let phase = (f64::from(n) + 0.5) / 8.0;
                let mut system = at_wall(walls, axis, normal, phase, integrator);
                collide(&mut system);
                let found = system.particles[0].velocity[axis] * normal / 0.3;
                let expected = oscillator.discrete_restitution(integrator, system.time_step, phase);
                close(found, expected.expect("it bounces"), 1e-9);
            }
        }
    }
}

#[test]
fn contact_time_and_overlap_approach_the_exact_ones() {
    let oscillator = Collision::of_particles(8000.0, 0.0015, 1e-4).expect("it bounces");
    let time_step = Material::TABLE_1.time_step() / 100.0;
    let speed = 0.5;
    let (overlap, steps) = collide(&mut pair(speed, 0.5, Integrator::SymplecticEuler, time_step));
    close(overlap / speed / oscillator.largest_overlap_per_speed(), 1.0, 1e-3);
    close(f64::from(steps) * time_step / oscillator.contact_time(), 1.0, 1e-3);
}

#[test]
fn a_fall_follows_the_formula() {
    for integrator in INTEGRATORS {
        let falling = vec![Particle::at_rest([0.01, 0.02, 0.035])];
        let box_of = BruteForce::new(Material::TABLE_1, [0.04; 3]);
        let mut system = BruteForce { particles: falling, integrator, ..box_of };
        system.advance(5_000);
        let fallen = free_fall(integrator, 9.81, system.time_step, 5_000);
        let [x, y, z] = system.particles[0].position;
        assert_eq!((x, y), (0.01, 0.02));
        close(z, 0.035 - fallen, 1e-14);
    }
}

#[test]
fn a_particle_comes_to_rest_on_the_floor() {
    for (walls, floor, count) in [(Walls::Single, 0.0, 1.0), (Walls::PerSlot, 0.0005, 9.0)] {
        // So damped that it rests after some hundred steps.
        let material = Material { damping: 0.3, ..Material::TABLE_1 };
        let standing = vec![Particle::at_rest([0.01, 0.02, floor + 0.0005])];
        let mut system = BruteForce { particles: standing, walls, ..BruteForce::new(material, [0.04; 3]) };
        system.advance(4_000);
        let deflection = floor + 0.0005 - system.particles[0].position[2];
        close(deflection, static_deflection(1e-4, 9.81, count * 8000.0), 1e-15);
        close(system.particles[0].velocity[2], 0.0, 1e-12);
    }
}

#[test]
fn a_cloud_keeps_its_momentum() {
    for integrator in INTEGRATORS {
        let mut system = in_free_space(cloud(200, 0.006, 0.5));
        system.integrator = integrator;
        let before = system.momentum();
        assert!(system.contacts().len() > 100);
        let largest =
            system.particles.iter().map(|particle| dot(particle.velocity, particle.velocity)).sum::<f64>();
        system.advance(500);
        let after = system.momentum();
        for axis in 0..3 {
            close(after[axis], before[axis], 1e-15 * largest);
        }
    }
}

#[test]
fn collisions_without_damping_keep_energy_on_average() {
    let gains = |integrator| {
        (0..100).map(move |n| {
            let mut system =
                pair(0.3, (f64::from(n) + 0.5) / 100.0, integrator, Material::TABLE_1.time_step());
            system.material.damping = 0.0;
            let before = system.energy().total();
            collide(&mut system);
            system.energy().total() / before - 1.0
        })
    };
    // A single collision gains or loses a little, as the first touch falls within its time step.
    assert!(gains(Integrator::SymplecticEuler).all(|gain| gain.abs() < 0.005));
    close(gains(Integrator::SymplecticEuler).sum::<f64>() / 100.0, 0.0, 3e-5);
    assert!(gains(Integrator::ExplicitEuler).all(|gain| gain > 0.5));
}

#[test]
fn a_lasting_contact_without_damping_keeps_its_energy() {
    // A box narrower than the particle, in which it swings between two springs.
    let material = Material { damping: 0.0, ..Material::TABLE_1 };
    let swinging = Particle { position: [0.00045, 0.02, 0.02], velocity: [0.3, 0.0, 0.0] };
    let narrow = BruteForce { gravity: 0.0, ..BruteForce::new(material, [0.0009, 0.04, 0.04]) };
    let mut system = BruteForce { particles: vec![swinging], ..narrow };
    let before = system.energy().total();
    for _ in 0..100_000 {
        system.step();
        close(system.energy().total() / before, 1.0, 0.1);
    }
    system.integrator = Integrator::ExplicitEuler;
    system.advance(100);
    assert!(system.energy().total() > 2.0 * before);
}

#[test]
fn damping_takes_energy_away() {
    let mut system = BruteForce { gravity: 0.0, ..BruteForce::new(Material::TABLE_1, [0.006; 3]) };
    system.particles = cloud(100, 0.006, 0.0);
    let mut energies = Vec::new();
    for _ in 0..10 {
        energies.push(system.energy().total());
        system.advance(200);
    }
    assert!(energies.is_sorted_by(|one, next| one > next), "{energies:?}");
}
