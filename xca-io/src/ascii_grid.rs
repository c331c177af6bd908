//! ESRI ASCII grids (`.asc`): one number for each cell of a layer, with its place on the map.
//!
//! Every geographic information system reads and writes them. A header says how many columns and rows there are, where the south-west corner
//! lies, how long the side of a cell is, and which number stands for "no value here"; then come the rows, the northernmost first. Here, as in a
//! model, rows count from the south: `[0, 0]` is the cell in the south-west.

mod error;
mod header;
mod read;

pub use error::ReadGridError;

use super::atomic::{WriteError, write_atomically};
use super::map::{Map, Placement};
use std::io::Write;
use std::path::Path;

/// A layer of square cells, each with a number or without one.
#[derive(Debug, Clone, PartialEq)]
pub struct AsciiGrid {
    placement: Placement,
    /// x fastest, from the south; NaN where there is none.
    values: Vec<f64>,
}

impl AsciiGrid {
    /// A grid of so many columns and rows. `values` has one number for each cell, x fastest, from the south; one that is not a number stands
    /// for a cell without a value.
    ///
    /// The south-west corner is at 0, 0 unless [`AsciiGrid::with_corner`] says otherwise. Nothing where there are not as many values as cells, or
    /// the side is not a positive number.
    #[must_use]
    pub fn new(extents: [usize; 2], side: f64, values: Vec<f64>) -> Option<Self> {
        let cells = extents[0].checked_mul(extents[1])?;
        let fits = cells > 0 && values.len() == cells && side.is_finite() && side > 0.0;
        fits.then_some(Self { placement: Placement { extents, corner: [0.0; 2], side }, values })
    }

    /// The same grid with its south-west corner elsewhere.
    #[must_use]
    pub fn with_corner(self, corner: [f64; 2]) -> Self {
        Self { placement: Placement { corner, ..self.placement }, ..self }
    }

    /// Where its cells lie.
    pub fn placement(&self) -> Placement {
        self.placement
    }

    /// The number of columns and rows.
    pub fn extents(&self) -> [usize; 2] {
        self.placement.extents
    }

    /// Where the south-west corner of the south-west cell lies, in the units of the map.
    pub fn corner(&self) -> [f64; 2] {
        self.placement.corner
    }

    /// The side of a cell, in the units of the map.
    pub fn side(&self) -> f64 {
        self.placement.side
    }

    /// The values, x fastest, from the south; not a number where there is none.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The value of a cell, if it has one and lies in the grid.
    pub fn value(&self, [x, y]: [usize; 2]) -> Option<f64> {
        let [columns, rows] = self.placement.extents;
        let inside = x < columns && y < rows;
        inside.then(|| self.values[y * columns + x]).filter(|value| !value.is_nan())
    }

    /// The same grid with this value in the cells that have none.
    #[must_use]
    pub fn filled(mut self, value: f64) -> Self {
        self.values.iter_mut().filter(|own| own.is_nan()).for_each(|own| *own = value);
        self
    }

    /// Reads a grid.
    ///
    /// Keys may stand in any order and in any case, on lines of their own or on one; values in lines of any length up to 16 MiB.
    /// `xllcenter` and `yllcenter` serve in place of `xllcorner` and `yllcorner`, and `dx` and `dy` that are equal in place of
    /// `cellsize`. Without a `NODATA_value`, -9999 stands for no value, as the format says. A value that is the same in `f32`
    /// stands for it too, as does any beyond 1e38 where it is beyond 1e38: programs write such numbers with few digits.
    ///
    /// # Errors
    /// [`ReadGridError`] with the path, and with the line where a line is to blame.
    pub fn read(path: &Path) -> Result<Self, ReadGridError> {
        read::read(path, None)
    }

    /// As [`AsciiGrid::read`], of a file that may lack the header: then it must have a line for each row of these cells, the
    /// northernmost first, with a value for each column.
    ///
    /// # Errors
    /// [`ReadGridError`], as of [`AsciiGrid::read`].
    pub fn read_on(path: &Path, placement: Placement) -> Result<Self, ReadGridError> {
        read::read(path, Some(placement))
    }

    /// As [`AsciiGrid::read`], of altitudes in m: those beyond [`HIGHEST`], which no ground has, and grids without any
    /// altitude are refused.
    ///
    /// # Errors
    /// [`ReadGridError`], as of [`AsciiGrid::read`]; [`ReadGridError::Height`] and [`ReadGridError::Empty`].
    pub fn read_heights(path: &Path) -> Result<Self, ReadGridError> {
        let grid = Self::read(path)?;
        let wrong = grid.values.iter().position(|height| height.abs() > HIGHEST);
        match wrong {
            Some(cell) => Err(ReadGridError::Height {
                path: path.to_owned(),
                place: grid.placement.place(cell),
                height: grid.values[cell],
            }),
            None if grid.values.iter().all(|height| height.is_nan()) => {
                Err(ReadGridError::Empty { path: path.to_owned() })
            }
            None => Ok(grid),
        }
    }

    /// Writes the grid, each number with as many digits as it takes to read it back to the last bit. The file appears complete or not at all.
    ///
    /// # Errors
    /// [`WriteError`] with the path.
    pub fn write(&self, path: &Path) -> Result<(), WriteError> {
        let nothing = self.nothing();
        let Self { placement: Placement { extents: [columns, rows], corner: [x, y], side }, values } = self;
        write_atomically(path, |file| {
            writeln!(file, "ncols {columns}\nnrows {rows}\nxllcorner {x}\nyllcorner {y}")?;
            writeln!(file, "cellsize {side}\nNODATA_value {nothing}")?;
            for row in values.chunks_exact(*columns).rev() {
                for (column, value) in row.iter().enumerate() {
                    let gap = if column > 0 { " " } else { "" };
                    let shown = if value.is_nan() { nothing } else { *value };
                    let is_short = shown == 0.0 || (1e-5..1e16).contains(&shown.abs());
                    if is_short { write!(file, "{gap}{shown}") } else { write!(file, "{gap}{shown:e}") }?;
                }
                writeln!(file)?;
            }
            Ok(())
        })
    }

    /// A number that no cell has: -9999, or more nines.
    fn nothing(&self) -> f64 {
        let mut nothing = -9999.0;
        while self.values.iter().any(|value| stands_for_none(*value, nothing)) {
            nothing = 10.0 * nothing - 9.0;
        }
        nothing
    }
}

impl From<&AsciiGrid> for Map {
    /// The place of the grid, with ground where it has a value.
    fn from(grid: &AsciiGrid) -> Self {
        let missing = grid.values.iter().map(|value| value.is_nan()).collect();
        let map = Self::new(grid.placement);
        map.clone().without(missing).unwrap_or(map)
    }
}

/// The largest altitude, and depth, that the ground can have, in m.
pub const HIGHEST: f64 = 1e5;

/// Beyond this, numbers that stand for none are written with few digits.
const HUGE: f64 = 1e38;

/// Whether a number of a file is the one that stands for none, however many digits either is written with.
fn stands_for_none(number: f64, nothing: f64) -> bool {
    let is_same_f32 = number as f32 == nothing as f32 && number != 0.0 && nothing as f32 != 0.0;
    let are_huge = number.abs() >= HUGE && nothing.abs() >= HUGE && number.signum() == nothing.signum();
    number == nothing || is_same_f32 || are_huge
}

#[cfg(test)]
mod tests;
