use super::*;
use crate::map::Map;
use std::fs;

fn read_text(text: &[u8]) -> Result<Raster, ReadGridError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("dem.asc");
    fs::write(&path, text).unwrap();
    read(&path)
}

/// The message without the folder, which differs from run to run.
fn message(text: &str) -> String {
    let message = read_text(text.as_bytes()).unwrap_err().to_string();
    message[message.find("dem.asc").unwrap()..].to_owned()
}

const HEADER: &str = "ncols 3\nnrows 2\nxllcorner 100\nyllcorner 200.5\ncellsize 10\n";

#[test]
fn rows_count_from_the_south_and_stand_from_the_north() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("dem.asc");
    let values = vec![0.5, 1.0, 2.0, f64::NAN, -4.25, 5e-7];
    let grid = Raster::new([3, 2], 10.0, values).unwrap().with_corner([100.0, 200.5]);
    assert_eq!((grid.value([1, 1]), grid.value([2, 0])), (Some(-4.25), Some(2.0)));
    assert_eq!((grid.value([0, 1]), grid.value([3, 0]), grid.value([0, 2])), (None, None, None));
    write(&path, &grid).unwrap();
    let wanted = format!("{HEADER}NODATA_value -9999\n-9999 -4.25 5e-7\n0.5 1 2\n");
    assert_eq!(fs::read_to_string(&path).unwrap(), wanted);
    let back = read(&path).unwrap();
    assert_eq!((back.extents(), back.corner(), back.side()), ([3, 2], [100.0, 200.5], 10.0));
    assert_eq!(back.value([0, 1]), None);
    assert_eq!(back.values()[4..], [-4.25, 5e-7]);
}

#[test]
fn every_number_comes_back_with_its_bits() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("dem.asc");
    let mut values = vec![0.1 + 0.2, -0.0, 5e-324, f64::MAX, -9999.0, -99999.0, 1e16, 1e-5];
    // Random bits: all exponents, all mantissas.
    let mut bits = 1_u64;
    while values.len() < 2000 {
        bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        values.extend(Some(f64::from_bits(bits)).filter(|value| value.is_finite()));
    }
    let grid = Raster::new([50, 40], 1.0 / 3.0, values.clone()).unwrap().with_corner([-0.1, 1e9]);
    write(&path, &grid).unwrap();
    let back = read(&path).unwrap();
    assert_eq!((back.side(), back.corner()), (1.0 / 3.0, [-0.1, 1e9]));
    for (written, read) in values.iter().zip(back.values()) {
        assert_eq!(written.to_bits(), read.to_bits(), "{written:e}");
    }
}

#[test]
fn what_other_programs_write_can_be_read() {
    let wanted = [4.0, 5.0, 6.0, 1.0, 2.0, 3.0];
    let same = |text: &str| {
        let grid = read_text(text.as_bytes()).unwrap();
        assert_eq!(grid.values(), wanted, "{text}");
        assert_eq!((grid.extents(), grid.corner(), grid.side()), ([3, 2], [100.0, 200.5], 10.0), "{text}");
    };
    same(&format!("{HEADER}1 2 3\n4 5 6\n"));
    same(&format!("{HEADER}1.0\t2.  3e0\r\n\r\n 4 5 +6"));
    same(&format!("{HEADER}1\n2\n3 4\n5 6\n\n"));
    same(&format!("\u{feff}{HEADER}nodata_VALUE -1\n1 2 3 4 5 6\n"));
    same("CELLSIZE 10\nNROWS 2\nNCOLS 3\nYLLCENTER 205.5\nXLLCENTER 105\n1 2 3\n4 5 6\n");
    let none = |text: &str| {
        let grid = read_text(text.as_bytes()).unwrap();
        let values: Vec<Option<f64>> = (0..3).map(|x| grid.value([x, 1])).collect();
        assert_eq!(values, [Some(1.0), None, Some(3.0)]);
    };
    none(&format!("{HEADER}NODATA_value -9999.0\n1 -9999 3\n4 5 6\n"));
    none(&format!("{HEADER}NODATA_value nan\n1 NaN 3\n4 5 6\n"));
}

#[test]
fn what_makes_no_sense_is_named_by_its_line() {
    let missing = "; it needs ncols, nrows, xllcorner, yllcorner and cellsize";
    assert_eq!(message(""), format!("dem.asc: the header of the grid has no `ncols`{missing}"));
    assert_eq!(
        message("ncols 3\nnrows 2\nxllcorner 0\ncellsize 1\n1 2 3 4 5 6\n"),
        format!("dem.asc: the header of the grid has no `yllcorner`{missing}")
    );
    let of = "values, but 3 columns and 2 rows have 6 cells";
    assert_eq!(message(&format!("{HEADER}1 2 3\n4 5\n")), format!("dem.asc: 5 {of}"));
    assert_eq!(message(&format!("{HEADER}1 2 3\n4 5 6\n\n7\n")), format!("dem.asc:9: more {of}"));
    assert_eq!(message(&format!("{HEADER}1 2 3\n4 x 6\n")), "dem.asc:7: `x` is not a number");
    assert_eq!(message(&format!("{HEADER}1 2,5 3\n4 5 6\n")), "dem.asc:6: `2,5` is not a number");
    assert_eq!(message("ncols 3\nNROWS -2\n"), "dem.asc:2: `NROWS` must be a whole number, at least 1");
    assert_eq!(message("ncols\n"), "dem.asc:1: `ncols` has no value");
    assert_eq!(message("ncols 3\n\nncols 3\n"), "dem.asc:3: `ncols` appears twice in the header");
    assert_eq!(message("xllcorner 3\nxllcenter 3\n"), "dem.asc:2: `xllcenter` appears twice in the header");
    assert_eq!(message("cellsize 0\n"), "dem.asc:1: `cellsize` must be more than 0");
    assert_eq!(message("yllcorner inf\n"), "dem.asc:1: `yllcorner` must be a finite number");
    assert!(
        message("ncolumns 10\n").starts_with("dem.asc:1: `ncolumns` is no key of a grid; there are ncols")
    );
    // Their product is beyond 64 bits.
    let huge = 1_u64 << 32;
    let of = format!("ncols {huge}\nnrows {huge}\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n");
    assert!(message(&of).starts_with("dem.asc: 3 values, but"));
}

#[test]
fn bytes_that_are_no_text_and_a_missing_file_are_errors() {
    let error = read_text(b"ncols 3\nnrows \xFF\n").unwrap_err();
    assert!(error.to_string().ends_with("dem.asc:2: cannot read the grid on"), "{error}");
    assert!(std::error::Error::source(&error).is_some());
    let error = read(Path::new("/nowhere/dem.asc")).unwrap_err();
    assert!(error.to_string().contains("/nowhere/dem.asc"), "{error}");
}

#[test]
fn a_grid_has_a_value_for_each_cell_and_square_cells() {
    for (extents, side, count) in [
        ([0, 2], 1.0, 0),
        ([2, 2], 1.0, 3),
        ([2, 2], 0.0, 4),
        ([2, 2], f64::NAN, 4),
        ([usize::MAX, 2], 1.0, 4),
    ] {
        assert_eq!(Raster::new(extents, side, vec![0.0; count]), None, "{extents:?} {side} {count}");
    }
}

#[test]
fn numbers_that_stand_for_no_value_are_told_by_what_they_mean() {
    let values = |nothing: &str, cells: &str| {
        let grid = read_text(format!("{HEADER}{nothing}\n{cells}\n4 5 6\n").as_bytes()).unwrap();
        (0..3).map(|x| grid.value([x, 1])).collect::<Vec<_>>()
    };
    let hole = [Some(1.0), None, Some(3.0)];
    // The default of the format.
    assert_eq!(values("", "1 -9999 3"), hole);
    assert_eq!(values("NODATA_value -1", "1 -9999 3")[1], Some(-9999.0));
    // Few digits in the header, or in the cells.
    for (header, cell) in [
        ("-3.4e+38", "-3.4028234663852886e+38"),
        ("-3.402823e+38", "-3.4028234663852886e+38"),
        ("-1.79769e+308", "-1.7976931348623157e+308"),
        ("-1.7976931348623157e+308", "-1.8e+308"),
        ("9.96921e+36", "9.969209968386869e+36"),
        ("0.1", "0.10000000149011612"),
        ("-inf", "-inf"),
        ("0", "-0.0"),
    ] {
        assert_eq!(
            values(&format!("NODATA_value {header}"), &format!("1 {cell} 3")),
            hole,
            "{header} {cell}"
        );
    }
    // A number close to NODATA is a value.
    assert_eq!(values("NODATA_value 0", "1 1e-60 3")[1], Some(1e-60));
    assert_eq!(values("NODATA_value -9999", "1 -9998.99 3")[1], Some(-9998.99));
    assert_eq!(values("NODATA_value -3.4e38", "1 3.4e38 3")[1], Some(3.4e38));
}

#[test]
fn a_written_grid_has_no_value_that_stands_for_none() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.asc");
    let values = vec![-9_999.000_01, f64::NAN];
    write(&path, &Raster::new([2, 1], 1.0, values.clone()).unwrap()).unwrap();
    let back = read(&path).unwrap();
    assert_eq!((back.value([0, 0]), back.value([1, 0])), (Some(values[0]), None));
}

#[test]
fn infinite_numbers_and_impossible_heights_are_refused() {
    assert_eq!(message(&format!("{HEADER}1 inf 3\n4 5 6\n")), "dem.asc:6: `inf` is not a finite number");
    assert_eq!(message(&format!("{HEADER}1 2 3\n4 1e309 6\n")), "dem.asc:7: `1e309` is not a finite number");
    let heights = |cells: &str| {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("dem.asc");
        fs::write(&path, format!("{HEADER}{cells}\n")).unwrap();
        Raster::read_heights(&path).map(|grid| grid.values().len()).map_err(|error| {
            let message = error.to_string();
            message[message.find("dem.asc").unwrap()..].to_owned()
        })
    };
    assert_eq!(heights("1 -9999 3\n-10935 21229 30000"), Ok(6));
    // What programs write for NODATA without a line in the header.
    for number in ["-32768", "32767", "65535", "-99999", "99999", "1e20"] {
        let said = heights(&format!("1 2 {number}\n4 5 6")).unwrap_err();
        assert!(said.contains("in column 3, row 1 from the north is not an altitude"), "{said}");
    }
    let said = heights("1 2 3\n4 -32768e4 6").unwrap_err();
    assert!(
        said.starts_with("dem.asc: -327680000 in column 2, row 2 from the north is not an altitude"),
        "{said}"
    );
    // The usual NODATA, where the header declares another one.
    let said = heights("NODATA_value -99999\n1 -99999 3\n-9999 5 6").unwrap_err();
    assert!(
        said.starts_with("dem.asc: -9999 in column 1, row 2 from the north is not an altitude"),
        "{said}"
    );
    assert!(heights("1 2 30001\n4 5 6").unwrap_err().contains("column 3, row 1"));
    assert_eq!(heights("-9999 -9999 -9999\n-9999 -9999 -9999").unwrap_err(), "dem.asc: no cell has a value");
}

#[test]
fn a_thickness_below_0_or_as_high_as_no_mountain_is_refused() {
    let thickness = |cells: &str| {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("debris.asc");
        fs::write(&path, format!("{HEADER}{cells}\n")).unwrap();
        Raster::read_thickness(&path).map(|grid| grid.value([1, 0])).map_err(|error| error.to_string())
    };
    assert_eq!(thickness("0 0.5 -9999\n-0.0 30000 0"), Ok(Some(30000.0)));
    for (number, told) in [("-5", "-5"), ("-1e-9", "-0.000000001"), ("32767", "32767"), ("-9998", "-9998")] {
        let said = thickness(&format!("0 0 0\n0 {number} 0")).unwrap_err();
        let wanted =
            format!("debris.asc: a thickness of {told} m in column 2, row 2 from the north; it must be");
        assert!(said.contains(&wanted), "{said}");
    }
}

#[test]
fn headers_on_one_line_are_read_and_words_left_over_are_refused() {
    let grid =
        read_text(b"ncols 3 nrows 2 xllcorner 100\nyllcorner 200.5 cellsize 10\n1 2 3\n4 5 6\n").unwrap();
    assert_eq!((grid.corner(), grid.value([0, 0])), ([100.0, 200.5], Some(4.0)));
    assert_eq!(
        message("ncols 3\nxllcorner 4 185 000\n"),
        "dem.asc:2: `xllcorner` has more than one value: `185` is left over"
    );
    assert!(message("ncols 3 columns of cells\n").starts_with("dem.asc:1: `columns` is no key"));
    assert!(message("ncols 3 nrows\n").starts_with("dem.asc:1: `nrows` has no value"));
    assert!(message("ncols 3 nrows 2 ncols 3\n").starts_with("dem.asc:1: `ncols` appears twice"));
    assert!(message("cellsize 10 # metres\n").contains("`cellsize` has more than one value: `#`"));
    assert!(message("ncols 3 2\n").contains("`ncols` has more than one value: `2`"));
}

#[test]
fn a_place_whose_cells_have_no_coordinates_is_refused() {
    let said = message(&HEADER.replace("yllcorner 200.5", "yllcorner -1e20"));
    assert!(said.contains("a coordinate of 1e20 is too large for cells with a side of 10"), "{said}");
}

#[test]
fn sides_that_are_equal_are_a_square() {
    let header = "ncols 3\nnrows 2\nxllcorner 100\nyllcorner 200.5\n";
    let read = |sides: &str| read_text(format!("{header}{sides}\n1 2 3\n4 5 6\n").as_bytes());
    assert_eq!(read("dx 10\ndy 10").unwrap().side(), 10.0);
    assert_eq!(read("DX 0.000277777777\ndy 0.000277777778").unwrap().side(), 0.000_277_777_777);
    let said = |sides: &str| read(sides).unwrap_err().to_string();
    assert!(said("dx 10\ndy 20").contains("the cells are not square: dx is 10 and dy 20"));
    assert!(said("dy 20").contains("no `dx`"));
    assert!(said("dx 10\ndy 10\ncellsize 10").contains("cellsize, and dx or dy"));
    assert!(said("dx 0\ndy 10").contains("`dx` must be more than 0"));
}

#[test]
fn a_matrix_is_read_where_the_cells_are_known() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("dem.txt");
    let placement = Placement { extents: [3, 2], corner: [100.0, 200.5], side: 10.0 };
    let read = |text: &str| {
        fs::write(&path, text).unwrap();
        read_placed(&path, Some(placement)).map_err(|error| error.to_string())
    };
    let grid = read("1 2.5 3\n\n4 -9999 6\n").unwrap();
    assert_eq!((grid.placement(), grid.value([1, 1]), grid.value([1, 0])), (placement, Some(2.5), None));
    // The header takes precedence.
    assert_eq!(read("ncols 1\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 5\n7\n").unwrap().side(), 5.0);
    assert!(
        read("1 2\n3 4\n5 6\n")
            .unwrap_err()
            .ends_with("dem.txt:1: the grid has no header, and 2 values in this row, not 3 as the model")
    );
    assert!(read("1 2 3\n").unwrap_err().ends_with("no header, and 1 rows, not 2 as the model"));
    assert!(
        read("1 2 3\n1 2 3\n1 2 3\n").unwrap_err().ends_with("no header, and more rows, not 2 as the model")
    );
    assert!(
        super::read(&path).unwrap_err().to_string().contains("the grid has no header; put the lines ncols")
    );
}

#[test]
fn a_map_has_ground_where_a_grid_has_a_value() {
    let grid = read_text(format!("{HEADER}1 -9999 3\n4 5 6\n").as_bytes()).unwrap();
    let map = Map::from(&grid);
    assert_eq!(
        (map.placement(), map.missing().unwrap()),
        (grid.placement(), &[false, false, false, false, true, false][..])
    );
    assert_eq!(Map::from(&grid.filled(2.0)).missing(), None);
}
