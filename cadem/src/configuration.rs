//! Everything that makes a run, but the particles.

use crate::error::CademError;
use crate::material::Material;
use crate::time_step::{Integrator, TimeStep};
use crate::walls::{Opening, Walls};
use crate::{Particle, initial};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;
use xca_core::{Parameters, Precision};

/// The least number of steps in a contact of two particles that needs no warning. The paper says 10 to 50 for
/// a particle at a wall (eq. 3), which are 7 to 35 for two particles.
const STEPS_OF_A_CONTACT: f64 = 20.0;

/// A CADEM system: space, material, walls, and how it is integrated. [`crate::Case`] has ready-made ones.
///
/// Read from a file, what is not given is as in [`crate::Case::Illustration`], and a name that is none of
/// these is an error.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Configuration {
    /// The number of cells along x, y, z.
    pub cells: [usize; 3],
    /// The cell side p_c, in m; at least two radii, so that all contacts are found in 27 cells.
    pub cell_side: f64,
    /// The contact stiffness k_n, in N/m.
    pub stiffness: f64,
    /// The contact damping eta, in kg/s.
    pub damping: f64,
    /// The mass of a particle, in kg.
    pub mass: f64,
    /// The radius of a particle p_r, in m.
    pub radius: f64,
    /// The acceleration of gravity along -z, in m/s^2.
    pub gravity: f64,
    /// The number of steps of a whole run.
    pub steps: u64,
    /// How walls act.
    pub walls: Walls,
    /// How velocity and position advance.
    pub integrator: Integrator,
    /// The slots of a cell N, BOUNDARY slots among them; [`Configuration::default_slots`] unless given. The
    /// paper has 11.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slots: Option<usize>,
    /// The seed of the authors' initial placement; theirs is 1.
    pub seed: u32,
    /// Whether particles may overlap at the start, as in the final state of another run.
    pub allow_overlaps: bool,
    /// How the time step is chosen.
    pub time_step: TimeStep,
    /// Holes in the walls.
    pub openings: Vec<Opening>,
}

impl Configuration {
    /// The parameters of the processes.
    pub fn material(&self) -> Material {
        Material {
            stiffness: self.stiffness,
            damping: self.damping,
            mass: self.mass,
            radius: self.radius,
            gravity: self.gravity,
            time_step: self.time_step.seconds(self.mass, self.stiffness),
        }
    }

    /// The same system with these parameters. A time step that is not the present one becomes
    /// [`TimeStep::Seconds`].
    #[must_use]
    pub fn with_material(&self, material: &Material) -> Self {
        let Material { stiffness, damping, mass, radius, gravity, time_step } = *material;
        let mut changed = Self { stiffness, damping, mass, radius, gravity, ..self.clone() };
        if time_step != self.material().time_step {
            changed.time_step = TimeStep::Seconds(time_step);
        }
        changed
    }

    /// Sets a parameter by name: one of [`Material`]'s. A time step that follows from mass and stiffness
    /// keeps following them; `time_step` sets it in s.
    ///
    /// ```
    /// let mut configuration = cadem::Case::Illustration.configuration();
    /// configuration.set("stiffness", "2000")?;
    /// assert_eq!(configuration.material().time_step, 0.1 * (1e-4_f64 / 2000.0).sqrt());
    /// configuration.set("time_step", "1e-5")?;
    /// assert_eq!(configuration.time_step, cadem::TimeStep::Seconds(1e-5));
    /// # Ok::<(), cadem::CademError>(())
    /// ```
    ///
    /// # Errors
    /// Where no parameter has the name, or the text is no number.
    pub fn set(&mut self, name: &str, text: &str) -> Result<(), CademError> {
        let mut material = self.material();
        material.set(name, text)?;
        *self = self.with_material(&material);
        Ok(())
    }

    /// The sides of the domain along x, y, z, in m. Its lower corner is the origin.
    pub fn sides(&self) -> [f64; 3] {
        self.cells.map(|cells| cells as f64 * self.cell_side)
    }

    /// The slots of a cell.
    pub fn slots(&self) -> usize {
        self.slots.unwrap_or_else(|| self.default_slots())
    }

    /// Kepler's bound on the particles in a cell, floor(0.74 p_c^3 / (4/3 pi p_r^3)): the paper's N (section
    /// II.C), 11 with its numbers.
    pub fn kepler_bound(&self) -> usize {
        (0.74 * self.cell_side.powi(3) / (4.0 / 3.0 * PI * self.radius.powi(3))) as usize
    }

    /// The slots of a cell unless they are given: twice Kepler's bound, and one for each domain face that a
    /// cell can touch.
    ///
    /// The bound counts whole spheres, while a cell holds all whose centres are in it; and soft spheres
    /// overlap. The paper's benchmark comes to 16 particles in a cell. In narrow cells, which the bound is
    /// worst for, there is room for a centre near each of the eight corners.
    pub fn default_slots(&self) -> usize {
        self.kepler_bound().saturating_mul(2).max(8).saturating_add(self.most_faces_of_a_cell())
    }

    /// The authors' initial state ([`initial::authors_placement`]) in this domain, with this seed.
    ///
    /// # Errors
    /// Where no particles can be placed in such a domain.
    pub fn authors_particles(&self) -> Result<Vec<Particle>, CademError> {
        let placed = initial::authors_placement(self.cells, self.cell_side, self.radius, self.seed)?;
        Ok(placed.into_iter().map(Particle::from).collect())
    }

    /// What makes the results of the system doubtful, in sentences: a time step that is too long for a
    /// contact, and `f32`, in which slow particles stand still.
    ///
    /// ```
    /// use xca_core::Precision;
    ///
    /// let mut configuration = cadem::Case::Illustration.configuration();
    /// assert!(configuration.warnings(Precision::F64).is_empty());
    /// configuration.set("time_step", "5e-5")?;
    /// assert!(configuration.warnings(Precision::F64)[0].contains("takes 5.0 steps"));
    /// # Ok::<(), cadem::CademError>(())
    /// ```
    pub fn warnings(&self, precision: Precision) -> Vec<String> {
        let material = self.material();
        // The shorter one asks for the shorter time step.
        let (of_pair, of_wall) =
            (material.contact_duration(), material.wall_contact_duration(self.walls.pieces()));
        let (contact, duration) =
            if of_wall < of_pair { ("a contact with a wall", of_wall) } else { ("a contact", of_pair) };
        let steps = duration / material.time_step;
        let is_short = steps < STEPS_OF_A_CONTACT;
        let warning = || {
            format!(
                "{contact} takes {steps:.1} steps; fewer than {STEPS_OF_A_CONTACT} give a wrong energy; \
                 a time step of {:.3e} s is small enough",
                duration / STEPS_OF_A_CONTACT
            )
        };
        let stands_still = || {
            format!(
                "in f32 a particle slower than about {:.1e} m/s along an axis does not move along it: a step \
                 changes its position by less than half of the last digit; use f64",
                self.lost_speed()
            )
        };
        let is_single = precision == Precision::F32;
        is_short.then(warning).into_iter().chain(is_single.then(stands_still)).collect()
    }

    /// The speed, in m/s, below which x + v dt is x in `f32` where x is largest: half of the distance to the
    /// next number, divided by the time step.
    fn lost_speed(&self) -> f64 {
        let side = self.sides().into_iter().fold(0.0, f64::max);
        let largest = (side as f32).next_down();
        f64::from(largest - largest.next_down()) / 2.0 / self.material().time_step
    }

    /// Checks that the system makes sense. [`crate::model()`] does it too.
    ///
    /// # Errors
    /// The first mistake that is found; its message says what to change.
    pub fn check(&self) -> Result<(), CademError> {
        self.material().check()?;
        let two_radii = 2.0 * self.radius;
        if !(two_radii..f64::INFINITY).contains(&self.cell_side) {
            return Err(CademError::CellSide { cell_side: self.cell_side, radius: self.radius });
        }
        if self.cells.contains(&0) {
            return Err(CademError::NoCells { cells: self.cells });
        }
        self.check_openings()?;
        self.check_boundary_slots()
    }
}

#[cfg(test)]
mod tests;
