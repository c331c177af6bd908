//! A map with an island, and grids to be written and read.

use crate::running::{Workplace, vtk_array};
use std::path::Path;

/// A header of so many cells of 10 m, with its south-west corner there.
pub(super) fn header([columns, rows]: [usize; 2], [x, y]: [f64; 2]) -> String {
    format!("ncols {columns}\nnrows {rows}\nxllcorner {x}\nyllcorner {y}\ncellsize 10\nNODATA_value -9999\n")
}

/// An island: 3 x 3 cells of ground in the middle of 5 x 5, and debris in the middle of it.
pub(super) fn island(place: &Workplace) {
    let sea = "-9999 -9999 -9999 -9999 -9999";
    let land = "-9999 500 501 502 -9999";
    let header = header([5, 5], [2600.0, 5100.0]);
    place.write("g.asc", &format!("{header}{sea}\n{land}\n{land}\n{land}\n{sea}\n"));
    place.write("d.asc", &format!("{header}{}", matrix(5, 12, "5")));
}

/// A square of zeros, with this text in the cell with that number from the north-west.
pub(super) fn matrix(side: usize, cell: usize, text: &str) -> String {
    matrix_of("0", side, cell, text)
}

/// The same of another number.
pub(super) fn matrix_of(number: &str, side: usize, cell: usize, text: &str) -> String {
    let row = |y: usize| {
        let cells: Vec<&str> = (0..side).map(|x| if y * side + x == cell { text } else { number }).collect();
        format!("{}\n", cells.join(" "))
    };
    (0..side).map(row).collect()
}

/// The rows of a grid, the northernmost first.
pub(super) fn rows(place: &Workplace, file: &str) -> Vec<String> {
    place.read(file).lines().skip(6).map(str::to_owned).collect()
}

pub(super) fn floats(path: &Path, name: &str) -> Vec<f64> {
    let bytes = vtk_array(path, name);
    bytes.chunks_exact(8).map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap())).collect()
}

/// The cells of the island, from the south.
pub(super) fn is_land(cell: usize) -> bool {
    (1..4).contains(&(cell % 5)) && (1..4).contains(&(cell / 5))
}
