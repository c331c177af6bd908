//! The parameters: P of De Rango et al., section II.C.

use serde::{Deserialize, Serialize};
use std::f64::consts::PI;
use xca_core::prelude::*;

/// What particles and walls are made of, and the step in time: the parameters of the processes.
///
/// The cell side p_c belongs to the cellular space, and N_t is a way to choose the time step
/// ([`crate::TimeStep::Subdivisions`]).
#[derive(Parameters, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// The contact stiffness k_n.
    #[parameter(unit = "N/m", range = ..f64::INFINITY, positive)]
    pub stiffness: Real,
    /// The contact damping eta.
    #[parameter(unit = "kg/s", range = 0.0..f64::INFINITY)]
    pub damping: Real,
    /// The mass of a particle m.
    #[parameter(unit = "kg", range = ..f64::INFINITY, positive)]
    pub mass: Real,
    /// The radius of a particle p_r.
    #[parameter(unit = "m", range = ..f64::INFINITY, positive)]
    pub radius: Real,
    /// The acceleration of gravity along -z.
    #[parameter(unit = "m/s2")]
    pub gravity: Real,
    /// The time step dt.
    #[parameter(unit = "s", range = ..f64::INFINITY, positive)]
    pub time_step: Real,
}

impl Material {
    /// How long two particles are in contact when they collide, in s: pi / w with w^2 = k_n / m_eff - b^2,
    /// where m_eff is m / 2 and b is eta / (2 m_eff). Damping that lets them creep apart counts as none.
    pub fn contact_duration(&self) -> f64 {
        self.duration(self.mass / 2.0, 1.0)
    }

    /// How long a particle is in contact with a wall of which so many pieces act at once, in s. The wall does
    /// not move, so m_eff is m, and k_n and eta count once for each piece.
    pub fn wall_contact_duration(&self, pieces: u32) -> f64 {
        self.duration(self.mass, f64::from(pieces))
    }

    /// Half a period of this mass on so many springs and dashpots, in s.
    fn duration(&self, effective_mass: f64, pieces: f64) -> f64 {
        let undamped = pieces * self.stiffness / effective_mass;
        let square = undamped - (pieces * self.damping / (2.0 * effective_mass)).powi(2);
        PI / if square > 0.0 { square } else { undamped }.sqrt()
    }
}
