//! Why a folder cannot be written to.

use super::Kind;
use crate::report::ReadReportError;
use std::io;
use std::path::PathBuf;
use xca_io::atomic::WriteError;

/// A folder that a command must not or cannot write to.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages explain the fields")]
#[non_exhaustive]
pub enum FolderError {
    #[error(transparent)]
    Write(#[from] WriteError),
    #[error("{}; move it or give another directory with --out", .0)]
    Report(#[source] ReadReportError),
    #[error(
        "{} holds `{file}`, which is not from an earlier {}; move it or give another directory with --out",
        folder.display(),
        kind.noun()
    )]
    Foreign { folder: PathBuf, file: String, kind: Kind },
    #[error(
        "{} holds a {}, which this would overwrite; give another directory with --out",
        folder.display(),
        kind.noun()
    )]
    Taken { folder: PathBuf, kind: Kind },
    #[error(
        "{} holds a run of `{program}`, which this would overwrite; give another directory with --out",
        folder.display()
    )]
    OtherProgram { folder: PathBuf, program: String },
    #[error(
        "{} holds an unfinished run with checkpoints; resume it, overwrite it with --overwrite, or give \
         another directory with --out",
        folder.display()
    )]
    Unfinished { folder: PathBuf },
    #[error(
        "the run starts from {}, which it would overwrite; move it or give another directory with --out",
        file.display()
    )]
    Input { file: PathBuf },
    #[error("another run is writing to {}", folder.display())]
    InUse { folder: PathBuf },
    #[error("cannot remove {}, left by an earlier run", path.display())]
    Remove { path: PathBuf, source: io::Error },
}
