//! The check for NaN and infinities before a state is written.

use crate::failure::Failure;
use xca_core::{Fault, RunError, Simulation};

/// A state that should not be written.
#[derive(Debug, thiserror::Error)]
#[error(
    "{0}; add --allow-non-finite to continue, or `.allow_non_finite(…)` to a model that allows such values"
)]
struct NonFinite(RunError);

pub fn check(simulation: &Simulation) -> Result<(), Failure> {
    simulation.check_finite().map_err(|error| match error {
        RunError::Fault { fault: Fault::NotFinite { .. }, .. } => NonFinite(error).into(),
        other => other.into(),
    })
}
