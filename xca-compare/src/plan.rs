//! How engines are compared, and who watches.

use super::error::CompareError;
use xca_record::Monitor;

/// How engines are compared.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plan {
    pub(super) seed: u64,
    pub(super) steps: u64,
    pub(super) every: u64,
    pub(super) repeats: usize,
    pub(super) tolerance: f64,
}

/// Who watches a comparison, and how many steps all engines have done.
pub(super) struct Watch<'a> {
    pub(super) monitor: &'a mut dyn Monitor,
    pub(super) done: u64,
}

impl Watch<'_> {
    /// So many steps more are done.
    pub(super) fn did(&mut self, steps: u64) -> Result<(), CompareError> {
        self.done += steps;
        self.monitor.at(self.done);
        if self.monitor.is_interrupted() { Err(CompareError::Interrupted) } else { Ok(()) }
    }
}
