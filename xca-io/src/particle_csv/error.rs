//! Errors of particle files.

use std::io;
use std::num::{ParseFloatError, ParseIntError};
use std::path::PathBuf;

use super::super::atomic::WriteError;

/// Particles that cannot be written to a file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WriteParticlesError {
    /// A column has more or fewer values than there are labels.
    #[error("cannot write {}: column `{column}` has {found} values for {labels} labels", path.display())]
    ColumnLength {
        /// The file.
        path: PathBuf,
        /// The column.
        column: String,
        /// The number of its values.
        found: usize,
        /// The number of labels.
        labels: usize,
    },
    /// Two particles have the same label.
    #[error("cannot write {}: two particles have the label {label}", path.display())]
    DuplicateLabel {
        /// The file.
        path: PathBuf,
        /// The label.
        label: u32,
    },
    /// The system returned an error.
    #[error(transparent)]
    Write(#[from] WriteError),
}

/// A particle file that cannot be read, or that holds impossible values.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The file does not exist or is not readable.
    #[error("cannot open the particle file {}", path.display())]
    Open {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// Reading stopped early.
    #[error("cannot read the particle file {} to its end", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// The header lacks a column.
    #[error("{}:{line}: the header has no column `{column}`; it must be `{expected}`, in any order", path.display())]
    MissingColumn {
        /// The file.
        path: PathBuf,
        /// The line of the header.
        line: u64,
        /// The column.
        column: String,
        /// The required columns.
        expected: String,
    },
    /// The header has an unknown column.
    #[error("{}:{line}: unknown column `{column}` in the header; it must be `{expected}`, in any order", path.display())]
    UnknownColumn {
        /// The file.
        path: PathBuf,
        /// The line of the header.
        line: u64,
        /// The column.
        column: String,
        /// The allowed columns.
        expected: String,
    },
    /// The header has a column twice.
    #[error("{}:{line}: the column `{column}` appears twice in the header", path.display())]
    RepeatedColumn {
        /// The file.
        path: PathBuf,
        /// The line of the header.
        line: u64,
        /// The column.
        column: String,
    },
    /// A row is longer or shorter than the header.
    #[error("{}:{line}: {found} fields in this row, {expected} in the header", path.display())]
    FieldCount {
        /// The file.
        path: PathBuf,
        /// The line.
        line: u64,
        /// The number of fields in the header.
        expected: usize,
        /// The number of fields in the row.
        found: usize,
    },
    /// A label is not a whole number from 0 to 4294967295.
    #[error("{}:{line}: the label `{text}` is not a whole number from 0 to {}", path.display(), u32::MAX)]
    Label {
        /// The file.
        path: PathBuf,
        /// The line.
        line: u64,
        /// The text of the field.
        text: String,
        /// The error of the parser.
        source: ParseIntError,
    },
    /// A value is not a number.
    #[error("{}:{line}: `{text}` in column `{column}` is not a number", path.display())]
    Number {
        /// The file.
        path: PathBuf,
        /// The line.
        line: u64,
        /// The column.
        column: String,
        /// The text of the field.
        text: String,
        /// The error of the parser.
        source: ParseFloatError,
    },
    /// A value is infinite, not a number, or beyond the range of `f64`.
    #[error("{}:{line}: `{text}` in column `{column}` is not a finite number", path.display())]
    NotFinite {
        /// The file.
        path: PathBuf,
        /// The line.
        line: u64,
        /// The column.
        column: String,
        /// The text of the field.
        text: String,
    },
    /// A value is not of the type of its column.
    #[error("{}:{line}: `{text}` in column `{column}` {wanted}", path.display())]
    Value {
        /// The file.
        path: PathBuf,
        /// The line.
        line: u64,
        /// The column.
        column: String,
        /// The text of the field.
        text: String,
        /// The requirement of the type.
        wanted: String,
    },
    /// Two rows have the same label.
    #[error("{}:{line}: the label {label} stands on line {first} already", path.display())]
    DuplicateLabel {
        /// The file.
        path: PathBuf,
        /// The line of the second row.
        line: u64,
        /// The line of the first row.
        first: u64,
        /// The label.
        label: u32,
    },
}
