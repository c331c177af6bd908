//! Maps that lie somewhere and end somewhere: the place of a run, and cells without ground in all that it writes.

use crate::running::{LANDSLIDE, LIFE, POND, Table, Workplace, report, vtk_array};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

const LAVA: &str = env!("CARGO_BIN_EXE_lava");
const WILDFIRE: &str = env!("CARGO_BIN_EXE_wildfire");

/// A header of so many cells of 10 m, with its south-west corner there.
fn header([columns, rows]: [usize; 2], [x, y]: [f64; 2]) -> String {
    format!("ncols {columns}\nnrows {rows}\nxllcorner {x}\nyllcorner {y}\ncellsize 10\nNODATA_value -9999\n")
}

/// An island: 3 x 3 cells of ground in the middle of 5 x 5, and debris in the middle of it.
fn island(place: &Workplace) {
    let sea = "-9999 -9999 -9999 -9999 -9999";
    let land = "-9999 500 501 502 -9999";
    let header = header([5, 5], [2600.0, 5100.0]);
    place.write("g.asc", &format!("{header}{sea}\n{land}\n{land}\n{land}\n{sea}\n"));
    place.write("d.asc", &format!("{header}{}", matrix(5, 12, "5")));
}

/// A square of zeros, with this text in the cell with that number from the north-west.
fn matrix(side: usize, cell: usize, text: &str) -> String {
    matrix_of("0", side, cell, text)
}

/// The same of another number.
fn matrix_of(number: &str, side: usize, cell: usize, text: &str) -> String {
    let row = |y: usize| {
        let cells: Vec<&str> = (0..side).map(|x| if y * side + x == cell { text } else { number }).collect();
        format!("{}\n", cells.join(" "))
    };
    (0..side).map(row).collect()
}

/// The rows of a grid, the northernmost first.
fn rows(place: &Workplace, file: &str) -> Vec<String> {
    place.read(file).lines().skip(6).map(str::to_owned).collect()
}

fn floats(path: &Path, name: &str) -> Vec<f64> {
    let bytes = vtk_array(path, name);
    bytes.chunks_exact(8).map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap())).collect()
}

/// The cells of the island, from the south.
fn is_land(cell: usize) -> bool {
    (1..4).contains(&(cell % 5)) && (1..4).contains(&(cell / 5))
}

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

/// Width and pixels of a picture.
fn pixels(path: &Path) -> (usize, Vec<[u8; 3]>) {
    let mut reader =
        png::Decoder::new(std::io::BufReader::new(fs::File::open(path).unwrap())).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    (info.width as usize, pixels.as_chunks::<3>().0.to_vec())
}

/// The colours of the pixel in the middle of each cell of a slice of a map.
fn colours(path: &Path, [columns, rows]: [usize; 2]) -> Vec<[u8; 3]> {
    let (width, pixels) = pixels(path);
    // The drawing begins 96 pixels from the left and 120 from the top; a cell has the same whole number of pixels each way.
    let side = 768 / columns.max(rows);
    let colour = |cell: usize| {
        let (x, y) =
            (96 + (cell % columns) * side + side / 2, 120 + (rows - 1 - cell / columns) * side + side / 2);
        pixels[y * width + x]
    };
    (0..columns * rows).map(colour).collect()
}

/// The ticks are at the pixels of eastings and northings: 153 pixels are 10 m.
#[test]
fn pictures_on_a_map_have_its_coordinates() {
    let place = Workplace::new();
    island(&place);
    for file in ["g.asc", "d.asc"] {
        let text = place.read(file).replace("xllcorner 2600", "xllcorner 2602");
        place.write(file, &text.replace("yllcorner 5100", "yllcorner 5101"));
    }
    place.succeed(LANDSLIDE, "--dem g.asc --debris d.asc --steps 0");
    let (width, pixels) = pixels(&place.path("out/landslide/final.png"));
    let is_dark = |x: usize, y: usize| pixels[y * width + x][0] < 100;
    let below: Vec<usize> = (0..96 + 765).filter(|x| is_dark(*x, 120 + 765 + 4)).collect();
    let beside: Vec<usize> = (120..120 + 765).filter(|y| is_dark(96 - 5, *y)).collect();
    // Every 5 m: the first ticks are 2605 and 5105, 3 and 4 m from the corner.
    let wanted = |first: usize| (0..10).map(move |i| 153 * (first + 5 * i) / 10);
    assert_eq!(below, wanted(3).map(|at| 96 + at).collect::<Vec<_>>());
    assert_eq!(beside, wanted(4).rev().map(|at| 120 + 764 - at).collect::<Vec<_>>());
}

#[test]
fn pictures_show_the_background_where_there_is_no_ground() {
    let place = Workplace::new();
    island(&place);
    place.succeed(LANDSLIDE, "--dem g.asc --debris d.asc --steps 10");
    let seen = colours(&place.path("out/landslide/final.png"), [5, 5]);
    for (cell, colour) in seen.iter().enumerate() {
        assert_eq!(*colour == [255; 3], !is_land(cell), "{cell}: {colour:?}");
    }
    // A slope of 1 in 10 is seen as one: the wall around it is not in the relief.
    let beside = colours(&place.path("out/landslide/initial.png"), [5, 5]);
    assert!(beside[6] != [255; 3] && beside[11].iter().all(|lane| *lane > 100), "{beside:?}");
    // The same from what the run has saved, and of another substate, on the scale of the ground.
    let drawn =
        place.invocation(LANDSLIDE, "render out/landslide --substate altitude --out drawn").output().unwrap();
    assert!(drawn.status.success(), "{}", String::from_utf8_lossy(&drawn.stderr));
    let seen = colours(&place.path("drawn/frames/frame_00000010.png"), [5, 5]);
    assert_eq!([seen[0], seen[4], seen[24]], [[255; 3]; 3]);
    // 500 and 502 are the ends of the scale.
    let brightness = |colour: [u8; 3]| colour.iter().map(|lane| u32::from(*lane)).sum::<u32>();
    assert!(brightness(seen[8]) > brightness(seen[6]) + 100, "{seen:?}");
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
        ("-32768e3", "g.asc: -32768000 in column 2, row 3 from the north is no altitude in m"),
        ("1e6", "g.asc: 1000000 in column 2, row 3 from the north is no altitude in m"),
    ] {
        ground(&header, text);
        let said = place.fail(2, LANDSLIDE, "--dem g.asc --debris d.asc");
        assert!(said.contains(wanted), "{said}");
        let said = place.fail(2, LAVA, "--dem g.asc");
        assert!(said.contains(wanted), "{said}");
    }
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
    let said = place.succeed(LAVA, "--dem g.asc --steps 5");
    assert!(said.contains("lava_at_edge"), "{said}");
    assert_eq!(Table::read(&place.path("out/lava/observables.csv")).column("lava_at_edge")[0], 1.0);
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
    assert!(said.contains("NAME:NUMBER, such as thickness:0=lava.asc"), "{said}");
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

/// While a resumed run is under way, its folder has no file of the end.
#[test]
fn a_resumed_run_leaves_no_earlier_end() {
    let place = Workplace::new();
    let ends = |run: &str| {
        let entries = fs::read_dir(place.path(run)).unwrap().map(|entry| entry.unwrap().file_name());
        entries.filter(|name| name.to_str().unwrap().starts_with("final")).count()
    };
    for (program, run) in [(LANDSLIDE, "slide"), (LIFE, "life")] {
        let options = format!("--formats +asc --steps 200000 --every 5 --checkpoint-every 5 --out {run}");
        let frames = || fs::read_dir(place.path(run).join("frames")).map_or(0, Iterator::count);
        let wait = |count: usize| {
            let begin = Instant::now();
            while frames() < count {
                assert!(begin.elapsed() < Duration::from_secs(60), "the run does not get on");
                std::thread::sleep(Duration::from_millis(5));
            }
        };
        let child = place.command(program, &options).arg("--quiet").spawn().unwrap();
        wait(4);
        let sent =
            std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
        assert!(sent.success());
        assert_eq!(child.wait_with_output().unwrap().status.code(), Some(130));
        assert!(ends(run) > 1, "{program}");
        let before = frames();
        let mut child = place.invocation(program, &format!("resume {run} --quiet")).spawn().unwrap();
        wait(before + 2);
        child.kill().unwrap();
        child.wait().unwrap();
        assert_eq!(ends(run), 0, "{program}");
    }
}
