//! Errors of comparisons.

use xca_core::RunError;
use xca_machine::NotEnoughMemory;
use xca_record::record::RecordError;

/// A comparison that cannot be completed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CompareError {
    /// An engine cannot run the model, or the first one fails.
    #[error(transparent)]
    Run(#[from] RunError),
    /// An observable cannot be measured.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// The model does not fit into memory on all engines at once.
    #[error(transparent)]
    Memory(#[from] NotEnoughMemory),
    /// The monitor interrupted the comparison.
    #[error("interrupted")]
    Interrupted,
}
