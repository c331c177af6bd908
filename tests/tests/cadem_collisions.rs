//! What CADEM makes of a collision: restitution, contact time, overlap, and how they converge.
//!
//! All phases of a contact within a time step are tried in one run: many collisions side by side, each in a row of cells of its own.

mod cadem_support;

use cadem::{Configuration, Face, Integrator, Particle, TimeStep, Walls};
use cadem_support::{TestResult, close, only_wall, start, weightless};
use xca_tests::brute_force;
use xca_tests::restitution::Collision;

/// The speed of approach, in m/s.
const SPEED: f64 = 0.1;

/// What was seen in all collisions together.
#[derive(Debug)]
struct Seen {
    mean: f64,
    least: f64,
    most: f64,
    /// The mean of the number of steps that end in contact.
    steps_in_contact: f64,
    /// The largest overlap of all, over the speed of approach.
    overlap: f64,
}

/// A square of so many rows of cells along x, each with one collision.
struct Bench {
    configuration: Configuration,
    rows: usize,
}

impl Bench {
    fn new(rows: usize) -> Self {
        Self { configuration: weightless([4, rows, rows]), rows }
    }

    fn with_integrator(mut self, integrator: Integrator) -> Self {
        self.configuration.integrator = integrator;
        self
    }

    fn with_time_step_divided_by(mut self, parts: f64) -> Self {
        self.configuration.time_step = TimeStep::Fraction(0.1 / parts);
        self
    }

    fn with_wall(mut self, walls: Walls) -> Self {
        self.configuration.walls = walls;
        self.configuration.openings = only_wall(Face::XLow);
        self
    }

    /// The place of each collision in y and z, and the gap that leaves a phase of the first time step for the contact.
    fn collisions(&self) -> Vec<([f64; 2], f64)> {
        let count = self.rows * self.rows;
        let path = SPEED * self.configuration.material().time_step;
        (0..count)
            .map(|number| {
                let place = [number % self.rows, number / self.rows];
                let phase = (number as f64 + 0.5) / count as f64;
                (place.map(|index| (index as f64 + 0.5) * self.configuration.cell_side), path * (1.0 - phase))
            })
            .collect()
    }

    fn particles_on_particles(&self) -> Result<Seen, Box<dyn std::error::Error>> {
        let Configuration { cell_side, radius, .. } = self.configuration;
        let mut particles = Vec::new();
        for (number, ([y, z], gap)) in self.collisions().into_iter().enumerate() {
            // In turn within a cell (sigma_2) and across the face of two cells (sigma_3).
            let middle = if number % 2 == 0 { 1.5 * cell_side } else { 2.0 * cell_side };
            for sign in [-1.0, 1.0] {
                particles.push(Particle {
                    label: particles.len() as u32 + 1,
                    position: [middle + sign * (radius + 0.5 * gap), y, z],
                    velocity: [-sign * 0.5 * SPEED, 0.0, 0.0],
                });
            }
        }
        self.collide(particles, |particles| {
            let pairs = particles.chunks_exact(2);
            pairs.map(|pair| {
                let distance = pair[1].position[0] - pair[0].position[0];
                (2.0 * radius - distance, pair[1].velocity[0] - pair[0].velocity[0])
            }).collect()
        })
    }

    fn particles_on_wall(&self) -> Result<Seen, Box<dyn std::error::Error>> {
        let radius = self.configuration.radius;
        let wall = self.configuration.wall(Face::XLow);
        let particles = (1..).zip(self.collisions()).map(|(label, ([y, z], gap))| Particle {
            label,
            position: [wall + radius + gap, y, z],
            velocity: [-SPEED, 0.0, 0.0],
        });
        self.collide(particles.collect(), |particles| {
            let of = |particle: &Particle| (wall + radius - particle.position[0], particle.velocity[0]);
            particles.iter().map(of).collect()
        })
    }

    /// Runs until all have parted; the function gives overlap and parting speed of each collision.
    fn collide(
        &self,
        particles: Vec<Particle>,
        look: impl Fn(&[Particle]) -> Vec<(f64, f64)>,
    ) -> Result<Seen, Box<dyn std::error::Error>> {
        let mut simulation = start(&self.configuration, particles)?;
        simulation.step()?;
        let (mut steps, mut overlap) = (0, 0.0_f64);
        loop {
            let now = look(&cadem::particles(&simulation.state())?);
            let touching = now.iter().filter(|(overlap, _)| *overlap > 0.0).count();
            if touching == 0 {
                let count = now.len() as f64;
                let restitutions = now.iter().map(|(_, parting)| parting / SPEED);
                return Ok(Seen {
                    mean: restitutions.clone().sum::<f64>() / count,
                    least: restitutions.clone().fold(f64::INFINITY, f64::min),
                    most: restitutions.fold(0.0, f64::max),
                    steps_in_contact: f64::from(steps) / count,
                    overlap: overlap / SPEED,
                });
            }
            steps += touching as u32;
            overlap = now.iter().fold(overlap, |largest, (now, _)| largest.max(*now));
            simulation.step()?;
        }
    }
}

#[test]
fn explore() -> TestResult {
    for rows in [10, 20, 40] {
        println!("{rows} {:?}", Bench::new(rows).particles_on_particles()?);
        println!("{rows} {:?}", Bench::new(rows).with_wall(Walls::Single).particles_on_wall()?);
        println!("{rows} {:?}", Bench::new(rows).with_wall(Walls::PerSlot).particles_on_wall()?);
        for parts in [2.0, 4.0] {
            println!("{rows} {parts} {:?}", Bench::new(rows).with_time_step_divided_by(parts).particles_on_particles()?);
        }
    }
    println!("{:?}", Bench::new(20).with_integrator(Integrator::Explicit).particles_on_particles()?);
    println!("{:?}", Bench::new(20).with_integrator(Integrator::Explicit).with_wall(Walls::Single).particles_on_wall()?);
    let c = Collision::of_particles(8000.0, 0.0015, 1e-4).unwrap();
    println!("{:?}", c.spread_of_restitution(brute_force::Integrator::SymplecticEuler, Bench::new(2).configuration.material().time_step, 400));
    Ok(())
}
