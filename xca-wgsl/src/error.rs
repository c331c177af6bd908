//! What can go wrong.

/// A process that cannot be written in WGSL.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("the process `{process}` cannot be written in WGSL: {}{problem}", self.place())]
pub struct Error {
    /// The process.
    pub process: String,
    /// The helper in which the problem lies, or the process again.
    pub function: String,
    /// The problem.
    pub problem: Problem,
}

/// Why a process cannot be written in WGSL.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// Something has no counterpart in WGSL.
    #[error("{construct}: {reason}")]
    Unsupported {
        /// What it is.
        construct: String,
        /// Why not, and what to write instead.
        reason: String,
    },
    /// Two types that must be the same are not.
    #[error("{construct} needs `{expected}` but has `{found}`")]
    Types {
        /// Where.
        construct: String,
        /// The type that is needed.
        expected: String,
        /// The type that is there.
        found: String,
    },
    /// The body names something that is not there.
    #[error("there is no {kind} `{name}`")]
    Unknown {
        /// What kind of thing it names.
        kind: &'static str,
        /// The name.
        name: String,
    },
    /// A helper was given where a process is needed.
    #[error("it is a helper, not a process")]
    NotAProcess,
    /// The options cannot be met.
    #[error("{0}")]
    Options(String),
}

impl Error {
    fn place(&self) -> String {
        if self.function == self.process { String::new() } else { format!("in `{}`: ", self.function) }
    }
}

impl Problem {
    pub(crate) fn unsupported(construct: impl Into<String>, reason: impl Into<String>) -> Self {
        Self::Unsupported { construct: construct.into(), reason: reason.into() }
    }

    pub(crate) fn unknown(kind: &'static str, name: &str) -> Self {
        Self::Unknown { kind, name: name.to_owned() }
    }
}
