//! No pair of particles passes unseen: random pairs against the geometry of straight ways.

mod cadem_support;

use cadem::{Particle, processes};
use cadem_support::{Numbers, TestResult, start, weightless};
use xca_core::engine::Fault;
use xca_core::prelude::*;

const STEPS: u64 = 12;

/// Two spheres that would fly on undisturbed.
#[derive(Debug)]
struct Pair {
    positions: [[f64; 3]; 2],
    velocities: [[f64; 3]; 2],
}

fn difference([one, other]: [[f64; 3]; 2]) -> [f64; 3] {
    [one[0] - other[0], one[1] - other[1], one[2] - other[2]]
}

fn length([x, y, z]: [f64; 3]) -> f64 {
    x.hypot(y).hypot(z)
}

impl Pair {
    /// A pair that is out of contact and flies apart or towards each other, up to so far in a step.
    fn random(numbers: &mut Numbers, diameter: f64, furthest: f64, time_step: f64) -> Self {
        let middle = [0.01; 3];
        let aside = numbers.vector(0.7 * diameter);
        loop {
            let half = numbers.vector(2.0 * diameter);
            let apart = 2.0 * length(half);
            if apart < 1.01 * diameter {
                continue;
            }
            // Towards the other one, more or less: a pair at random would hardly ever meet.
            let speed = furthest * numbers.unit() / time_step;
            let to_other = [0, 1, 2].map(|axis| aside[axis] - 2.0 * half[axis]);
            let one = to_other.map(|component| speed * component / length(to_other));
            let own = numbers.unit();
            let positions = [1.0, -1.0].map(|sign| [0, 1, 2].map(|axis| middle[axis] + sign * half[axis]));
            let velocities = [one, one.map(|component| -own * component)];
            return Self { positions, velocities };
        }
    }

    /// The least distance of the two on their undisturbed ways.
    fn least_distance(&self, time: f64) -> f64 {
        let (apart, speed) = (difference(self.positions), difference(self.velocities));
        let square: f64 = speed.iter().map(|component| component * component).sum();
        let along: f64 = (0..3).map(|axis| apart[axis] * speed[axis]).sum();
        let nearest = if square > 0.0 { (-along / square).clamp(0.0, time) } else { 0.0 };
        length([0, 1, 2].map(|axis| apart[axis] + nearest * speed[axis]))
    }

    fn particles(&self) -> Vec<Particle> {
        let pair = (1..).zip(self.positions.into_iter().zip(self.velocities));
        pair.map(|(label, (position, velocity))| Particle { label, position, velocity }).collect()
    }
}

/// What became of a pair.
#[derive(Debug, PartialEq)]
enum Fate {
    TooFast,
    Collided,
    FlewOn,
}

fn fate(pair: &Pair) -> Result<Fate, Box<dyn std::error::Error>> {
    let mut simulation = start(&weightless([10; 3]), pair.particles())?;
    match simulation.run(STEPS) {
        Err(RunError::Fault { fault: Fault::Reported { code: processes::TOO_FAST, .. }, .. }) => {
            return Ok(Fate::TooFast);
        }
        Err(error) => return Err(error.into()),
        Ok(_) => {}
    }
    let particles = cadem::particles(&simulation.state())?;
    let velocities: Vec<[f64; 3]> = particles.iter().map(|particle| particle.velocity).collect();
    Ok(if velocities == pair.velocities { Fate::FlewOn } else { Fate::Collided })
}

#[test]
fn no_pair_passes_unseen() -> TestResult {
    let material = weightless([10; 3]).material();
    let (diameter, time_step) = (2.0 * material.radius, material.time_step);
    let mut numbers = Numbers::new(7);
    let mut fates = [0; 3];
    for number in 0..300 {
        let furthest = if number % 3 == 0 { 1.5 * diameter } else { material.radius };
        let pair = Pair::random(&mut numbers, diameter, furthest, time_step);
        // The last positions have not pushed anyone yet.
        let least = pair.least_distance(time_step * (STEPS - 1) as f64);
        let fastest = pair.velocities.map(length).into_iter().fold(0.0, f64::max) * time_step;
        let fate = fate(&pair)?;
        match fate {
            Fate::TooFast => assert!(fastest > 0.999 * material.radius, "{pair:?}"),
            Fate::Collided => assert!(least < diameter, "{least} {pair:?}"),
            Fate::FlewOn => assert!(least > 0.866 * diameter, "passed unseen at {least} m: {pair:?}"),
        }
        fates[fate as usize] += 1;
    }
    // Each kind was really there.
    assert!(fates.iter().all(|count| *count > 30), "{fates:?}");
    Ok(())
}

/// Two that close on each other by twice their size in a step, each at less than the side of a cell in a
/// step.
#[test]
fn a_pair_at_full_speed_head_on_is_too_fast() -> TestResult {
    let pair = Pair {
        positions: [[0.0094, 0.011, 0.011], [0.0105, 0.011, 0.011]],
        velocities: [[100.0, 0.0, 0.0], [-100.0, 0.0, 0.0]],
    };
    assert_eq!(fate(&pair)?, Fate::TooFast);
    Ok(())
}
