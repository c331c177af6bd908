//! ESRI ASCII grids (`.asc`): one number per cell of a layer, and the layer's place on the map.
//!
//! Every geographic information system reads and writes this format. The header holds the number of columns
//! and rows, the south-west corner, the side of a cell, and the NODATA value. The rows follow, the
//! northernmost first. Here, as in a model, rows count from the south: `[0, 0]` is the cell in the
//! south-west.
//!
//! [`crate::raster::Raster`] has an example.

mod error;
mod header;
mod read;

pub use error::ReadGridError;
pub(crate) use read::NOTHING;

use super::atomic::{WriteError, write_atomically};
use super::placement::Placement;
use super::raster::{Raster, stands_for_none};
use std::io::Write;
use std::path::Path;

/// Reads a grid.
///
/// Keys may have any order and case, on one line or several. `xllcenter` and `yllcenter` can replace
/// `xllcorner` and `yllcorner`. Equal `dx` and `dy` can replace `cellsize`. Lines of values may have any
/// length. Without a `NODATA_value`, -9999 is NODATA, as the format says.
///
/// Some programs write NODATA with few digits. A value that equals NODATA in `f32` is therefore NODATA too.
/// If NODATA is beyond 1e38, so is every value of the same sign beyond 1e38.
///
/// # Errors
/// Returns [`ReadGridError`] with the path and, for errors in the text, the line.
pub fn read(path: &Path) -> Result<Raster, ReadGridError> {
    read::read(path, None)
}

/// Like [`read`], but with `on` the file may lack its header. It must then have one line for each row, the
/// northernmost first, with one value for each column.
pub(crate) fn read_placed(path: &Path, on: Option<Placement>) -> Result<Raster, ReadGridError> {
    read::read(path, on)
}

/// Writes a raster as a grid. Numbers are exact to the last bit. The format has no coordinate system. The
/// file appears complete or not at all.
///
/// # Errors
/// Returns [`WriteError`] with the path.
pub fn write(path: &Path, raster: &Raster) -> Result<(), WriteError> {
    let values = raster.values();
    let nothing = unused_value(values);
    let Placement { extents: [columns, rows], corner: [x, y], side } = raster.placement();
    write_atomically(path, |file| {
        writeln!(file, "ncols {columns}\nnrows {rows}\nxllcorner {x}\nyllcorner {y}")?;
        writeln!(file, "cellsize {side}\nNODATA_value {nothing}")?;
        for row in values.chunks_exact(columns).rev() {
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

/// A number that no cell has: -9999, or one with more nines.
fn unused_value(values: &[f64]) -> f64 {
    let mut nothing = NOTHING;
    while values.iter().any(|value| stands_for_none(*value, nothing)) {
        nothing = 10.0 * nothing - 9.0;
    }
    nothing
}

#[cfg(test)]
mod tests;
