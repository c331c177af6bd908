//! The verdict on an engine.

use serde::Serialize;
use std::fmt;

/// The verdict on an engine, from best to worst.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "UPPERCASE")]
pub enum Verdict {
    /// All bits are equal at every check.
    Identical,
    /// Only floating-point numbers differ, by at most the tolerance.
    Rounding,
    /// Other differences.
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
