//! Where a map lies: all grids and files of a run lie there.

use super::island::{floats, header, island, matrix, matrix_of, rows};
use crate::running::{LANDSLIDE, POND, Workplace};
use std::fs;

#[test]
fn grids_must_lie_on_each_other() {
    let place = Workplace::new();
    let ground = format!("{}{}", header([5, 5], [0.0, 0.0]), matrix(5, 0, "500"));
    let debris = |corner| format!("{}{}", header([5, 5], corner), matrix(5, 12, "5"));
    place.write("g.asc", &ground);
    place.write("away.asc", &debris([1000.0, 0.0]));
    place.write("near.asc", &debris([0.000_005, 0.0]));
    place.write("north.asc", &debris([0.0, -0.5]));
    place.write("fine.asc", &debris([0.0, 0.0]).replace("cellsize 10", "cellsize 10.000001"));
    place.write("coarse.asc", &debris([0.0, 0.0]).replace("cellsize 10", "cellsize 10.1"));
    place.write("centre.asc", &debris([5.0, 5.0]).replace("llcorner", "llcenter"));
    for file in ["near", "fine", "centre"] {
        place.succeed(LANDSLIDE, &format!("--dem g.asc --debris {file}.asc --steps 0"));
        place.succeed(
            LANDSLIDE,
            &format!("--dem g.asc --debris near.asc --initial thickness={file}.asc --steps 0"),
        );
    }
    for (file, wanted) in [
        ("away", "its south-west corner is 1000, 0, not 0, 0"),
        ("north", "its south-west corner is 0, -0.5, not 0, 0"),
        ("coarse", "its cells have a side of 10.1, not 10"),
    ] {
        let said = place.fail(2, LANDSLIDE, &format!("--dem g.asc --debris {file}.asc"));
        assert!(said.contains(&format!("{file}.asc does not lie on g.asc: {wanted}")), "{said}");
        let said = place.fail(
            2,
            LANDSLIDE,
            &format!("--dem g.asc --debris near.asc --initial thickness={file}.asc"),
        );
        assert!(said.contains(&format!("{file}.asc does not lie on the model: {wanted}")), "{said}");
    }
    // A model without a map lies where the first grid lies.
    let pond = |corner| {
        let row = "1 ".repeat(48);
        let rows = vec![row.trim_end(); 32].join("\n");
        format!("{}{rows}\n", header([48, 32], corner).replace("cellsize 10", "cellsize 1"))
    };
    place.write("one.asc", &pond([100.0, 200.0]));
    place.write("other.asc", &pond([100.0, 201.0]));
    place.succeed(POND, "--initial depth=one.asc --initial wet=one.asc --steps 0");
    let said = place.fail(2, POND, "--initial depth=one.asc --initial wet=other.asc --steps 0");
    assert!(
        said.contains("other.asc does not lie on one.asc: its south-west corner is 100, 201, not 100, 200"),
        "{said}"
    );
}

/// Frames of cells and of items lie at the place of the map.
#[test]
fn frames_lie_on_the_map() {
    let place = Workplace::new();
    island(&place);
    place.succeed(LANDSLIDE, "--dem g.asc --debris d.asc --steps 0");
    let frame = fs::read(place.path("out/landslide/frames/landslide_00000000.vti")).unwrap();
    let head = String::from_utf8_lossy(&frame[..900]).into_owned();
    assert!(head.contains("Origin=\"2600.0 5100.0 0.0\" Spacing=\"10.0 10.0 10.0\""), "{head}");
    let row = vec!["1"; 48].join(" ");
    let cells = vec![row.as_str(); 32].join("\n");
    let header = header([48, 32], [2600.0, 5100.0]).replace("cellsize 10", "cellsize 1");
    place.write("depth.asc", &format!("{header}{cells}\n"));
    place.succeed(POND, "--steps 0 --out plain");
    place.succeed(POND, "--initial depth=depth.asc --steps 0 --out placed");
    let points = |run: &str| floats(&place.path(run).join("frames/leaves_00000000.vtp"), "Points");
    let (plain, placed) = (points("plain"), points("placed"));
    assert!(!plain.is_empty() && plain.len() == placed.len());
    for (lane, (plain, placed)) in plain.iter().zip(&placed).enumerate() {
        let corner = [2600.0, 5100.0, 0.0][lane % 3];
        assert!((placed - plain - corner).abs() < 1e-9, "{lane}: {plain} {placed}");
    }
    // The table, which a run can begin from, is that of the model.
    assert_eq!(place.read("plain/final.csv"), place.read("placed/final.csv"));
}

#[test]
fn a_layer_can_take_no_value_as_a_number() {
    let place = Workplace::new();
    let header = header([5, 5], [0.0, 0.0]);
    place.write("g.asc", &format!("{header}{}", matrix_of("500", 5, 0, "-9999")));
    place.write("d.asc", &format!("{header}{}", matrix(5, 12, "5")));
    let zero = header.replace("-9999", "0");
    place.write("lava.asc", &format!("{zero}{}", matrix(5, 13, "7")));
    let begin = "--dem g.asc --debris d.asc --steps 0 --initial";
    let said = place.fail(2, LANDSLIDE, &format!("{begin} thickness=lava.asc"));
    assert!(said.contains("for 0 there, write thickness:0=lava.asc"), "{said}");
    place.succeed(LANDSLIDE, &format!("{begin} thickness:0=lava.asc"));
    assert_eq!(
        rows(&place, "out/landslide/final_thickness.asc"),
        ["-9999 0 0 0 0", "0 0 0 0 0", "0 0 0 7 0", "0 0 0 0 0", "0 0 0 0 0"]
    );
    place.succeed(LANDSLIDE, &format!("{begin} thickness:1.5=lava.asc"));
    assert_eq!(rows(&place, "out/landslide/final_thickness.asc")[0], "-9999 1.5 1.5 1.5 1.5");
    place.succeed(LANDSLIDE, "--dem g.asc --debris lava.asc --steps 0");
    assert_eq!(rows(&place, "out/landslide/final_thickness.asc")[2], "0 0 0 7 0");
    let said = place.fail(2, LANDSLIDE, &format!("{begin} thickness:x=lava.asc"));
    assert!(said.contains("write NAME or NAME:NUMBER before `=`, such as thickness:0=lava.asc"), "{said}");
}

#[test]
fn a_grid_without_a_header_has_the_cells_of_the_model() {
    let place = Workplace::new();
    island(&place);
    place.write("dem.txt", "1 2 3 4 5\n2 3 4 5 6\n3 4 5 6 7\n4 5 6 7 8\n5 6 7 8 9\n");
    place.write("g.asc", &format!("{}{}", header([5, 5], [2600.0, 5100.0]), matrix(5, 0, "500")));
    let begin = "--dem g.asc --debris d.asc --steps 0 --initial";
    place.succeed(LANDSLIDE, &format!("{begin} altitude=dem.txt"));
    let altitude = place.read("out/landslide/final_altitude.asc");
    assert!(
        altitude.contains("xllcorner 2600\n")
            && altitude.ends_with("-9999\n1 2 3 4 5\n2 3 4 5 6\n3 4 5 6 7\n4 5 6 7 8\n5 6 7 8 9\n"),
        "{altitude}"
    );
    place.write("wide.txt", "1 2 3 4 5 6\n2 3 4 5 6 7\n");
    let said = place.fail(2, LANDSLIDE, &format!("{begin} altitude=wide.txt"));
    assert!(said.contains("wide.txt:1: the grid has no header, and 6 values in this row, not 5"), "{said}");
    place.write("low.txt", "1 2 3 4 5\n2 3 4 5 6\n");
    let said = place.fail(2, LANDSLIDE, &format!("{begin} altitude=low.txt"));
    assert!(said.contains("low.txt: the grid has no header, and 2 rows, not 5"), "{said}");
    let said = place.fail(2, LANDSLIDE, "--dem dem.txt --debris d.asc");
    assert!(said.contains("dem.txt: the grid has no header") && said.contains("docs/maps.md"), "{said}");
}
