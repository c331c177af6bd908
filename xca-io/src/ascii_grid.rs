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
use std::io::Write;
use std::path::Path;

/// A layer of square cells, each with a number or without one.
#[derive(Debug, Clone, PartialEq)]
pub struct AsciiGrid {
    extents: [usize; 2],
    corner: [f64; 2],
    side: f64,
    /// x fastest, from the south; not a number where there is none.
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
        fits.then_some(Self { extents, corner: [0.0; 2], side, values })
    }

    /// The same grid with its south-west corner elsewhere.
    #[must_use]
    pub fn with_corner(self, corner: [f64; 2]) -> Self {
        Self { corner, ..self }
    }

    /// The number of columns and rows.
    pub fn extents(&self) -> [usize; 2] {
        self.extents
    }

    /// Where the south-west corner of the south-west cell lies, in the units of the map.
    pub fn corner(&self) -> [f64; 2] {
        self.corner
    }

    /// The side of a cell, in the units of the map.
    pub fn side(&self) -> f64 {
        self.side
    }

    /// The values, x fastest, from the south; not a number where there is none.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The value of a cell, if it has one and lies in the grid.
    pub fn value(&self, [x, y]: [usize; 2]) -> Option<f64> {
        let inside = x < self.extents[0] && y < self.extents[1];
        inside.then(|| self.values[y * self.extents[0] + x]).filter(|value| !value.is_nan())
    }

    /// Reads a grid.
    ///
    /// Keys may stand in any order and in any case, values in lines of any length. `xllcenter` and `yllcenter` serve in place of `xllcorner` and
    /// `yllcorner`.
    ///
    /// # Errors
    /// [`ReadGridError`] with the path, and with the line where a line is to blame.
    pub fn read(path: &Path) -> Result<Self, ReadGridError> {
        read::read(path)
    }

    /// Writes the grid, each number with as many digits as it takes to read it back to the last bit. The file appears complete or not at all.
    ///
    /// # Errors
    /// [`WriteError`] with the path.
    pub fn write(&self, path: &Path) -> Result<(), WriteError> {
        let nothing = self.nothing();
        let Self { extents: [columns, rows], corner: [x, y], side, values } = self;
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
        while self.values.contains(&nothing) {
            nothing = 10.0 * nothing - 9.0;
        }
        nothing
    }
}

#[cfg(test)]
mod tests;
