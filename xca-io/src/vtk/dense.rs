//! Dense substates as ImageData.

use std::path::Path;

use super::super::atomic::write_atomically;
use super::VtkError;
use super::appended::{Appended, joined};
use super::values::{DataArray, check_arrays};

/// The grid of an ImageData file: boxes of equal size, x fastest.
///
/// For hexagons see [`super::HexagonGrid`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// The number of cells along x, y and z. 1 along z for one layer.
    pub cells: [usize; 3],
    /// The lower corner of the space, as a length.
    pub origin: [f64; 3],
    /// The side of a cell along each axis, as a length.
    pub spacing: [f64; 3],
}

impl Grid {
    /// A space of cubic cells with its lower corner at the origin.
    #[must_use]
    pub fn cubic(cells: [usize; 3], side: f64) -> Self {
        Self { cells, origin: [0.0; 3], spacing: [side; 3] }
    }
}

/// The name of the array that hides cells in ParaView and VTK. Fill it with [`ghost_types`].
pub const GHOST_TYPE: &str = "vtkGhostType";

/// VTK's mark of a cell that is neither drawn nor counted in statistics.
const HIDDEN: u8 = 32;

/// The content of the array [`GHOST_TYPE`] that hides these cells.
pub fn ghost_types(hidden: &[bool]) -> Vec<u8> {
    hidden.iter().map(|is_hidden| if *is_hidden { HIDDEN } else { 0 }).collect()
}

/// The cells that an array of ghost types hides.
pub(super) fn hidden_cells(ghost_types: &[u8]) -> Vec<bool> {
    ghost_types.iter().map(|ghost| ghost & HIDDEN != 0).collect()
}

/// Writes dense substates to `path` (`.vti`) as cell data. Every array has one entry per cell, x fastest,
/// then y, then z. `time` is the simulated time.
///
/// # Errors
/// [`VtkError::ArrayLength`], [`VtkError::RepeatedArray`], [`VtkError::TooMany`], [`VtkError::Geometry`] and
/// [`VtkError::Write`], each with the path.
pub fn write_dense(path: &Path, time: f64, grid: &Grid, arrays: &[DataArray<'_>]) -> Result<(), VtkError> {
    let bad = |what, value| VtkError::Geometry { path: path.to_owned(), what, value };
    if !time.is_finite() {
        return Err(bad("the time", time));
    }
    if let Some(&origin) = grid.origin.iter().find(|x| !x.is_finite()) {
        return Err(bad("a coordinate of the origin", origin));
    }
    if let Some(&spacing) = grid.spacing.iter().find(|x| !(x.is_finite() && **x > 0.0)) {
        return Err(bad("a side of the cells", spacing));
    }
    if let Some(&found) = grid.cells.iter().find(|&&n| i32::try_from(n).is_err()) {
        return Err(VtkError::TooMany { path: path.to_owned(), found });
    }
    let cells =
        grid.cells.iter().try_fold(1_usize, |product, &n| product.checked_mul(n)).unwrap_or(usize::MAX);
    check_arrays(path, arrays, cells)?;

    let [nx, ny, nz] = grid.cells;
    let extent = format!("0 {nx} 0 {ny} 0 {nz}");
    write_atomically(path, |file| {
        Appended::write(file, "ImageData", |appended| {
            format!(
                "<ImageData WholeExtent=\"{extent}\" Origin=\"{origin}\" Spacing=\"{spacing}\">\n{time}\
         <Piece Extent=\"{extent}\">\n{data}</Piece>\n</ImageData>\n",
                origin = joined(&grid.origin),
                spacing = joined(&grid.spacing),
                time = appended.field_data(time, arrays, ""),
                data = appended.data("CellData", arrays),
            )
        })
    })?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::{NumberType, ValueSource, Values};
    use super::*;
    use std::fs;
    use std::io::{self, Read};

    #[test]
    fn the_bytes_are_those_of_the_format() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("d.vti");
        let grid = Grid { cells: [3, 2, 1], origin: [0.0, -0.5, 0.0], spacing: [0.1, 0.25, 1e-7] };
        let arrays = [DataArray::new("alive", &[1_u8, 0, 1, 1, 0, 9][..])];
        write_dense(&path, 2.0, &grid, &arrays).unwrap();
        let expected = r#"<?xml version="1.0"?>
<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt64" compressor="vtkZLibDataCompressor">
<ImageData WholeExtent="0 3 0 2 0 1" Origin="0.0 -0.5 0.0" Spacing="0.1 0.25 1e-7">
<FieldData>
<DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="appended" offset="0"                   />
</FieldData>
<Piece Extent="0 3 0 2 0 1">
<CellData Scalars="alive">
<DataArray type="UInt8" Name="alive" NumberOfComponents="1" format="appended" offset="AT"                  />
</CellData>
</Piece>
</ImageData>
<AppendedData encoding="raw">
_"#;
        // One block of 8 bytes and one of 6, each with the length of its stream. A zlib stream of few bytes
        // begins with 0x78.
        let bytes = fs::read(&path).unwrap();
        // This placeholder is as long as the offset.
        let of_time = 32 + bytes[expected.len() + 24] as usize;
        let place = expected.replace("AT", &of_time.to_string());
        assert_eq!(String::from_utf8_lossy(&bytes[..place.len()]), place);
        let (data, end) = bytes[place.len()..].split_at(bytes.len() - place.len() - 28);
        assert_eq!(end, b"\n</AppendedData>\n</VTKFile>\n");
        for (block, length, values) in
            [(&data[..of_time], 8_u8, &2.0_f64.to_le_bytes()[..]), (&data[of_time..], 6, &[1, 0, 1, 1, 0, 9])]
        {
            let numbers = [[1, 0, 0, 0, 0, 0, 0, 0], [0, 0, 4, 0, 0, 0, 0, 0], [length, 0, 0, 0, 0, 0, 0, 0]];
            assert_eq!(block[..24], numbers.concat());
            let mut found = Vec::new();
            flate2::read::ZlibDecoder::new(&block[32..]).read_to_end(&mut found).unwrap();
            assert_eq!((found.as_slice(), block[32]), (values, 0x78));
        }
    }

    /// Numbers that are made while they are written.
    #[derive(Debug)]
    struct Counted {
        given: u32,
        fails: bool,
    }

    impl ValueSource for Counted {
        fn write_to(&self, out: &mut dyn io::Write) -> io::Result<()> {
            (0..self.given).try_for_each(|number| out.write_all(&number.to_le_bytes()))?;
            if self.fails { Err(io::Error::other("the source is dry")) } else { Ok(()) }
        }
    }

    #[test]
    fn values_of_a_source_are_written_like_others() {
        let folder = tempfile::tempdir().unwrap();
        let grid = Grid::cubic([30, 50, 100], 0.5);
        let (whole, made) = (folder.path().join("whole.vti"), folder.path().join("made.vti"));
        let numbers: Vec<u32> = (0..3 * 150_000).collect();
        let marks = vec![7_u8; 150_000];
        let write = |path: &Path, values: Values<'_>| {
            let arrays = [DataArray::new("number", values), DataArray::new("mark", &marks[..])];
            write_dense(path, 1.0, &grid, &arrays)
        };
        write(&whole, Values::interleaved(3, &numbers[..])).unwrap();
        let counted = |given: u32, fails: bool| {
            write(&made, Values::of_source(NumberType::U32, 3, 150_000, &Counted { given, fails }))
        };
        counted(450_000, false).unwrap();
        assert!(fs::read(&whole).unwrap() == fs::read(&made).unwrap());
        fs::remove_file(&made).unwrap();
        for (given, fails) in [(449_999, false), (450_001, false), (10, true)] {
            assert!(matches!(counted(given, fails), Err(VtkError::Write(_))), "{given}");
            assert!(!made.exists());
        }
    }

    #[test]
    fn what_does_not_fit_the_grid_is_named() {
        let path = Path::new("/nowhere/d.vti");
        let write = |grid: &Grid, n: usize| {
            let values = vec![0.0; n];
            write_dense(path, 0.0, grid, &[DataArray::new("t", &values[..])]).unwrap_err().to_string()
        };
        let grid = Grid::cubic([3, 2, 2], 0.5);
        assert_eq!(write(&grid, 11), "cannot write /nowhere/d.vti: array `t` has 11 entries, not 12");
        assert!(write(&Grid { spacing: [0.5, 0.0, 0.5], ..grid }, 12).contains("a side of the cells is 0"));
        assert!(write(&Grid { origin: [f64::NAN; 3], ..grid }, 12).contains("origin is NaN"));
        assert!(write(&Grid { cells: [usize::MAX, 1, 1], ..grid }, 12).contains("limit of 2147483647"));
        assert!(write(&Grid { cells: [1 << 30; 3], ..grid }, 12).contains("has 12 entries"));
    }
}
