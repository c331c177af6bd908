//! The attributes of functions.

/// Which attribute stands on the function.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Wanted {
    Process,
    Migration,
    Helper,
}

impl Wanted {
    /// The attribute.
    pub(crate) fn attribute(self) -> &'static str {
        match self {
            Self::Process => "#[elementary_process]",
            Self::Migration => "#[migration]",
            Self::Helper => "#[helper]",
        }
    }
}
