//! Dense substates on hexagons as PolyData.

use std::io::{self, Write};
use std::path::Path;

use super::super::atomic::write_atomically;
use super::VtkError;
use super::appended::{Appended, numbers_as_text};
use super::number_type::NumberType;
use super::values::{DataArray, ValueSource, Values, check_arrays};
use crate::lattice::Lattice;

/// The corners of a hexagon.
pub(super) const CORNERS: usize = 6;

/// The fields of a file that describe its grid.
pub(super) const EXTENTS: &str = "extents";
pub(super) const CORNER: &str = "corner";
pub(super) const SIDE: &str = "side";
pub(super) const STAGGER_AXIS: &str = "stagger axis";

/// A grid of hexagons, x fastest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HexagonGrid {
    /// The number of cells along x, y and z. 1 along z for one layer.
    pub cells: [usize; 3],
    /// The lattice: odd rows or odd columns are shifted by half a cell.
    pub lattice: Lattice,
    /// The lower left corner of the box around all cells, as a length.
    pub corner: [f64; 2],
    /// The distance between the centres of neighbours, and between layers, as a length.
    pub side: f64,
}

impl HexagonGrid {
    /// The number of cells. `None` if it overflows.
    pub(super) fn count(&self) -> Option<usize> {
        self.cells.iter().try_fold(1_usize, |product, n| product.checked_mul(*n))
    }
}

/// The corners of all cells, counterclockwise in each cell.
impl ValueSource for HexagonGrid {
    fn write_to(&self, out: &mut dyn Write) -> io::Result<()> {
        let ([columns, rows, layers], [left, low]) = (self.cells, self.corner);
        let around = self.lattice.corners();
        for cell in 0..columns * rows * layers {
            let (layer, place) = (cell / (columns * rows), cell % (columns * rows));
            let [x, y] = self.lattice.centre([place % columns, place / columns]);
            for [u, v] in &around {
                let point = [left + (x + u) * self.side, low + (y + v) * self.side, layer as f64 * self.side];
                point.iter().try_for_each(|number| out.write_all(&number.to_le_bytes()))?;
            }
        }
        Ok(())
    }
}

/// The axis along which the shift of cells alternates. `None` for squares.
fn stagger_axis(lattice: Lattice) -> Option<f64> {
    match lattice {
        Lattice::Squares => None,
        Lattice::HexagonRows => Some(1.0),
        Lattice::HexagonColumns => Some(0.0),
    }
}

/// The grid described by the fields of a file.
pub(super) fn grid(
    extents: [f64; 3],
    corner: [f64; 2],
    [side]: [f64; 1],
    [stagger_axis]: [f64; 1],
) -> Option<HexagonGrid> {
    let is_count = |n: &f64| n.fract() == 0.0 && (0.0..=f64::from(i32::MAX)).contains(n);
    let lattice = if stagger_axis == 1.0 { Lattice::HexagonRows } else { Lattice::HexagonColumns };
    let is_whole = extents.iter().all(is_count) && [0.0, 1.0].contains(&stagger_axis);
    is_whole.then(|| HexagonGrid { cells: extents.map(|n| n as usize), lattice, corner, side })
}

/// Writes dense substates on hexagons to `path` (`.vtp`) as cell data. Every array has one entry per cell, x
/// fastest, then y, then z. `time` is the simulated time.
///
/// Each cell is a polygon with six points of its own. Layers are planes at the distance `side`.
///
/// # Errors
/// [`VtkError::ArrayLength`], [`VtkError::RepeatedArray`], [`VtkError::TooMany`], [`VtkError::Geometry`]
/// (also for squares) and [`VtkError::Write`], each with the path.
pub fn write_hexagons(
    path: &Path,
    time: f64,
    grid: &HexagonGrid,
    arrays: &[DataArray<'_>],
) -> Result<(), VtkError> {
    let bad = |what, value| VtkError::Geometry { path: path.to_owned(), what, value };
    if !time.is_finite() {
        return Err(bad("the time", time));
    }
    if let Some(&corner) = grid.corner.iter().find(|x| !x.is_finite()) {
        return Err(bad("a coordinate of the corner", corner));
    }
    if !(grid.side.is_finite() && grid.side > 0.0) {
        return Err(bad("a side of the cells", grid.side));
    }
    let Some(axis) = stagger_axis(grid.lattice) else {
        return Err(bad("the number of corners of a cell", 4.0));
    };
    let cells = grid.count().unwrap_or(usize::MAX);
    check_arrays(path, arrays, cells)?;
    let too_many = || VtkError::TooMany { path: path.to_owned(), found: cells.saturating_mul(CORNERS) };
    let (Ok(n), Some(corners)) =
        (i32::try_from(cells), cells.checked_mul(CORNERS).and_then(|corners| i32::try_from(corners).ok()))
    else {
        return Err(too_many());
    };
    let points = Values::of_source(NumberType::F64, 3, cells * CORNERS, grid);
    let points = DataArray::new("Points", points);
    let fields = [
        numbers_as_text(EXTENTS, &grid.cells.map(|n| n as f64)),
        numbers_as_text(CORNER, &grid.corner),
        numbers_as_text(SIDE, &[grid.side]),
        numbers_as_text(STAGGER_AXIS, &[axis]),
    ];
    write_atomically(path, |file| {
        Appended::write(file, "PolyData", |appended| {
            format!(
                "<PolyData>\n{time}\
         <Piece NumberOfPoints=\"{corners}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" \
         NumberOfPolys=\"{n}\">\n\
         <Points>\n{points}</Points>\n\
         <Polys>\n{connectivity}{offsets}</Polys>\n\
         {data}</Piece>\n</PolyData>\n",
                time = appended.field_data(time, arrays, &fields.concat()),
                points = appended.array(&points),
                connectivity = appended.count("connectivity", 0..corners),
                offsets = appended.count("offsets", (0..n).map(|cell| (cell + 1) * CORNERS as i32)),
                data = appended.data("CellData", arrays),
            )
        })
    })?;
    Ok(())
}
