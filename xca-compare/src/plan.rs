//! The settings of a comparison, and its monitor.

use super::error::CompareError;
use xca_record::Monitor;

/// The settings of a comparison.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plan {
    pub(super) seed: u64,
    pub(super) steps: u64,
    pub(super) every: u64,
    pub(super) repeats: usize,
    pub(super) tolerance: f64,
}

/// The monitor of a comparison, and the steps done by all engines.
pub(super) struct Watch<'a> {
    pub(super) monitor: &'a mut dyn Monitor,
    pub(super) done: u64,
}

impl Watch<'_> {
    /// Counts `steps` more steps.
    pub(super) fn did(&mut self, steps: u64) -> Result<(), CompareError> {
        self.done += steps;
        self.monitor.at(self.done);
        if self.monitor.is_interrupted() { Err(CompareError::Interrupted) } else { Ok(()) }
    }
}
