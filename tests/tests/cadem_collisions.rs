//! What CADEM makes of a collision: restitution, contact time, overlap, and how they converge.
//!
//! All phases of a contact within a time step are tried in one run: many collisions side by side, each in a
//! row of cells of its own.

mod cadem_support;

use cadem::{Configuration, Face, Integrator, Particle, TimeStep, Walls};
use cadem_support::{TestResult, close, only_wall, start, weightless};
use xca_tests::brute_force;
use xca_tests::restitution::{Collision, Spread};

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

    /// The place of each collision in y and z, and the gap that leaves a phase of the first time step for the
    /// contact.
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
            pairs
                .map(|pair| {
                    let distance = pair[1].position[0] - pair[0].position[0];
                    (2.0 * radius - distance, pair[1].velocity[0] - pair[0].velocity[0])
                })
                .collect()
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

/// The restitution that the integrator's recurrence alone gives, with the same phases: no cells, no slots, no
/// contact search.
fn expected(collision: Option<Collision>, integrator: Integrator, bench: &Bench) -> Spread {
    let integrator = match integrator {
        Integrator::SemiImplicit => brute_force::Integrator::SymplecticEuler,
        Integrator::Explicit => brute_force::Integrator::ExplicitEuler,
    };
    let phases = (bench.rows * bench.rows) as u32;
    let time_step = bench.configuration.material().time_step;
    collision
        .and_then(|collision| collision.spread_of_restitution(integrator, time_step, phases))
        .expect("these collisions bounce")
}

fn agrees(seen: &Seen, expected: Spread) {
    close(seen.mean, expected.mean, 1e-11);
    close(seen.least, expected.least, 1e-10);
    close(seen.most, expected.most, 1e-10);
}

fn of_particles() -> Option<Collision> {
    Collision::of_particles(8000.0, 0.0015, 1e-4)
}

fn with_wall(times: f64) -> Option<Collision> {
    Collision::with_wall(times * 8000.0, times * 0.0015, 1e-4)
}

#[test]
fn two_particles() -> TestResult {
    let bench = Bench::new(20);
    let seen = bench.particles_on_particles()?;
    agrees(&seen, expected(of_particles(), Integrator::SemiImplicit, &bench));
    // The limits for many phases (docs/cadem.md).
    close(seen.mean, 0.996_285_4, 1e-6);
    close(seen.least, 0.994_454, 2e-5);
    close(seen.most, 0.997_913, 1e-5);
    // 2.483649e-4 s are 22.214 steps.
    close(seen.steps_in_contact, 22.2, 0.05);
    close(seen.overlap / 7.890_993e-5, 1.0, 3e-3);
    Ok(())
}

#[test]
fn a_particle_and_a_wall() -> TestResult {
    let bench = Bench::new(20).with_wall(Walls::Single);
    let seen = bench.particles_on_wall()?;
    agrees(&seen, expected(with_wall(1.0), Integrator::SemiImplicit, &bench));
    close(seen.mean, 0.997_370_9, 1e-6);
    close(seen.least, 0.996_071, 2e-5);
    close(seen.most, 0.998_638, 1e-5);
    close(seen.steps_in_contact, 31.4, 0.05);
    close(seen.overlap / 1.116_563e-4, 1.0, 3e-3);
    Ok(())
}

#[test]
fn a_wall_of_the_authors_program_acts_nine_times() -> TestResult {
    let bench = Bench::new(20).with_wall(Walls::PerSlot);
    agrees(&bench.particles_on_wall()?, expected(with_wall(9.0), Integrator::SemiImplicit, &bench));
    Ok(())
}

#[test]
fn the_printed_integrator_gains_energy() -> TestResult {
    let bench = Bench::new(20).with_integrator(Integrator::Explicit);
    let seen = bench.particles_on_particles()?;
    agrees(&seen, expected(of_particles(), Integrator::Explicit, &bench));
    close(seen.mean, 1.2432, 5e-5);
    let bench = bench.with_wall(Walls::Single);
    let seen = bench.particles_on_wall()?;
    agrees(&seen, expected(with_wall(1.0), Integrator::Explicit, &bench));
    close(seen.mean, 1.1667, 5e-5);
    Ok(())
}

/// With no damping the phase gives or takes some energy; on the average over the phases none.
#[test]
fn without_damping_nothing_is_lost_on_the_average() -> TestResult {
    let mut bench = Bench::new(20);
    bench.configuration.damping = 0.0;
    close(bench.particles_on_particles()?.mean, 1.0, 1e-5);
    close(bench.with_wall(Walls::Single).particles_on_wall()?.mean, 1.0, 1e-5);
    Ok(())
}

/// The error of the mean restitution falls with the square of the time step, and so does that of the largest
/// overlap.
#[test]
fn converges_with_second_order() -> TestResult {
    let exact = of_particles().map(|collision| collision.restitution()).unwrap_or_default();
    close(exact, 0.996_281_458, 1e-9);
    let mut errors = Vec::new();
    for parts in [1.0, 2.0, 4.0] {
        let seen = Bench::new(20).with_time_step_divided_by(parts).particles_on_particles()?;
        errors.push([seen.mean - exact, seen.overlap / 7.890_993e-5 - 1.0].map(f64::abs));
    }
    for (error, bound) in errors.iter().zip([4.5e-6, 1.15e-6, 2.6e-7]) {
        assert!(error[0] < bound, "{errors:?}");
    }
    for pair in errors.windows(2) {
        assert!((0..2).all(|which| pair[0][which] > 3.5 * pair[1][which]), "{errors:?}");
    }
    Ok(())
}
