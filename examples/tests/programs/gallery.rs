//! Each program of the gallery runs, draws its first and last state, and keeps what its model keeps.

use crate::running::{Pixels, Table, Workplace};
use std::collections::BTreeSet;
use std::fs;

/// A program with options that make its run short.
struct Short {
    name: &'static str,
    path: &'static str,
    options: &'static str,
}

macro_rules! short {
    ($name:literal, $options:literal) => {
        Short { name: $name, path: env!(concat!("CARGO_BIN_EXE_", $name)), options: $options }
    };
}

const GALLERY: [Short; 11] = [
    short!("boltzmann", "--steps 2"),
    short!("cavity", "--steps 5 --size 16"),
    short!("debris", "--steps 20"),
    short!("elementary", "--rule 110 --width 41 --steps 20"),
    short!("excitable", "--steps 3"),
    short!("ising", "--steps 3"),
    short!("lava", "--steps 20 --vent 60,75 --vent 80,70"),
    short!("predators", "--steps 5"),
    short!("reaction", "--steps 3"),
    short!("sandpile", "--grains 500 --size 31"),
    short!("wildfire", "--steps 5"),
];

/// Programs with tests of their own.
const OTHERS: [&str; 6] = ["cadem", "heat", "landslide", "life", "mod2", "pond"];

#[test]
fn programs_of_the_gallery_run() {
    for Short { name, path, options } in GALLERY {
        let place = Workplace::new();
        place.succeed(path, options);
        for picture in ["initial.png", "final.png"] {
            assert!(place.path(&format!("out/{name}/{picture}")).exists(), "{name}: {picture}");
        }
    }
}

#[test]
fn no_program_is_missing() {
    let known: BTreeSet<String> =
        GALLERY.iter().map(|short| short.name).chain(OTHERS).map(str::to_owned).collect();
    let there: BTreeSet<String> = fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/src/bin"))
        .unwrap()
        .map(|entry| entry.unwrap().path().file_stem().unwrap().to_str().unwrap().to_owned())
        .collect();
    assert_eq!(known, there);
}

/// All grains are on the table or have fallen off it, and the pile ends stable.
#[test]
fn the_sandpile_keeps_its_grains() {
    let place = Workplace::new();
    let said = place.succeed(GALLERY[9].path, "--grains 3000 --size 31");
    assert!(said.contains("the pile is stable"), "{said}");
    let series = Table::read(&place.path("out/sandpile/observables.csv"));
    assert!(series.column("grains").iter().all(|grains| *grains == 3000.0));
    assert_eq!(series.last("unstable"), 0.0);
    assert!(series.last("lost") > 0.0);
}

/// From one cell, rule 90 draws Pascal's triangle modulo 2: by Lucas, a binomial coefficient is odd where the
/// bits of k are among those of n. All rows are of the same height.
#[test]
fn a_model_of_one_row_is_drawn_in_space_and_time() {
    let (width, steps) = (41, 20);
    let place = Workplace::new();
    place.succeed(GALLERY[3].path, &format!("--rule 90 --width {width} --steps {steps}"));
    let picture = Pixels::read(&place.path("out/elementary/final_spacetime.png"));
    let is_on = |pixel: &[u8; 3]| *pixel == [20, 30, 60];
    let places: Vec<[usize; 2]> = picture
        .colours
        .iter()
        .enumerate()
        .filter(|(_, pixel)| is_on(pixel))
        .map(|(place, _)| [place % picture.width, place / picture.width])
        .collect();
    // The legend has the same colour, to the right of the drawing; the triangle begins and ends at its
    // borders.
    let left = places.iter().map(|[x, _]| *x).min().unwrap();
    let top = places.iter().find(|[x, _]| *x < left + 41 * 18).unwrap()[1];
    let mut checked = 0;
    for step in 0..=steps {
        for cell in 0..width {
            let [x, y] = [left + 18 * cell + 9, top + 18 * step + 9];
            let from_left = (cell + step).wrapping_sub(20);
            let wanted =
                from_left <= 2 * step && from_left % 2 == 0 && (from_left / 2) & step == from_left / 2;
            assert_eq!(is_on(&picture.colours[y * picture.width + x]), wanted, "step {step}, cell {cell}");
            checked += usize::from(wanted);
        }
    }
    // The sum of 2 to the number of ones of each step.
    assert_eq!(checked, 103);
}

/// What a set-up computes from a parameter follows `--set`; what it cannot is refused.
#[test]
fn set_reaches_all_that_a_set_up_computes() {
    let place = Workplace::new();
    let [cavity, elementary] = [GALLERY[1].path, GALLERY[3].path];
    let [lava, wildfire] = [GALLERY[6].path, GALLERY[10].path];
    // Steps of half a minute.
    place.succeed(lava, "--set clock=30 --steps 4");
    let series = Table::read(&place.path("out/lava/observables.csv"));
    assert_eq!([series.last("step"), series.last("time")], [4.0, 120.0]);
    // The title of the picture is that of the rule.
    let picture = |options: &str| {
        place.succeed(elementary, &format!("{options} --width 31 --steps 3"));
        fs::read(place.path("out/elementary/final.png")).unwrap()
    };
    let by_option = picture("--rule 90");
    assert!(by_option == picture("--set number=90") && by_option != picture("--rule 30"));
    for (path, options, wanted) in [
        (cavity, "--set size=100", "the parameter `size` is computed from others"),
        (
            lava,
            "--set vent_temperature=1000",
            "`vent_temperature` is 1000 K, but must be above `solid_temperature`",
        ),
        (lava, "--set solid_temperature=1360", "1360 K, but must be above `solid_temperature`, 1360 K"),
        (wildfire, "--set wind=1e300,0", "`wind` is 1e300, but must be at least -150 and at most 150 (m/s)"),
        (wildfire, "--set slope_effect=-1", "`slope_effect` is -1, but must be at least 0 and at most 1"),
        (wildfire, "--set wind_effects=0.1,2", "`wind_effects` is 2, but must be at least 0 and at most 1"),
    ] {
        let said = place.fail(2, path, options);
        assert!(said.contains(wanted), "{options}: {said}");
    }
}

#[test]
fn maps_of_the_gallery() {
    let place = Workplace::new();
    let header = "ncols 4\nnrows 3\nxllcorner 100\nyllcorner 200\ncellsize 10\nNODATA_value -9999\n";
    place.write("ground.asc", &format!("{header}9 8 7 6\n9 30 7 6\n9 8 7 -9999\n"));
    place.write("fuel.asc", &format!("{header}1 1 1 1\n1 1 0.5 1\n1 1 1 -9999\n"));
    place.write("much.asc", &format!("{header}1 1 1 1\n1 1 1.5 1\n1 1 1 1\n"));
    let [lava, wildfire] = [GALLERY[6].path, GALLERY[10].path];
    // The highest cell is the vent: it gives its lava before the first step.
    place.succeed(lava, "--dem ground.asc --steps 0");
    let grid = place.read("out/lava/final_thickness.asc");
    assert!(grid.starts_with("ncols 4\nnrows 3\nxllcorner 100\nyllcorner 200\ncellsize 10\n"), "{grid}");
    let rows: Vec<&str> = grid.lines().skip(6).collect();
    assert_eq!(rows, ["0 0 0 0", "0 4.5 0 0", "0 0 0 -9999"]);
    assert!(place.fail(2, lava, "--dem ground.asc --vent 4,0").contains("no cell 4,0 for a vent"));
    assert!(place.fail(2, lava, "--vent 4").contains("it must be a column and a row"));
    assert!(place.fail(2, lava, "--rate=-1").contains("it must be a finite number at least 0"));
    place.succeed(wildfire, "--fuel fuel.asc --steps 1");
    let said = place.fail(2, wildfire, "--fuel much.asc");
    assert!(
        said.contains("much.asc: fuel of 1.5 in column 3, row 2 from the north; it must be from 0 to 1"),
        "{said}"
    );
}
