//! Operations of floats that can be replaced.

/// What operations are replaced by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(in crate::device) enum Manner {
    /// Correctly rounded results, made of the driver's own and of exact `+ - *`.
    Corrected,
    /// Results that are off in the last digits, or wrong at the edges, as some drivers give them. For tests.
    Rough,
}

impl Manner {
    /// What the names of the functions begin with that stand for operations.
    pub(super) fn prefix(self) -> &'static str {
        match self {
            Self::Corrected => "corrected_",
            Self::Rough => "rough_",
        }
    }
}

/// What an operation does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kind {
    Quotient,
    Root,
    Truncation,
    Floor,
    Ceiling,
}

/// An operation of floats.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Operation {
    pub(super) kind: Kind,
    /// The bytes of a float.
    pub(super) width: u8,
    /// How many floats at once.
    pub(super) lanes: u8,
}
