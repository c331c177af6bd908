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
        problem: String,
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
    /// `dx` and `dy` that differ.
    #[error("{}: the cells are not square: dx is {dx} and dy {dy}; resample the grid to square cells", path.display())]
    NotSquare {
        /// The file.
        path: PathBuf,
        /// The side along x.
        dx: f64,
        /// The side along y.
        dy: f64,
    },
    /// The side of a cell is given twice.
    #[error("{}: the header gives cellsize, and dx or dy; keep one of them", path.display())]
    TwoSides {
        /// The file.
        path: PathBuf,
    },
    /// The file begins with numbers.
    #[error(
        "{}: the grid has no header; put the lines ncols, nrows, xllcorner, yllcorner and cellsize before its \
         numbers (docs/maps.md, \"Grids without a header\")",
        path.display()
    )]
    NoHeader {
        /// The file.
        path: PathBuf,
    },
    /// A grid without a header that has other rows or columns than the model.
    #[error(
        "{}{}: the grid has no header, and {found}, not {wanted} as the model",
        path.display(), line.map(|line| format!(":{line}")).unwrap_or_default()
    )]
    Matrix {
        /// The file.
        path: PathBuf,
        /// The line, where one is to blame.
        line: Option<u64>,
        /// What it has, in words.
        found: String,
        /// How many there should be.
        wanted: usize,
    },
    /// A number that is infinite, or beyond what a floating number can be.
    #[error("{}:{line}: `{text}` is not a finite number", path.display())]
    Infinite {
        /// The file.
        path: PathBuf,
        /// The line.
        line: u64,
        /// The text.
        text: String,
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
