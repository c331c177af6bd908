//! What a folder is for, and the report by which it is known.

use super::{COMPARISON, ENSEMBLE, REPORT};

/// What a folder is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Kind {
    Run,
    Pictures,
    Comparison,
    Ensemble,
}

impl Kind {
    /// The file by which a folder is known to be of this kind.
    pub(super) fn report(self) -> &'static str {
        match self {
            Self::Run | Self::Pictures => REPORT,
            Self::Comparison => COMPARISON,
            Self::Ensemble => ENSEMBLE,
        }
    }

    pub(super) fn noun(self) -> &'static str {
        match self {
            Self::Run => "run",
            Self::Pictures => "rendering",
            Self::Comparison => "comparison",
            Self::Ensemble => "sweep",
        }
    }
}
