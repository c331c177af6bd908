//! The input files that the commands of the book name.

use crate::running::Workplace;
use xca_run::io::ascii_grid;
use xca_run::io::geotiff::{self, SampleType};
use xca_run::io::raster::Raster;

/// A grid of so many columns and rows, with a value for each column and row from the south.
struct Grid {
    name: &'static str,
    side: f64,
    cells: [usize; 2],
    value: fn(usize, usize) -> f64,
}

const fn grid(name: &'static str, cells: [usize; 2], value: fn(usize, usize) -> f64) -> Grid {
    Grid { name, side: 10.0, cells, value }
}

const GRIDS: &[Grid] = &[
    grid("ground.asc", [12, 9], slope),
    grid("debris.asc", [12, 9], heap),
    grid("source.asc", [12, 9], heap),
    grid("ground.tif", [12, 9], slope),
    grid("debris.tif", [12, 9], heap),
    // Without values where there is no lava.
    grid("lava.asc", [12, 9], |x, y| if heap(x, y) > 0.0 { 3.0 } else { f64::NAN }),
    // The vents of docs/maps.md lie on it.
    grid("etna.asc", [230, 200], |x, y| 3000.0 - 5.0 * (x.abs_diff(212) + y.abs_diff(182)) as f64),
    grid("fuel.asc", [30, 20], |x, y| if (x + y) % 7 == 0 { 0.5 } else { 1.0 }),
    Grid { side: 1.0, ..grid("soup.asc", [256, 256], |x, y| f64::from((x * x + 3 * y) % 5 == 0)) },
];

fn slope(x: usize, y: usize) -> f64 {
    (10 * y + (x * x) % 5) as f64
}

fn heap(x: usize, y: usize) -> f64 {
    if (4..7).contains(&x) && (5..8).contains(&y) { 4.5 } else { 0.0 }
}

/// A matrix without a header, for which docs/maps.md makes one.
const MATRIX: (&str, &str) = ("dem.txt", "1 2 3 4 5\n2 3 4 5 6\n3 4 5 6 7\n4 5 6 7 8\n5 6 7 8 9\n");

/// The names of all input files.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    GRIDS.iter().map(|grid| grid.name).chain([MATRIX.0])
}

/// Whether a command names a file, in whatever place: `--initial thickness:0=lava.asc`.
pub(super) fn is_named(name: &str, command: &str) -> bool {
    let words = command.split(|sign: char| sign.is_whitespace() || "=();'".contains(sign));
    words.into_iter().any(|word| word == name)
}

/// Writes those that a command names.
pub(super) fn write(place: &Workplace, command: &str) {
    for grid in GRIDS.iter().filter(|grid| is_named(grid.name, command)) {
        let [columns, rows] = grid.cells;
        let values = (0..rows).flat_map(|y| (0..columns).map(move |x| (grid.value)(x, y))).collect();
        let raster =
            Raster::new(grid.cells, grid.side, values).unwrap().with_corner([499_000.0, 4_177_000.0]);
        let path = place.path(grid.name);
        if grid.name.ends_with(".tif") {
            geotiff::write(&path, &raster, SampleType::F64).unwrap();
        } else {
            ascii_grid::write(&path, &raster).unwrap();
        }
    }
    let (name, text) = MATRIX;
    if is_named(name, command) {
        place.write(name, text);
    }
}
