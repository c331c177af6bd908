//! Why a comparison does not come to its end.

use xca_core::RunError;
use xca_record::machine::NotEnoughMemory;
use xca_record::record::RecordError;

/// A comparison that does not come to its end.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CompareError {
    /// An engine cannot run the model, or the first one fails.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The observables cannot be measured.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// The machine has no room for the model on all engines at once.
    #[error(transparent)]
    Memory(#[from] NotEnoughMemory),
    /// Its monitor said so.
    #[error("interrupted")]
    Interrupted,
}
