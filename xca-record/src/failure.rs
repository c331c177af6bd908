//! Errors of any kind.

/// Any error. Its causes are shown below it, each on a line of its own.
pub type Failure = Box<dyn std::error::Error + Send + Sync>;
