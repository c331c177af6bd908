//! How a command ends.

use xca_record::Failure;

/// How a command ended that did what it was asked to.
pub(super) enum Ended {
    Done,
    Interrupted,
    /// Engines that are compared do not agree.
    Different,
}

/// Why a command did not.
#[derive(Debug)]
pub(super) enum Unable {
    /// Nothing was run.
    Refused(Failure),
    /// Nothing was run, but this would do.
    RefusedOffering(Failure, String),
    /// The run failed.
    Failed(Failure),
    /// The run failed, and this is left of it.
    FailedLeaving(Failure, String),
    /// The parser of the command line says why, or shows the help that was asked for.
    CommandLine(clap::Error),
}

impl Unable {
    pub(super) fn refused(error: impl Into<Failure>) -> Self {
        Self::Refused(error.into())
    }

    /// What went wrong, where others tell it.
    pub(super) fn into_failure(self) -> Failure {
        match self {
            Self::Refused(error)
            | Self::RefusedOffering(error, _)
            | Self::Failed(error)
            | Self::FailedLeaving(error, _) => error,
            Self::CommandLine(error) => error.into(),
        }
    }

    pub(super) fn failed(error: impl Into<Failure>) -> Self {
        Self::Failed(error.into())
    }
}
