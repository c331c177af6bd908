//! Why a report cannot be made.

use xca_io::atomic::WriteError;

/// A report that cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A file cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// The library that draws says why.
    #[error("a plot cannot be drawn: {0}")]
    Plot(String),
    /// JSON.
    #[error("the result cannot be written as JSON")]
    Json(#[from] serde_json::Error),
    /// CSV.
    #[error("a table cannot be written as CSV")]
    Csv(#[from] csv::Error),
}
