//! What is thought of an engine's results.

use serde::Serialize;
use std::fmt;

/// From best to worst.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "UPPERCASE")]
pub enum Verdict {
    /// All bits are the same, at every check.
    Identical,
    /// Floating numbers differ at the end by no more than the tolerance.
    Rounding,
    /// Anything else.
    Different,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Identical => "IDENTICAL",
            Self::Rounding => "ROUNDING",
            Self::Different => "DIFFERENT",
        })
    }
}
