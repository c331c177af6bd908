//! What can be said of a state in a few numbers.

use crate::contact::wall_overlap;
use crate::material::Material;
use crate::near::Near;
use crate::particles::array;
use crate::substates::{BOUNDARY, Dem, PARTICLE};
use crate::walls::Walls;
use serde::Serialize;
use std::collections::HashSet;
use xca_core::{Geometry, Item, State, StateError, Vector3};

/// Energies, momentum, contacts and occupancy of a state.
///
/// Computed on the host in `f64`, whatever the precision of the run, and in the order of the slots: the same
/// state gives the same bits.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Diagnostics {
    /// The number of particles.
    pub particles: u64,
    /// How many have left through openings.
    pub left: u64,
    /// The sum of m v^2 / 2, in J.
    pub kinetic_energy: f64,
    /// The sum of m g z, in J.
    pub potential_energy: f64,
    /// The energy of the springs in contacts, k_n delta^2 / 2 each, in J. A wall counts as often as it acts.
    pub elastic_energy: f64,
    /// The sum of m v, in kg m/s.
    pub momentum: [f64; 3],
    /// The largest speed, in m/s.
    pub largest_speed: f64,
    /// The number of pairs of particles in contact.
    pub contacts: u64,
    /// The number of contacts of a particle with a wall, however often that wall acts.
    pub wall_contacts: u64,
    /// The largest overlap of two particles, or of a particle with a wall, in m.
    pub largest_overlap: f64,
    /// The most slots in use in a cell, BOUNDARY slots among them: what N must hold.
    pub largest_occupancy: u32,
    /// The most particles in a cell.
    pub most_particles_in_cell: u32,
}

impl Diagnostics {
    /// Measures a state of a model with this wall law.
    ///
    /// # Errors
    /// Where the model is not CADEM.
    pub fn of(state: &State<'_>, walls: Walls) -> Result<Self, StateError> {
        let material: Material = state.parameters()?;
        let items = state.items::<Dem>()?;
        let geometry = state.geometry();
        let mut result = Self {
            particles: 0,
            left: state.count_left::<Dem>()?,
            kinetic_energy: 0.0,
            potential_energy: 0.0,
            elastic_energy: 0.0,
            momentum: [0.0; 3],
            largest_speed: 0.0,
            contacts: 0,
            wall_contacts: 0,
            largest_overlap: 0.0,
            largest_occupancy: state.largest_occupancy::<Dem>()?,
            most_particles_in_cell: 0,
        };
        result.add_motion(&material, &items);
        result.add_contacts(&material, geometry, &items);
        result.add_wall_contacts(&material, geometry, walls, &items);
        Ok(result)
    }

    /// Kinetic, potential and elastic energy together, in J, which only damping and the integrator change.
    pub fn total_energy(&self) -> f64 {
        self.kinetic_energy + self.potential_energy + self.elastic_energy
    }

    /// The names of [`Self::values`], for the header of a table.
    pub const NAMES: [&'static str; 15] = [
        "particles",
        "left",
        "kinetic_energy",
        "potential_energy",
        "elastic_energy",
        "total_energy",
        "momentum_x",
        "momentum_y",
        "momentum_z",
        "largest_speed",
        "contacts",
        "wall_contacts",
        "largest_overlap",
        "largest_occupancy",
        "most_particles_in_cell",
    ];

    /// All numbers, in SI units, in the order of [`Self::NAMES`].
    pub fn values(&self) -> [f64; 15] {
        let [x, y, z] = self.momentum;
        [
            self.particles as f64,
            self.left as f64,
            self.kinetic_energy,
            self.potential_energy,
            self.elastic_energy,
            self.total_energy(),
            x,
            y,
            z,
            self.largest_speed,
            self.contacts as f64,
            self.wall_contacts as f64,
            self.largest_overlap,
            f64::from(self.largest_occupancy),
            f64::from(self.most_particles_in_cell),
        ]
    }

    fn add_motion(&mut self, material: &Material, items: &[Item<Dem>]) {
        let (mut squares, mut heights, mut velocities) = (0.0, 0.0, Vector3::splat(0.0));
        let (mut cell, mut in_cell) = (None, 0);
        for item in particles(items) {
            let square = item.state.velocity.length_squared();
            squares += square;
            heights += item.state.position.z;
            velocities += item.state.velocity;
            self.particles += 1;
            self.largest_speed = self.largest_speed.max(square.sqrt());
            in_cell = if cell == Some(item.cell) { in_cell + 1 } else { 1 };
            cell = Some(item.cell);
            self.most_particles_in_cell = self.most_particles_in_cell.max(in_cell);
        }
        self.kinetic_energy = 0.5 * material.mass * squares;
        self.potential_energy = material.mass * material.gravity * heights;
        self.momentum = array(velocities * material.mass);
    }

    fn add_contacts(&mut self, material: &Material, geometry: &Geometry, items: &[Item<Dem>]) {
        let positions: Vec<[f64; 3]> = particles(items).map(|item| array(item.state.position)).collect();
        let sides = geometry.extents().map(|extent| extent as f64 * geometry.side());
        let diameter = 2.0 * material.radius;
        Near::new(sides, geometry.side().max(diameter), &positions).pairs_within(
            diameter,
            |_, _, distance| {
                self.contacts += 1;
                self.add_spring(material, diameter - distance, 1);
            },
        );
    }

    fn add_wall_contacts(
        &mut self,
        material: &Material,
        geometry: &Geometry,
        walls: Walls,
        items: &[Item<Dem>],
    ) {
        let mut points: [Option<Vector3<f64>>; 6] = [None; 6];
        let mut pieces: HashSet<([usize; 3], u8)> = HashSet::new();
        for item in items.iter().filter(|item| item.state.id == BOUNDARY) {
            pieces.insert((item.cell, item.state.face));
            if let Some(point) = points.get_mut(usize::from(item.state.face)) {
                *point = Some(item.state.position);
            }
        }
        for item in particles(items) {
            for (face, point) in (0_u8..).zip(&points) {
                let Some(point) = point else { continue };
                let overlap = wall_overlap(material, face, item.state.position - *point);
                if overlap <= 0.0 {
                    continue;
                }
                let acting = match walls {
                    Walls::Single => usize::from(pieces.contains(&(item.cell, face))),
                    Walls::PerSlot => (geometry.neighbourhood().displacements(item.cell).iter())
                        .filter_map(|displacement| geometry.at(item.cell, *displacement))
                        .filter(|&cell| pieces.contains(&(cell, face)))
                        .count(),
                };
                if acting > 0 {
                    self.wall_contacts += 1;
                    self.add_spring(material, overlap, acting);
                }
            }
        }
    }

    fn add_spring(&mut self, material: &Material, overlap: f64, times: usize) {
        self.elastic_energy += 0.5 * material.stiffness * overlap * overlap * times as f64;
        self.largest_overlap = self.largest_overlap.max(overlap);
    }
}

fn particles(items: &[Item<Dem>]) -> impl Iterator<Item = &Item<Dem>> {
    items.iter().filter(|item| item.state.id == PARTICLE)
}
