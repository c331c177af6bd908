//! Frames and collections, read back by the VTK library itself.

use crate::running::{CADEM, DEBRIS, HEAT, LIFE, MOD2, POND, Table, Workplace, report};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use xca_io::lattice::Lattice;
use xca_io::vtk::{DataArray, GHOST_TYPE, HexagonGrid, ghost_types, write_hexagons};

/// Runs the script that reads files with the library.
fn read_by_the_library(files: &[PathBuf]) -> Output {
    let python = Path::new(env!("CARGO_TARGET_TMPDIR")).with_file_name("vtk").join("bin/python");
    let missing =
        format!("{} is not there: run `bash scripts/vtk`, which installs VTK for tests", python.display());
    assert!(python.is_file(), "{missing}");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/programs/vtk_library.py");
    Command::new(python).arg(script).args(files).output().unwrap()
}

/// A run's collection and the frames that it lists, as the library sees them.
struct Run {
    folder: PathBuf,
    frames: Vec<Value>,
    /// The step of each frame.
    steps: Vec<u64>,
}

impl Run {
    /// Runs a program, in a folder whose name needs care, and reads all that it leaves; names and times are
    /// checked here.
    fn of(place: &Workplace, program: &str, options: &str) -> Self {
        let folder = place.path("Läufe vom 1. März/ein \"Würfel\" & mehr");
        let output = place.command(program, options).arg("--out").arg(&folder).output().unwrap();
        assert!(output.status.success(), "{options}: {}", String::from_utf8_lossy(&output.stderr));
        let report = report(&folder);
        let listed = report["files"].as_array().unwrap().iter().map(|file| file.as_str().unwrap());
        let collection = listed.into_iter().find(|file| file.ends_with(".pvd")).unwrap();
        let found = found(&[folder.join(collection)]).remove(0);
        assert_eq!(found["type"], "Collection");
        let files = found["files"].as_array().unwrap().iter().map(|file| file.as_str().unwrap());
        let paths: Vec<PathBuf> = files.map(|file| folder.join(file)).collect();
        let steps: Vec<u64> = paths.iter().map(|path| number_of(path)).collect();
        let last = report["progress"]["steps"].as_u64().unwrap();
        assert_eq!(report["progress"]["frames"].as_u64(), Some(steps.len() as u64));
        assert!(steps[0] == 0 && steps.is_sorted() && steps.last() == Some(&last), "{steps:?}");
        let frames = self::found(&paths);
        let time_step = report["progress"]["time_step"].as_f64();
        // Automata without a time of their own count steps.
        assert_eq!(time_step.is_none(), [DEBRIS, LIFE, MOD2, POND].contains(&program));
        for ((step, frame), of_collection) in
            steps.iter().zip(&frames).zip(found["times"].as_array().unwrap())
        {
            let time = bits(*step as f64 * time_step.unwrap_or(1.0));
            assert_eq!(*of_collection, time, "step {step}");
            // What the library takes for the time of the file, and where it takes it from.
            assert_eq!(frame["times"], json!([time]), "step {step}");
            assert_eq!(frame["field_data"][0], array("TimeValue", "double", 1, 1, time), "step {step}");
            let fields = frame["field_data"].as_array().unwrap().len() - 1;
            assert_eq!(fields > 0, [DEBRIS, POND].contains(&program), "step {step}");
        }
        Self { folder, frames, steps }
    }

    /// The bytes of the only array of each frame of cells; all else about these frames is checked here.
    fn cells(&self, name: &str, kind: &str, extents: [usize; 3], side: f64) -> Vec<Vec<u8>> {
        let [x, y, z] = extents;
        let of_frame = |frame: &Value| {
            assert_eq!(frame["extent"], json!([0, x, 0, y, 0, z]));
            assert_eq!(frame["origin"], json!([bits(0.0), bits(0.0), bits(0.0)]));
            assert_eq!(frame["spacing"], json!([bits(side), bits(side), bits(side)]));
            assert_eq!(
                (&frame["cells"], &frame["points"]),
                (&json!(x * y * z), &json!((x + 1) * (y + 1) * (z + 1)))
            );
            assert_eq!((&frame["scalars"], &frame["point_data"]), (&json!(name), &json!([])));
            let found = &frame["cell_data"][0];
            let bytes = found["bytes"].as_str().unwrap();
            assert_eq!(frame["cell_data"], json!([array(name, kind, 1, x * y * z, bytes.to_owned())]));
            unhex(bytes)
        };
        self.frames.iter().map(of_frame).collect()
    }
}

fn found(files: &[PathBuf]) -> Vec<Value> {
    let output = read_by_the_library(files);
    assert!(
        output.status.success() && output.stderr.is_empty(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The number at the end of a file's name.
fn number_of(path: &Path) -> u64 {
    path.file_stem().unwrap().to_str().unwrap().rsplit('_').next().unwrap().parse().unwrap()
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

fn unhex(text: &str) -> Vec<u8> {
    let digits = text.as_bytes().chunks(2).map(|pair| std::str::from_utf8(pair).unwrap());
    digits.map(|pair| u8::from_str_radix(pair, 16).unwrap()).collect()
}

fn bits(number: f64) -> String {
    hex(&number.to_le_bytes())
}

fn doubles(bytes: &[u8]) -> Vec<f64> {
    bytes.as_chunks().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect()
}

/// An array as the script tells of it.
fn array(name: &str, kind: &str, components: usize, tuples: usize, bytes: String) -> Value {
    json!({"name": name, "type": kind, "components": components, "tuples": tuples, "bytes": bytes})
}

/// A step on a torus: a cell becomes what `rule` makes of itself and of the sum of the cells around it,
/// itself not counted.
fn step_on_a_torus(cells: &[u8], extents: [usize; 3], rule: impl Fn(u8, u32) -> u8) -> Vec<u8> {
    let [nx, ny, nz] = extents;
    let around = |index: usize, extent: usize| [index, (index + 1) % extent, (index + extent - 1) % extent];
    let mut next = Vec::with_capacity(cells.len());
    for index in 0..cells.len() {
        let (x, y, z) = (index % nx, index / nx % ny, index / nx / ny);
        let layers = if nz == 1 { vec![0] } else { around(z, nz).to_vec() };
        let mut sum = 0;
        for z in layers {
            for y in around(y, ny) {
                sum += around(x, nx).map(|x| u32::from(cells[x + nx * (y + ny * z)])).iter().sum::<u32>();
            }
        }
        next.push(rule(cells[index], sum - u32::from(cells[index])));
    }
    next
}

#[test]
fn the_frames_of_life_are_generations_of_life() {
    let place = Workplace::new();
    let run = Run::of(&place, LIFE, "--steps 6 --every 2");
    let mut cells = run.cells("alive", "unsigned char", [256, 256, 1], 1.0).into_iter();
    let mut expected = cells.next().unwrap();
    // A third of them, give or take ten standard deviations.
    let alive = expected.iter().filter(|&&alive| alive == 1).count();
    assert!((18_500..20_900).contains(&alive) && expected.iter().all(|&alive| alive <= 1), "{alive}");
    for (cells, step) in cells.zip(&run.steps[1..]) {
        for _ in 0..2 {
            let rule = |alive, around| u8::from(around == 3 || (around == 2 && alive == 1));
            expected = step_on_a_torus(&expected, [256, 256, 1], rule);
        }
        assert!(cells == expected, "step {step}");
    }
    assert_eq!(run.steps, [0, 2, 4, 6]);
    // Compressed they take little more than a bit for each cell.
    let length = std::fs::metadata(run.folder.join("frames/life_00000006.vti")).unwrap().len();
    assert!(length < 256 * 256 / 4, "{length}");
}

/// The figure has no symmetry, so that axes that change places are seen.
#[test]
fn the_frames_of_the_parity_rule_have_its_figure_where_it_belongs() {
    let place = Workplace::new();
    let run = Run::of(&place, MOD2, "--size 16 --steps 3 --every 1");
    let cells = run.cells("odd", "unsigned char", [16; 3], 1.0);
    let figure = [[8, 8, 8], [9, 8, 8], [10, 8, 8], [10, 9, 8], [10, 9, 9], [8, 8, 9]];
    let mut expected = vec![0; 16 * 16 * 16];
    for [x, y, z] in figure {
        expected[x + 16 * (y + 16 * z)] = 1;
    }
    for (step, cells) in cells.into_iter().enumerate() {
        assert!(cells == expected, "step {step}");
        expected = step_on_a_torus(&expected, [16; 3], |odd, around| (u32::from(odd) + around) as u8 % 2);
    }
    assert_eq!(run.steps, [0, 1, 2, 3]);
}

/// The initial shape is an eigenvector of the scheme: each cell fades by the same factor in each step.
#[test]
fn the_frames_of_heat_hold_the_exact_temperatures() {
    const SIZE: usize = 12;
    let place = Workplace::new();
    let run = Run::of(&place, HEAT, "--size 12 --until 0 --steps 20 --every 5 --checkpoint-every 15");
    let sine = |index: usize| (std::f64::consts::PI * (index + 1) as f64 / (SIZE + 1) as f64).sin();
    let fade = 1.0 - 12.0 * 0.125 * (std::f64::consts::PI / (2 * (SIZE + 1)) as f64).sin().powi(2);
    let cells = run.cells("temperature", "double", [SIZE; 3], 0.1 / (SIZE + 1) as f64);
    for (cells, step) in cells.iter().zip(&run.steps) {
        let temperatures = doubles(cells);
        for (index, temperature) in temperatures.iter().enumerate() {
            let shape = sine(index % SIZE) * sine(index / SIZE % SIZE) * sine(index / SIZE / SIZE);
            let exact = 100.0 * shape * fade.powi(*step as i32);
            assert!(
                (temperature / exact - 1.0).abs() < 1e-12,
                "step {step}, cell {index}: {temperature}, {exact}"
            );
        }
        // To the last bit, as in the checkpoint.
        if *step == 20 {
            let cell = |x: usize, y: usize, z: usize| temperatures[x + SIZE * (y + SIZE * z)];
            for (name, value) in
                [("0,1,2", cell(0, 1, 2)), ("5,11,3", cell(5, 11, 3)), ("6,6,6", cell(6, 6, 6))]
            {
                let words = ["--cell", name, "--json"];
                let output = place.invocation(HEAT, "inspect").arg(&run.folder).args(words).output().unwrap();
                let told: Value = serde_json::from_slice(&output.stdout).unwrap();
                assert_eq!(told["state"]["step"], 20);
                assert_eq!(told["state"]["places"][0]["values"][0]["components"], json!([value]), "{name}");
            }
        }
    }
    assert_eq!(run.steps, [0, 5, 10, 15, 20]);
    let single = Run::of(&place, HEAT, "--size 12 --steps 1 --precision f32");
    let first = single.cells("temperature", "float", [SIZE; 3], 0.1 / (SIZE + 1) as f64).remove(0);
    let rounded: Vec<u8> =
        doubles(&cells[0]).iter().flat_map(|value| (*value as f32).to_le_bytes()).collect();
    assert!(first == rounded);
}

/// Each frame holds the same particles, to the last bit, as the table that a run leaves which ends there.
#[test]
fn the_frames_of_particles_hold_those_of_the_tables() {
    let place = Workplace::new();
    let run = Run::of(&place, CADEM, "--case published --steps 60 --every 30");
    assert_eq!(run.steps, [0, 30, 60]);
    for (step, frame) in run.steps.iter().zip(&run.frames) {
        place.succeed(CADEM, &format!("--case published --steps {step} --out until"));
        let table = Table::read(&place.path("until/final.csv"));
        let particles = table.rows.len();
        let bytes = |columns: [&str; 3]| {
            let columns = columns.map(|name| table.column(name));
            let all = (0..particles).flat_map(|row| columns.each_ref().map(|column| column[row]));
            hex(&all.flat_map(f64::to_le_bytes).collect::<Vec<u8>>())
        };
        let labels: Vec<u8> =
            table.column("label").iter().flat_map(|label| (*label as u32).to_le_bytes()).collect();
        assert!(
            frame["positions"] == array("Points", "double", 3, particles, bytes(["x", "y", "z"])),
            "step {step}"
        );
        let arrays = json!([
            array("label", "unsigned int", 1, particles, hex(&labels)),
            array("velocity", "double", 3, particles, bytes(["vx", "vy", "vz"])),
        ]);
        assert!(frame["point_data"] == arrays, "step {step}");
        assert_eq!((&frame["scalars"], &frame["cell_data"]), (&json!("label"), &json!([])));
        // A vertex for each particle.
        for count in ["points", "cells", "vertices"] {
            assert_eq!(frame[count], particles, "step {step}: {count}");
        }
        assert_eq!(frame["connectivity"], json!((0..particles).collect::<Vec<_>>()));
        assert_eq!(frame["offsets"], json!((0..=particles).collect::<Vec<_>>()));
    }
    // They have moved.
    assert_ne!(run.frames[0]["positions"], run.frames[2]["positions"]);
}

/// Components and states have their names in the library, too.
#[test]
fn the_frames_of_arrays_and_states_have_their_names() {
    let place = Workplace::new();
    let run = Run::of(&place, POND, "--steps 8 --every 4 --formats +asc");
    let last = run.frames.last().unwrap();
    let found = |name: &str| {
        let arrays = last["cell_data"].as_array().unwrap().iter();
        arrays.into_iter().find(|array| array["name"] == name).unwrap()
    };
    let shape = |name: &str| {
        let array = found(name);
        (
            array["type"].as_str().unwrap().to_owned(),
            array["components"].clone(),
            array["component_names"].clone(),
        )
    };
    assert_eq!(shape("ground"), ("unsigned char".to_owned(), json!(1), Value::Null));
    assert_eq!(shape("wet"), ("unsigned char".to_owned(), json!(1), Value::Null));
    let elements = json!(["[0]", "[1]", "[2]", "[3]"]);
    assert_eq!(shape("outflow"), ("double".to_owned(), json!(4), elements));
    let lanes = json!(["[0].x", "[0].y", "[1].x", "[1].y"]);
    assert_eq!(shape("currents"), ("double".to_owned(), json!(4), lanes));
    let names = |name: &str, strings: &[&str]| {
        let (name, tuples) = (format!("states of {name}"), strings.len());
        json!({"name": name, "type": "string", "components": 1, "tuples": tuples, "strings": strings})
    };
    let expected = [names("ground", &["Rock", "Soil", "Mud"]), names("wet", &["false", "true"])];
    assert_eq!(last["field_data"].as_array().unwrap()[1..], expected);
    // The values are those of the grids, row by row from the north.
    let outflow = doubles(&unhex(found("outflow")["bytes"].as_str().unwrap()));
    for element in 0..4 {
        let grid = std::fs::read_to_string(run.folder.join(format!("final_outflow_{element}.asc"))).unwrap();
        let rows: Vec<&str> = grid.lines().skip(6).collect();
        let values = rows.into_iter().rev().flat_map(str::split_whitespace);
        let values: Vec<f64> = values.map(|value| value.parse().unwrap()).collect();
        let of_frame: Vec<f64> = outflow.iter().skip(element).step_by(4).copied().collect();
        assert!(values == of_frame && values.iter().any(|value| *value > 0.0), "{element}");
    }
}

/// What the library finds of hexagons, where the cells are to be: `middle` of a cell by column and row.
fn check_hexagons(
    found: &Value,
    [columns, rows]: [usize; 2],
    side: f64,
    middle: impl Fn(f64, f64) -> [f64; 2],
) {
    let cells = columns * rows;
    let numbers = |name: &str| found[name].as_array().unwrap().iter().map(|number| number.as_f64().unwrap());
    assert_eq!((&found["cells"], &found["points"]), (&json!(cells), &json!(6 * cells)));
    assert_eq!(found["corners"], json!(vec![6; cells]));
    // VTK_POLYGON
    assert_eq!(found["cell_types"], json!(vec![7; cells]));
    let area = 0.75_f64.sqrt() * side * side;
    assert!(numbers("areas").all(|found| (found / area - 1.0).abs() < 1e-9));
    let mut box_of_middles = [f64::MAX, f64::MIN, f64::MAX, f64::MIN];
    for (cell, found) in found["middles"].as_array().unwrap().iter().enumerate() {
        let [x, y] = middle((cell % columns) as f64, (cell / columns) as f64);
        for (found, wanted) in found.as_array().unwrap().iter().zip([x, y, 0.0, 0.0]) {
            assert!((found.as_f64().unwrap() - wanted).abs() < 1e-6 * side, "cell {cell}: {found}, {wanted}");
        }
        let [left, right, low, high] = box_of_middles;
        box_of_middles = [left.min(x), right.max(x), low.min(y), high.max(y)];
    }
    // Half a cell beyond the outermost middles: half a side across flat sides, side / √3 to a corner.
    let around: Vec<f64> =
        numbers("bounds").zip(box_of_middles).map(|(end, middle)| (end - middle).abs()).collect();
    let across = [0.5 * side, side / 3.0_f64.sqrt()];
    for (axis, reach) in [0, 0, 1, 1].into_iter().zip(&around) {
        assert!(across.iter().any(|across| (reach / across - 1.0).abs() < 1e-6), "axis {axis}: {around:?}");
    }
    assert!((around[0] - around[2]).abs() > 0.05 * side);
}

/// Both kinds of hexagons, on a map and with cells without ground.
#[test]
fn hexagons_are_polygons_at_their_place() {
    let place = Workplace::new();
    let (extents, side, corner) = ([5, 4], 3.0, [2600.0, 5100.0]);
    let (half, root) = (side / 2.0, side / 3.0_f64.sqrt());
    let depths: Vec<f64> = (0..20).map(f64::from).collect();
    let hidden: Vec<bool> = (0..20).map(|cell| cell == 7).collect();
    let ghosts = ghost_types(&hidden);
    let arrays = [DataArray::new("depth", &depths[..]), DataArray::new(GHOST_TYPE, &ghosts[..])];
    for (lattice, name) in [(Lattice::HexagonRows, "rows.vtp"), (Lattice::HexagonColumns, "columns.vtp")] {
        let grid = HexagonGrid { cells: [5, 4, 1], lattice, corner, side };
        let path = place.path(name);
        write_hexagons(&path, 1.5, &grid, &arrays).unwrap();
        let found = found(&[path]).remove(0);
        let middle = |column: f64, row: f64| match lattice {
            Lattice::HexagonRows => {
                [corner[0] + half + column * side + row % 2.0 * half, corner[1] + root + row * 1.5 * root]
            }
            _ => {
                [corner[0] + root + column * 1.5 * root, corner[1] + half + row * side + column % 2.0 * half]
            }
        };
        check_hexagons(&found, extents, side, middle);
        let bytes = hex(&depths.iter().flat_map(|depth| depth.to_le_bytes()).collect::<Vec<u8>>());
        let mut marks = [0_u8; 20];
        marks[7] = 32;
        let wanted = json!([
            array("depth", "double", 1, 20, bytes),
            array("vtkGhostType", "unsigned char", 1, 20, hex(&marks)),
        ]);
        assert_eq!((&found["cell_data"], &found["scalars"]), (&wanted, &json!("depth")));
        assert_eq!((&found["times"], &found["point_data"]), (&json!([bits(1.5)]), &json!([])));
        let fields = found["field_data"].as_array().unwrap().iter();
        let fields: Vec<(&str, Vec<f64>)> = fields
            .map(|field| (field["name"].as_str().unwrap(), doubles(&unhex(field["bytes"].as_str().unwrap()))))
            .collect();
        let axis = if lattice == Lattice::HexagonRows { 1.0 } else { 0.0 };
        let wanted = [
            ("TimeValue", vec![1.5]),
            ("extents", vec![5.0, 4.0, 1.0]),
            ("corner", corner.to_vec()),
            ("side", vec![side]),
            ("stagger axis", vec![axis]),
        ];
        assert_eq!(fields, wanted);
    }
}

/// The values stand in the order of the cells: the altitudes of the last frame are those of the grid of the
/// run.
#[test]
fn the_frames_of_hexagons_hold_the_cells_of_the_run() {
    let place = Workplace::new();
    let run = Run::of(&place, DEBRIS, "--steps 2 --every 2 --formats +asc");
    let last = run.frames.last().unwrap();
    let root = 5.0 / 3.0_f64.sqrt();
    let middle = |column: f64, row: f64| [2.5 + 5.0 * column + row % 2.0 * 2.5, root * (1.0 + 1.5 * row)];
    check_hexagons(last, [120, 200], 5.0, middle);
    let altitude =
        last["cell_data"].as_array().unwrap().iter().find(|array| array["name"] == "altitude").unwrap();
    let grid = std::fs::read_to_string(run.folder.join("final_altitude.asc")).unwrap();
    let rows: Vec<&str> = grid.lines().skip(6).collect();
    let values = rows.into_iter().rev().flat_map(str::split_whitespace);
    let values: Vec<f64> = values.map(|value| value.parse().unwrap()).collect();
    assert!(values.len() == 24_000 && doubles(&unhex(altitude["bytes"].as_str().unwrap())) == values);
}

/// That the tests above could fail.
#[test]
fn the_library_complains_of_damaged_frames() {
    let place = Workplace::new();
    let run = Run::of(&place, MOD2, "--size 8 --steps 1");
    let whole = std::fs::read(run.folder.join("frames/parity_00000001.vti")).unwrap();
    let damaged = place.path("damaged.vti");
    std::fs::write(&damaged, &whole[..whole.len() - 50]).unwrap();
    let output = read_by_the_library(&[damaged]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success() && said.contains("VTK complains of "), "{said}");
}
