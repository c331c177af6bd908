//! Errors of extended XYZ.

use crate::atomic::WriteError;
use std::io;
use std::path::PathBuf;

/// A frame that cannot be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WriteXyzError {
    /// The file.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A name is more than one word.
    #[error(
        "cannot write {}: the column name `{}` must be one word without `:`",
        path.display(), column.escape_debug()
    )]
    Name {
        /// The file.
        path: PathBuf,
        /// The name.
        column: String,
    },
    /// Two columns have the same name.
    #[error("cannot write {}: two columns are named `{column}`", path.display())]
    Repeated {
        /// The file.
        path: PathBuf,
        /// The name.
        column: String,
    },
    /// A column has the wrong length.
    #[error(
        "cannot write {}: column `{column}` has {found} values for {particles} particles of {components} \
         components",
        path.display()
    )]
    Length {
        /// The file.
        path: PathBuf,
        /// The column.
        column: String,
        /// The number of its values.
        found: usize,
        /// The number of particles.
        particles: usize,
        /// The number of components of the column.
        components: usize,
    },
    /// A text is more than one word.
    #[error(
        "cannot write {}: `{}` in column `{column}` must be one word",
        path.display(), text.escape_debug()
    )]
    Text {
        /// The file.
        path: PathBuf,
        /// The column.
        column: String,
        /// The text.
        text: String,
    },
}

/// A file that cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadXyzError {
    /// The file does not exist or is not readable.
    #[error("cannot open the particles {}", path.display())]
    Open {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// Reading stopped early, or the file is not text.
    #[error("{}:{line}: cannot read the particles on", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The line.
        line: u64,
        /// The system's error.
        source: io::Error,
    },
    /// A line is invalid.
    #[error("{}:{line}: {problem}", path.display())]
    Line {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: u64,
        /// The problem.
        problem: String,
    },
}
