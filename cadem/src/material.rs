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
    /// How long two particles are in contact when they collide, in s: pi / w with w^2 = k_n / m_eff - b^2, where m_eff is m / 2
    /// and b is eta / (2 m_eff). Damping that lets them creep apart counts as none.
    pub fn contact_duration(&self) -> f64 {
        let effective_mass = self.mass / 2.0;
        let undamped = self.stiffness / effective_mass;
        let square = undamped - (self.damping / (2.0 * effective_mass)).powi(2);
        PI / if square > 0.0 { square } else { undamped }.sqrt()
    }
}
