//! The names of what a run and other commands leave in their folders.

/// The folder, below the run's own, that holds the frames.
pub const FRAMES: &str = "frames";

/// The report, by which a folder is known to be a run's.
pub const REPORT: &str = "run.json";

/// The report of a comparison of engines.
pub const COMPARISON: &str = "compare.json";

/// The report of an ensemble.
pub const ENSEMBLE: &str = "sweep.json";

/// The time series.
pub(crate) const SERIES: &str = "observables.csv";
