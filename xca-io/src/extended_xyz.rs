//! Extended XYZ (`.xyz`): particles as text, for OVITO, ASE and similar programs.
//!
//! A frame is a line with the number of particles, a line of keys, and a line for each particle. The keys
//! are:
//!
//! - `Lattice`: the sides of the space
//! - `Origin`: its lower corner
//! - `Properties`: name, type and width of each column
//! - `pbc`: which axes are periodic
//! - `Time`: the simulated time
//!
//! The first column is `pos`. OVITO recognizes the columns `id` and `radius`.
//!
//! Numbers have enough digits to read back exactly. ASE accepts integers up to 2147483647.
//!
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let temporary = tempfile::tempdir()?;
//! # let path = temporary.path().join("spheres.xyz");
//! use xca_io::extended_xyz::{self, Column, Space, Values};
//!
//! let space = Space { origin: [0.0; 3], sides: [2.0, 2.0, 4.0], periodic: [true, true, false] };
//! let positions = [[0.5, 0.5, 1.0], [1.5, 1.0, 3.0]];
//! let columns = [
//!     Column::new("id", 1, Values::Whole(&[1, 2])),
//!     Column::new("velocity", 3, Values::F64(&[0.0, 0.0, -1.0, 0.0, 0.0, -2.0])),
//! ];
//! extended_xyz::write(&path, 0.25, Some(&space), &positions, &columns)?;
//! let frame = &extended_xyz::read(&path)?[0];
//! assert_eq!((frame.time, &frame.positions[..]), (Some(0.25), &positions[..]));
//! # Ok(())
//! # }
//! ```

mod comment;
mod error;
mod read;
mod space;

pub use error::{ReadXyzError, WriteXyzError};
pub use read::{ReadColumn, ReadFrame, ReadValues, read};
pub use space::Space;

use super::atomic::write_atomically;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// The column of the positions.
const POSITIONS: &str = "pos";

/// A column in addition to the positions.
#[derive(Debug, Clone, Copy)]
pub struct Column<'a> {
    name: &'a str,
    components: usize,
    values: Values<'a>,
}

impl<'a> Column<'a> {
    /// A column with `components` values per particle, one particle after the other.
    pub fn new(name: &'a str, components: usize, values: Values<'a>) -> Self {
        Self { name, components, values }
    }
}

/// The values of a column.
#[derive(Debug, Clone, Copy)]
pub enum Values<'a> {
    /// `f64` numbers.
    F64(&'a [f64]),
    /// `f32` numbers, with fewer digits.
    F32(&'a [f32]),
    /// Integers.
    Whole(&'a [i64]),
    /// Truth values, written as `T` and `F`.
    Bool(&'a [bool]),
    /// Words without blanks, such as the names of states.
    Text(&'a [&'a str]),
}

impl Values<'_> {
    fn len(&self) -> usize {
        match self {
            Self::F64(values) => values.len(),
            Self::F32(values) => values.len(),
            Self::Whole(values) => values.len(),
            Self::Bool(values) => values.len(),
            Self::Text(values) => values.len(),
        }
    }

    /// The letter of the type.
    fn letter(&self) -> char {
        match self {
            Self::F64(_) | Self::F32(_) => 'R',
            Self::Whole(_) => 'I',
            Self::Bool(_) => 'L',
            Self::Text(_) => 'S',
        }
    }

    fn write(&self, out: &mut impl Write, index: usize) -> io::Result<()> {
        match self {
            Self::F64(values) => write!(out, " {:?}", values[index]),
            Self::F32(values) => write!(out, " {:?}", values[index]),
            Self::Whole(values) => write!(out, " {}", values[index]),
            Self::Bool(values) => write!(out, " {}", if values[index] { 'T' } else { 'F' }),
            Self::Text(values) => write!(out, " {}", values[index]),
        }
    }

    /// The first text that is not a single word.
    fn first_broken(&self) -> Option<&str> {
        let Self::Text(values) = self else { return None };
        values.iter().copied().find(|text| !is_word(text))
    }
}

/// Whether every reader takes a text as one word: it has no blanks, quotes or brackets.
fn is_word(text: &str) -> bool {
    let is_plain =
        |letter: char| !letter.is_whitespace() && !letter.is_control() && !"\"'=:{}[]\\".contains(letter);
    !text.is_empty() && text.chars().all(is_plain)
}

/// Writes one frame. The file appears complete or not at all.
///
/// `positions` has one entry per particle. Every column has one value per particle and component, in the same
/// order. `time` and `space` use the units of the positions. Values that are not finite are written as `NaN`,
/// `inf` and `-inf`, so that a broken state can be inspected.
///
/// # Errors
/// [`WriteXyzError`], each with the path.
pub fn write(
    path: &Path,
    time: f64,
    space: Option<&Space>,
    positions: &[[f64; 3]],
    columns: &[Column<'_>],
) -> Result<(), WriteXyzError> {
    check_names(path, columns)?;
    check(path, positions.len(), columns)?;
    write_rows(path, time, space, (positions.len(), columns), |rows| rows.add(positions, columns))
}

/// Writes one frame of particles that need not be in memory as a whole. `shape` has the number of particles,
/// and columns with the names and types of all, whose values do not matter. `give` adds the particles.
///
/// # Errors
/// [`WriteXyzError`], also with an error of `give`.
pub fn write_rows(
    path: &Path,
    time: f64,
    space: Option<&Space>,
    (particles, columns): (usize, &[Column<'_>]),
    give: impl FnOnce(&mut Rows<'_>) -> io::Result<()>,
) -> Result<(), WriteXyzError> {
    check_names(path, columns)?;
    write_atomically(path, |file| {
        write!(file, "{particles}\n{}", comment::lattice(space))?;
        write!(file, "Properties={POSITIONS}:R:3")?;
        for column in columns {
            write!(file, ":{}:{}:{}", column.name, column.values.letter(), column.components)?;
        }
        writeln!(file, " Time={time:?}")?;
        give(&mut Rows { file })
    })?;
    Ok(())
}

/// The rows of a frame that is written.
#[derive(Debug)]
pub struct Rows<'a> {
    file: &'a mut BufWriter<File>,
}

impl Rows<'_> {
    /// Adds particles. Each column has one value per particle and component.
    ///
    /// # Errors
    /// If the system returns an error.
    pub fn add(&mut self, positions: &[[f64; 3]], columns: &[Column<'_>]) -> io::Result<()> {
        for (particle, [x, y, z]) in positions.iter().enumerate() {
            write!(self.file, "{x:?} {y:?} {z:?}")?;
            for column in columns {
                for component in 0..column.components {
                    column.values.write(self.file, particle * column.components + component)?;
                }
            }
            writeln!(self.file)?;
        }
        Ok(())
    }
}

fn check_names(path: &Path, columns: &[Column<'_>]) -> Result<(), WriteXyzError> {
    for (number, column) in columns.iter().enumerate() {
        let named = || (path.to_owned(), column.name.to_owned());
        if !is_word(column.name) {
            let (path, column) = named();
            return Err(WriteXyzError::Name { path, column });
        }
        let is_repeated = columns[..number].iter().any(|other| other.name == column.name);
        if is_repeated || column.name == POSITIONS {
            let (path, column) = named();
            return Err(WriteXyzError::Repeated { path, column });
        }
    }
    Ok(())
}

fn check(path: &Path, particles: usize, columns: &[Column<'_>]) -> Result<(), WriteXyzError> {
    for column in columns {
        let named = || (path.to_owned(), column.name.to_owned());
        let wanted = particles.saturating_mul(column.components);
        if column.components == 0 || column.values.len() != wanted {
            let (path, name) = named();
            let (found, components) = (column.values.len(), column.components);
            return Err(WriteXyzError::Length { path, column: name, found, particles, components });
        }
        if let Some(text) = column.values.first_broken() {
            let (path, column) = named();
            return Err(WriteXyzError::Text { path, column, text: text.to_owned() });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
