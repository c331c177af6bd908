//! Cells without ground, in all that a run reads and writes.

use super::island::{floats, header, is_land, island, matrix, matrix_of, rows};
use crate::running::{LANDSLIDE, Table, Workplace, report, vtk_array};
use serde_json::{Value, json};
use std::fs;

const LAVA: &str = env!("CARGO_BIN_EXE_lava");
const WILDFIRE: &str = env!("CARGO_BIN_EXE_wildfire");

#[test]
fn cells_without_ground_are_seen_in_no_file() {
    let place = Workplace::new();
    island(&place);
    place.succeed(
        LANDSLIDE,
        "--dem g.asc --debris d.asc --until=-1 --steps 30 --every 30 --checkpoint-every 20",
    );
    let folder = place.path("out/landslide");
    // The altitude of what nothing climbs is nowhere.
    let sea = "-9999 -9999 -9999 -9999 -9999";
    let land = "-9999 500 501 502 -9999";
    assert_eq!(rows(&place, "out/landslide/final_altitude.asc"), [sea, land, land, land, sea]);
    for file in ["final_thickness.asc", "final_outflow_0.asc"] {
        let rows = rows(&place, &format!("out/landslide/{file}"));
        assert_eq!((rows[0].as_str(), rows[4].as_str()), (sea, sea));
        assert!(
            rows[1..4].iter().all(|row| row.starts_with("-9999 ") && row.ends_with(" -9999")),
            "{rows:?}"
        );
    }
    let frame = folder.join("frames/landslide_00000030.vti");
    let (altitude, thickness) = (floats(&frame, "altitude"), floats(&frame, "thickness"));
    let ghosts = vtk_array(&frame, "vtkGhostType");
    for cell in 0..25 {
        assert_eq!(ghosts[cell], if is_land(cell) { 0 } else { 32 }, "{cell}");
        assert_eq!(altitude[cell].is_nan(), !is_land(cell), "{cell}");
        assert_eq!(thickness[cell].is_nan(), !is_land(cell), "{cell}");
    }
    // Volume is kept: nothing has gone over the edge.
    let volume: f64 = thickness.iter().filter(|thickness| !thickness.is_nan()).sum();
    assert!((volume - 5.0).abs() < 1e-12, "{volume}");
    let map = report(&folder)["map"].clone();
    assert_eq!(map, json!({"corner": [2600.0, 5100.0], "cell_side": 10.0, "cells_without_ground": 16}));
}

#[test]
fn cells_without_ground_are_seen_in_no_statistic() {
    let place = Workplace::new();
    island(&place);
    place.succeed(
        LANDSLIDE,
        "--dem g.asc --debris d.asc --until=-1 --steps 30 --every 30 --checkpoint-every 20",
    );
    let inspect = |words: &str| -> Value {
        let output = place.invocation(LANDSLIDE, &format!("inspect {words} --json")).output().unwrap();
        serde_json::from_slice(&output.stdout).unwrap()
    };
    let of_altitude = |found: &Value| {
        let substates = found["state"]["substates"].as_array().unwrap();
        assert!(substates.iter().all(|substate| !substate["name"].as_str().unwrap().contains("Ghost")));
        substates[0].clone()
    };
    let checkpoint = inspect("out/landslide");
    fs::remove_dir_all(place.path("out/landslide/checkpoints")).unwrap();
    for found in [checkpoint, inspect("out/landslide")] {
        let altitude = of_altitude(&found);
        assert!(altitude["name"].as_str().unwrap().ends_with(".altitude"), "{altitude}");
        assert_eq!(altitude["count"], 9, "{altitude}");
        let [least, mean, largest] = ["least", "mean", "largest"].map(|key| altitude[key].as_f64());
        assert_eq!([least, mean, largest], [Some(500.0), Some(501.0), Some(502.0)]);
        assert_eq!(altitude["not_numbers"], 0);
    }
    // Default observables.
    let fuel = format!("{}1 1 0.5\n-9999 1 0.25\n", header([3, 2], [0.0, 0.0]));
    place.write("fuel.asc", &fuel);
    place.succeed(WILDFIRE, "--fuel fuel.asc --steps 0");
    let series = Table::read(&place.path("out/wildfire/observables.csv"));
    assert_eq!(
        [series.last("fuel_min"), series.last("fuel_mean"), series.last("fuel_max")],
        [0.25, 0.75, 1.0]
    );
    assert_eq!(series.last("cover_Bare"), 0.0);
    // The fire begins where there is ground.
    assert_eq!(series.last("cover_Burning"), 1.0);
}

#[test]
fn nothing_lies_where_there_is_no_ground() {
    let place = Workplace::new();
    island(&place);
    let header = header([5, 5], [2600.0, 5100.0]);
    place.write("beside.asc", &format!("{header}{}", matrix(5, 2, "5")));
    place.write("corner.asc", &format!("{header}{}", matrix(5, 20, "0.25")));
    place.write("hole.asc", &format!("{header}{}", matrix(5, 2, "-9999")));
    let refused = |options: &str, wanted: &str| {
        let said = place.fail(2, LANDSLIDE, options);
        assert!(said.contains(wanted) && said.contains("has no ground"), "{said}");
    };
    refused(
        "--dem g.asc --debris beside.asc",
        "beside.asc: 5 in column 3, row 1 from the north, where g.asc has",
    );
    refused("--dem g.asc --debris corner.asc", "corner.asc: 0.25 in column 1, row 5 from the north");
    refused("--dem g.asc --debris d.asc --initial thickness=beside.asc", "beside.asc: 5 in column 3, row 1");
    // No value is no debris, and the model keeps what stands where there is no ground.
    place.succeed(LANDSLIDE, "--dem g.asc --debris hole.asc --steps 0");
    place.succeed(LANDSLIDE, "--dem g.asc --debris d.asc --initial altitude=g.asc --steps 5 --out begun");
    place.succeed(LANDSLIDE, "--dem g.asc --debris d.asc --steps 5 --out plain");
    assert_eq!(rows(&place, "begun/final_thickness.asc"), rows(&place, "plain/final_thickness.asc"));
    let said = place.fail(2, LAVA, "--dem g.asc --vent 0,0");
    assert!(said.contains("cell 0,0 has no ground (NODATA) for a vent"), "{said}");
    place.succeed(LAVA, "--dem g.asc --steps 5");
    assert!(rows(&place, "out/lava/final_altitude.asc")[0].starts_with("-9999 -9999"));
}

#[test]
fn numbers_that_are_no_altitudes_are_never_ground() {
    let place = Workplace::new();
    let header = header([5, 5], [0.0, 0.0]);
    place.write("d.asc", &format!("{header}{}", matrix(5, 12, "5")));
    let ground = |header: &str, text: &str| {
        place.write("g.asc", &format!("{header}{}", matrix_of("500", 5, 11, text)));
    };
    let without = header.replace("NODATA_value -9999\n", "");
    for (header, text) in [
        (without.as_str(), "-9999"),
        (&header.replace("-9999", "-3.4e+38"), "-3.4028234663852886e+38"),
        (&header.replace("-9999", "-1.797693e+308"), "-1.7976931348623157e+308"),
    ] {
        ground(header, text);
        place.succeed(LANDSLIDE, "--dem g.asc --debris d.asc --steps 20");
        let rows = rows(&place, "out/landslide/final_altitude.asc");
        assert_eq!(rows[2], "500 -9999 500 500 500", "{text}");
        // Were it an altitude, another number would stand for no value.
        assert!(place.read("out/landslide/final_altitude.asc").contains("NODATA_value -9999\n"), "{text}");
        let series = Table::read(&place.path("out/landslide/observables.csv"));
        assert!(series.last("largest_thickness") <= 5.0);
        assert_eq!(series.last("volume"), 500.0);
    }
    for (text, wanted) in [
        ("inf", "g.asc:9: `inf` is not a finite number"),
        ("1e309", "g.asc:9: `1e309` is not a finite number"),
        ("-32768e3", "g.asc: -32768000 in column 2, row 3 from the north is not an altitude in m"),
        ("1e6", "g.asc: 1000000 in column 2, row 3 from the north is not an altitude in m"),
        ("-32768", "g.asc: -32768 in column 2, row 3 from the north is not an altitude in m"),
        ("32767", "g.asc: 32767 in column 2, row 3 from the north is not an altitude in m"),
        ("99999", "g.asc: 99999 in column 2, row 3 from the north is not an altitude in m"),
    ] {
        ground(&header, text);
        let said = place.fail(2, LANDSLIDE, "--dem g.asc --debris d.asc");
        assert!(said.contains(wanted), "{said}");
        let said = place.fail(2, LAVA, "--dem g.asc");
        assert!(said.contains(wanted), "{said}");
    }
}

#[test]
fn no_layer_is_thinner_than_nothing() {
    let place = Workplace::new();
    let header = header([5, 5], [0.0, 0.0]);
    place.write("g.asc", &format!("{header}{}", matrix_of("500", 5, 11, "510")));
    place.write("d.asc", &format!("{header}{}", matrix(5, 12, "5")));
    let other = header.replace("-9999", "-1");
    for (header, number) in [(&header, "-5"), (&other, "-9999"), (&header, "-1e-3")] {
        place.write("below.asc", &format!("{header}{}", matrix(5, 7, number)));
        let number: f64 = number.parse().unwrap();
        let file = format!("below.asc: a thickness of {number} m in column 3, row 2 from the north");
        let said = place.fail(2, LANDSLIDE, "--dem g.asc --debris below.asc");
        assert!(said.contains(&file), "{said}");
        let said = place.fail(2, LANDSLIDE, "--dem g.asc --debris d.asc --observed below.asc");
        assert!(said.contains(&file), "{said}");
        // `--initial` reads any number; the model refuses it.
        let state = format!("a thickness of {number} m in cell [2, 3, 0]; it must be at least 0");
        let said = place.fail(2, LANDSLIDE, "--dem g.asc --debris d.asc --initial thickness=below.asc");
        assert!(said.contains(&state), "{said}");
        let said = place.fail(2, LAVA, "--dem g.asc --initial thickness=below.asc");
        assert!(said.contains(&state), "{said}");
    }
    place.write("much.asc", &format!("{header}{}", matrix(5, 7, "32767")));
    let said = place.fail(2, LANDSLIDE, "--dem g.asc --debris much.asc");
    assert!(said.contains("much.asc: a thickness of 32767 m in column 3, row 2 from the north"), "{said}");
    assert!(!place.path("out").exists());
}

#[test]
fn what_reaches_the_edge_is_told() {
    let place = Workplace::new();
    let dem = |north: &str| {
        let rows: Vec<String> = (0..9).map(|row| vec![(900 - 50 * row).to_string(); 9].join(" ")).collect();
        let ground = format!("{}{north}\n{}\n", header([9, 9], [0.0; 2]), rows[1..].join("\n"));
        place.write("g.asc", &ground);
    };
    dem(&["900"; 9].join(" "));
    place.write("d.asc", &format!("{}{}", header([9, 9], [0.0; 2]), matrix(9, 40, "8")));
    let at_edge = |options: &str| {
        let said = place.succeed(LANDSLIDE, &format!("--dem g.asc --debris d.asc {options}"));
        assert!(said.contains("debris_at_edge"), "{said}");
        Table::read(&place.path("out/landslide/observables.csv")).last("debris_at_edge")
    };
    assert_eq!(at_edge("--steps 0"), 0.0);
    let thickness = || rows(&place, "out/landslide/final_thickness.asc");
    let found = at_edge("--steps 2000 --until 1e-6");
    let count = |row: &str| row.split(' ').filter(|cell| cell.parse::<f64>().unwrap() > 0.0).count();
    let rows = thickness();
    let sides = |row: &String| {
        let cells: Vec<&str> = row.split(' ').collect();
        count(&format!("{} {}", cells[0], cells[8]))
    };
    let wanted = count(&rows[0]) + count(&rows[8]) + rows[1..8].iter().map(sides).sum::<usize>();
    assert!(found > 0.0 && found == wanted as f64, "{found} {wanted}");
    // Beside a cell without ground, in the middle of the map.
    let ground = place.read("g.asc");
    let row = ["700"; 9].join(" ");
    place.write("g.asc", &ground.replace(&row, "700 700 700 700 700 -9999 700 700 700"));
    assert_eq!(at_edge("--steps 0"), 1.0);
    let output = place.run(LAVA, "--dem g.asc --steps 5");
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success() && said.contains("lava_at_edge"), "{said}");
    let warned = String::from_utf8(output.stderr).unwrap();
    let warning = "lava has reached the edge of the map and piles up there; use a larger map (lava_at_edge: ";
    let line = warned.lines().find(|line| line.starts_with("warning: lava")).unwrap_or_default();
    assert!(line.starts_with(&format!("warning: {warning}")) && line.ends_with(" cells)"), "{warned}");
    let report = report(&place.path("out/lava"));
    assert!(report["warnings"][0].as_str().unwrap().starts_with(warning), "{report}");
    assert_eq!(Table::read(&place.path("out/lava/observables.csv")).column("lava_at_edge")[0], 1.0);
}
