//! The parameters: P of De Rango et al., section II.C.

use serde::{Deserialize, Serialize};
use xca_core::prelude::*;

/// What particles and walls are made of, and the step in time: the parameters of the processes.
///
/// The cell side p_c belongs to the cellular space, and N_t is a way to choose the time step
/// ([`crate::TimeStep::Subdivisions`]).
#[derive(Parameters, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// The contact stiffness k_n.
    #[parameter(unit = "N/m")]
    pub stiffness: Real,
    /// The contact damping eta.
    #[parameter(unit = "kg/s")]
    pub damping: Real,
    /// The mass of a particle m.
    #[parameter(unit = "kg")]
    pub mass: Real,
    /// The radius of a particle p_r.
    #[parameter(unit = "m")]
    pub radius: Real,
    /// The acceleration of gravity along -z.
    #[parameter(unit = "m/s2")]
    pub gravity: Real,
    /// The time step dt.
    #[parameter(unit = "s")]
    pub time_step: Real,
}
