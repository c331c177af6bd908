//! What can go wrong with grids.

use std::io;
use std::num::ParseFloatError;
use std::path::PathBuf;

/// A grid that cannot be read, or says what cannot be.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadGridError {
    /// The file is not there or not readable.
    #[error("cannot open the grid {}", path.display())]
    Open {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// Reading broke off, or the file is no text.
    #[error("{}:{line}: cannot read the grid on", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The line.
        line: u64,
        /// What the system said.
        source: io::Error,
    },
    /// A key of the header that makes no sense.
    #[error("{}:{line}: `{key}` {problem}", path.display())]
    Key {
        /// The file.
        path: PathBuf,
        /// The line.
        line: u64,
        /// The key as it stands there.
        key: String,
        /// What is wrong with it.
        problem: &'static str,
    },
    /// The header lacks a key.
    #[error(
        "{}: the header of the grid has no `{key}`; it needs ncols, nrows, xllcorner, yllcorner and cellsize",
        path.display()
    )]
    MissingKey {
        /// The file.
        path: PathBuf,
        /// The key.
        key: &'static str,
    },
    /// A text that is no number.
    #[error("{}:{line}: `{text}` is not a number", path.display())]
    Number {
        /// The file.
        path: PathBuf,
        /// The line.
        line: u64,
        /// The text.
        text: String,
        /// Why it is none.
        source: ParseFloatError,
    },
    /// More or fewer values than cells.
    #[error(
        "{}{}: {found} values, but {} columns and {} rows have {cells} cells",
        path.display(), line.map(|line| format!(":{line}")).unwrap_or_default(), extents[0], extents[1]
    )]
    Count {
        /// The file.
        path: PathBuf,
        /// The line with the first value that is too much.
        line: Option<u64>,
        /// Columns and rows.
        extents: [usize; 2],
        /// How many cells that is.
        cells: usize,
        /// How many values there are, in words.
        found: String,
    },
}
