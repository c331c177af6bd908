//! A plain particle code, to compare CADEM with: no cells, no slots, nothing of xca.
//!
//! It knows all particles at once, looks for contacts by sweeping along x, and gives each contact's force to
//! both particles with opposite signs. CADEM finds contacts cell by cell, and each particle computes its own
//! force. So an error in one is not repeated in the other. The physics is that of De Rango et al., section
//! II: linear springs and dashpots, gravity along -z, spheres of one size.

mod vector;

pub use vector::Vector;
use vector::{add_scaled, difference, dot};

/// A sphere that can move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Particle {
    /// The centre, in m.
    pub position: Vector,
    /// The velocity, in m/s.
    pub velocity: Vector,
}

impl Particle {
    /// A particle that does not move.
    pub fn at_rest(position: Vector) -> Self {
        Self { position, velocity: [0.0; 3] }
    }
}

/// What the particles are made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// The spring constant k_n, in N/m.
    pub stiffness: f64,
    /// The damping coefficient eta, in kg/s.
    pub damping: f64,
    /// The mass of a particle, in kg.
    pub mass: f64,
    /// The radius of a particle, in m.
    pub radius: f64,
}

impl Material {
    /// The material of De Rango et al., Table I.
    pub const TABLE_1: Self = Self { stiffness: 8000.0, damping: 0.0015, mass: 1e-4, radius: 0.0005 };

    /// The time step of De Rango et al., footnote 4, in s: a tenth of sqrt(m / k_n).
    pub fn time_step(&self) -> f64 {
        0.1 * (self.mass / self.stiffness).sqrt()
    }
}

/// How the faces of the box act on particles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Walls {
    /// Not at all: particles leave the box.
    Off,
    /// Each face pushes a particle that overlaps it, once.
    Single,
    /// The law of the authors' program: walls stand one radius inside the box, and each acts through nine of
    /// its pieces, those in the nine outermost cells around a particle. So spring and dashpot are nine times
    /// those of [`Self::Single`].
    ///
    /// The program takes distances from walls without a sign. Here they have one, which is the same until a
    /// centre crosses a wall.
    PerSlot,
}

impl Walls {
    /// How far inside the box the walls stand, in radii, and how often each one acts.
    fn inset_and_count(self) -> Option<(f64, f64)> {
        match self {
            Self::Off => None,
            Self::Single => Some((0.0, 1.0)),
            Self::PerSlot => Some((1.0, 9.0)),
        }
    }
}

/// How velocity v and position x advance by a time step dt, given the acceleration a at its start.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Integrator {
    /// v' = v + a dt, x' = x + v' dt.
    SymplecticEuler,
    /// v' = v + a dt, x' = x + v dt, as De Rango et al. print it. It makes collisions gain energy unless eta
    /// > k_n dt.
    ExplicitEuler,
}

/// Two particles that overlap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// The index of one particle.
    pub first: usize,
    /// The index of the other one, which is the larger.
    pub second: usize,
    /// Two radii less the distance of the centres, in m.
    pub overlap: f64,
    /// The unit vector from the second particle to the first.
    pub normal: Vector,
}

/// A particle that overlaps a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallContact {
    /// The index of the particle.
    pub particle: usize,
    /// The wall is across this axis.
    pub axis: usize,
    /// The component of the unit vector into the box: 1 at a lower wall, -1 at an upper one.
    pub normal: f64,
    /// The radius less the distance of the centre from the wall, in m.
    pub overlap: f64,
}

/// The energies of all particles together, in J.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Energy {
    /// Of motion.
    pub kinetic: f64,
    /// Of height, m g z.
    pub potential: f64,
    /// Of the springs in contacts.
    pub elastic: f64,
}

impl Energy {
    /// All three together, which only damping (and the integrator) change.
    pub fn total(&self) -> f64 {
        self.kinetic + self.potential + self.elastic
    }
}

/// Particles in a box.
#[derive(Debug, Clone, PartialEq)]
pub struct BruteForce {
    /// The particles. They keep their places in this list.
    pub particles: Vec<Particle>,
    /// What they are made of.
    pub material: Material,
    /// How the box acts on them.
    pub walls: Walls,
    /// How they advance.
    pub integrator: Integrator,
    /// The time that a step takes, in s.
    pub time_step: f64,
    /// The acceleration along -z, in m/s^2.
    pub gravity: f64,
    /// The sides of the box, in m. Its lower corner is the origin.
    pub side: Vector,
}

impl BruteForce {
    /// An empty box: single walls, symplectic Euler, the material's own time step, and gravity 9.81 m/s^2.
    pub fn new(material: Material, side: Vector) -> Self {
        Self {
            particles: Vec::new(),
            material,
            walls: Walls::Single,
            integrator: Integrator::SymplecticEuler,
            time_step: material.time_step(),
            gravity: 9.81,
            side,
        }
    }

    /// Advances by one time step.
    pub fn step(&mut self) {
        let forces = self.forces();
        let time_step = self.time_step;
        for (particle, force) in self.particles.iter_mut().zip(forces) {
            let before = particle.velocity;
            add_scaled(&mut particle.velocity, time_step / self.material.mass, force);
            let moves_with = match self.integrator {
                Integrator::SymplecticEuler => particle.velocity,
                Integrator::ExplicitEuler => before,
            };
            add_scaled(&mut particle.position, time_step, moves_with);
        }
    }

    /// Advances by many time steps.
    pub fn advance(&mut self, steps: usize) {
        for _ in 0..steps {
            self.step();
        }
    }

    /// The force on each particle, in N.
    pub fn forces(&self) -> Vec<Vector> {
        let Material { stiffness, damping, mass, .. } = self.material;
        let mut forces = vec![[0.0, 0.0, -mass * self.gravity]; self.particles.len()];
        for contact in self.contacts() {
            let [first, second] = [contact.first, contact.second].map(|n| self.particles[n].velocity);
            let parting = dot(difference(first, second), contact.normal);
            let push = stiffness * contact.overlap - damping * parting;
            add_scaled(&mut forces[contact.first], push, contact.normal);
            add_scaled(&mut forces[contact.second], -push, contact.normal);
        }
        let count = self.walls.inset_and_count().map_or(0.0, |(_, count)| count);
        for contact in self.wall_contacts() {
            let parting = self.particles[contact.particle].velocity[contact.axis] * contact.normal;
            let push = count * (stiffness * contact.overlap - damping * parting);
            forces[contact.particle][contact.axis] += push * contact.normal;
        }
        forces
    }

    /// All pairs of particles that overlap.
    pub fn contacts(&self) -> Vec<Contact> {
        let reach = 2.0 * self.material.radius;
        let mut along_x: Vec<(usize, Vector)> =
            self.particles.iter().map(|particle| particle.position).enumerate().collect();
        along_x.sort_by(|(_, one), (_, other)| one[0].total_cmp(&other[0]));
        let mut contacts = Vec::new();
        for (n, &(index, position)) in along_x.iter().enumerate() {
            let near = along_x[n + 1..].iter().take_while(|(_, other)| other[0] - position[0] < reach);
            for &(other_index, other) in near {
                let from_other = difference(position, other);
                let square = dot(from_other, from_other);
                if square < reach * reach {
                    let distance = square.sqrt();
                    let sign = if index < other_index { 1.0 } else { -1.0 };
                    contacts.push(Contact {
                        first: index.min(other_index),
                        second: index.max(other_index),
                        overlap: reach - distance,
                        normal: from_other.map(|component| sign * component / distance),
                    });
                }
            }
        }
        contacts
    }

    /// All overlaps of particles with walls.
    pub fn wall_contacts(&self) -> Vec<WallContact> {
        let Some((inset, _)) = self.walls.inset_and_count() else { return Vec::new() };
        let radius = self.material.radius;
        let mut contacts = Vec::new();
        for (particle, Particle { position, .. }) in self.particles.iter().enumerate() {
            for (axis, (coordinate, side)) in position.iter().zip(self.side).enumerate() {
                let above_lower = coordinate - inset * radius;
                let below_upper = side - inset * radius - coordinate;
                for (normal, distance) in [(1.0, above_lower), (-1.0, below_upper)] {
                    if distance < radius {
                        contacts.push(WallContact { particle, axis, normal, overlap: radius - distance });
                    }
                }
            }
        }
        contacts
    }

    /// The energies.
    pub fn energy(&self) -> Energy {
        let Material { stiffness, mass, .. } = self.material;
        let sum_over_particles = |f: fn(&Particle) -> f64| self.particles.iter().map(f).sum::<f64>();
        let squares = |overlaps: &mut dyn Iterator<Item = f64>| overlaps.map(|x| x * x).sum::<f64>();
        let count = self.walls.inset_and_count().map_or(0.0, |(_, count)| count);
        let springs = squares(&mut self.contacts().iter().map(|contact| contact.overlap))
            + count * squares(&mut self.wall_contacts().iter().map(|contact| contact.overlap));
        Energy {
            kinetic: 0.5 * mass * sum_over_particles(|particle| dot(particle.velocity, particle.velocity)),
            potential: mass * self.gravity * sum_over_particles(|particle| particle.position[2]),
            elastic: 0.5 * stiffness * springs,
        }
    }

    /// The momentum of all particles together, in kg m/s.
    pub fn momentum(&self) -> Vector {
        let mut momentum = [0.0; 3];
        for particle in &self.particles {
            add_scaled(&mut momentum, self.material.mass, particle.velocity);
        }
        momentum
    }
}

#[cfg(test)]
mod tests;
