//! Errors of ASCII grids.

use crate::placement::CoarsePlace;
use std::io;
use std::num::ParseFloatError;
use std::path::PathBuf;

/// A grid that cannot be read, or that holds impossible values.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadGridError {
    /// The file does not exist or is not readable.
    #[error("cannot open the grid {}", path.display())]
    Open {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// Reading stopped early, or the file is not text.
    #[error("{}:{line}: cannot read the grid on", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The line.
        line: u64,
        /// The system's error.
        source: io::Error,
    },
    /// A key of the header has an invalid value.
    #[error("{}:{line}: `{key}` {problem}", path.display())]
    Key {
        /// The file.
        path: PathBuf,
        /// The line.
        line: u64,
        /// The key as the file spells it.
        key: String,
        /// The problem.
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
    /// `dx` and `dy` differ.
    #[error("{}: the cells are not square: dx is {dx} and dy {dy}; resample the grid to square cells", path.display())]
    NotSquare {
        /// The file.
        path: PathBuf,
        /// The side along x.
        dx: f64,
        /// The side along y.
        dy: f64,
    },
    /// The header gives the side of a cell twice.
    #[error("{}: the header gives cellsize, and dx or dy; keep one of them", path.display())]
    TwoSides {
        /// The file.
        path: PathBuf,
    },
    /// The header gives a place too far from the origin.
    #[error("{}: {problem}", path.display())]
    Place {
        /// The file.
        path: PathBuf,
        /// The coordinate.
        problem: CoarsePlace,
    },
    /// The file begins with numbers instead of a header.
    #[error(
        "{}: the grid has no header; put the lines ncols, nrows, xllcorner, yllcorner and cellsize before its \
         numbers (docs/maps.md, \"Grids without a header\")",
        path.display()
    )]
    NoHeader {
        /// The file.
        path: PathBuf,
    },
    /// A grid without a header has other rows or columns than the model.
    #[error(
        "{}{}: the grid has no header, and {found}, not {wanted} as the model",
        path.display(), line.map(|line| format!(":{line}")).unwrap_or_default()
    )]
    Matrix {
        /// The file.
        path: PathBuf,
        /// The line with the error, if there is one.
        line: Option<u64>,
        /// The number found, with its unit.
        found: String,
        /// The number expected.
        wanted: usize,
    },
    /// A number is infinite or beyond the range of `f64`.
    #[error("{}:{line}: `{text}` is not a finite number", path.display())]
    Infinite {
        /// The file.
        path: PathBuf,
        /// The line.
        line: u64,
        /// The text.
        text: String,
    },
    /// A text is not a number.
    #[error("{}:{line}: `{text}` is not a number", path.display())]
    Number {
        /// The file.
        path: PathBuf,
        /// The line.
        line: u64,
        /// The text.
        text: String,
        /// The error of the parser.
        source: ParseFloatError,
    },
    /// The number of values differs from the number of cells.
    #[error(
        "{}{}: {found} values, but {} columns and {} rows have {cells} cells",
        path.display(), line.map(|line| format!(":{line}")).unwrap_or_default(), extents[0], extents[1]
    )]
    Count {
        /// The file.
        path: PathBuf,
        /// The line of the first surplus value.
        line: Option<u64>,
        /// Columns and rows.
        extents: [usize; 2],
        /// The number of cells.
        cells: usize,
        /// The number of values, as text.
        found: String,
    },
}
