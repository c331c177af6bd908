//! What runs leave behind.

use crate::running::{CADEM, HEAT, LIFE, MOD2, Table, Workplace, check_files, report, vtk_array};
use std::fs;

#[test]
fn every_program_leaves_complete_files() {
    let place = Workplace::new();
    for (name, program, options, steps) in [
        ("life", LIFE, "--steps 30", 30),
        ("mod2", MOD2, "--size 16 --steps 5", 5),
        ("heat", HEAT, "--size 12 --until 70", 20),
        ("cadem", CADEM, "--steps 45 --every 10", 45),
    ] {
        let said = place.succeed(program, options);
        let folder = place.path("out").join(name);
        check_files(&folder);
        let report = report(&folder);
        assert_eq!(report["progress"]["steps"], steps, "{name}");
        assert_eq!(report["program"], name);
        assert!(report["progress"]["steps_per_second"].as_f64().unwrap() > 0.0);
        for text in
            ["quantity", "initial", "final", &format!("{steps} steps"), "observables.csv", "cpu engine"]
        {
            assert!(said.contains(text), "{text}: {said}");
        }
    }
}

#[test]
fn the_report_of_cadem_tells_everything() {
    let place = Workplace::new();
    place.succeed(
        CADEM,
        "--case published --steps 4 --every 2 --seed 3 --threads 2 --set damping=0.5 --slots 30 --out a/b",
    );
    let folder = place.path("a/b");
    let report = report(&folder);
    for (pointer, value) in [
        ("/options/case", "\"published\""),
        ("/options/slots", "30"),
        ("/configuration/walls", "\"per-slot\""),
        ("/parameters/damping", "0.5"),
        ("/parameters/stiffness", "100.0"),
        ("/parameters/time_step", "0.0001"),
        ("/engine", "\"cpu\""),
        ("/threads", "2"),
        ("/precision", "\"f64\""),
        ("/seed", "3"),
        ("/every", "2"),
        ("/progress/outcome", "\"done\""),
        ("/progress/frames", "3"),
        ("/model/groups/0/slots", "30"),
    ] {
        assert_eq!(report.pointer(pointer).unwrap().to_string(), value, "{pointer}");
    }
    // 17 digits, by label, as many rows as particles.
    let text = fs::read_to_string(folder.join("final.csv")).unwrap();
    assert!(text.starts_with("label,x,y,z,vx,vy,vz\n1,"));
    let particles = Table::read(&folder.join("final.csv"));
    let labels = particles.column("label");
    assert!(labels.windows(2).all(|pair| pair[0] < pair[1]));
    let observables = Table::read(&folder.join("observables.csv"));
    assert_eq!(labels.len() as f64, observables.last("particles"));
    assert_eq!(observables.column("step"), [0.0, 2.0, 4.0]);
    let field = text.lines().nth(1).unwrap().split(',').nth(1).unwrap();
    assert_eq!(field.split('e').next().unwrap().len(), 18, "{field}");
    // The last frame shows the same particles.
    let frame = folder.join("frames/particles_00000004.vtp");
    let points = vtk_array(&frame, "Points");
    assert_eq!(points.len(), labels.len() * 24);
    assert_eq!(f64::from_le_bytes(points[..8].try_into().unwrap()), particles.column("x")[0]);
    assert_eq!(vtk_array(&frame, "velocity").len(), points.len());
}

#[test]
fn a_run_starts_where_another_ended() {
    for precision in ["f64", "f32"] {
        let place = Workplace::new();
        let first = format!("--case published --steps 120 --precision {precision} --out first");
        place.succeed(CADEM, &first);
        let next = format!(
            "--case published --particles first/final.csv --allow-overlaps --steps 0 --precision {precision} --out next"
        );
        place.succeed(CADEM, &next);
        let end = Table::read(&place.path("first/observables.csv")).rows.pop().unwrap();
        let start = Table::read(&place.path("next/observables.csv")).rows.remove(0);
        assert_eq!(end[2..], start[2..], "{precision}");
        assert_eq!(place.read("first/final.csv"), place.read("next/final.csv"), "{precision}");
    }
}

#[test]
fn a_new_run_replaces_the_files_of_the_old_one() {
    let place = Workplace::new();
    place.succeed(LIFE, "--steps 6 --every 1");
    place.write("out/life/notes.txt", "mine");
    place.succeed(LIFE, "--steps 4 --every 2");
    assert_eq!(place.read("out/life/notes.txt"), "mine");
    fs::remove_file(place.path("out/life/notes.txt")).unwrap();
    check_files(&place.path("out/life"));
    assert_eq!(fs::read_dir(place.path("out/life/frames")).unwrap().count(), 3);
    // Another model in the same folder leaves no file of the first.
    place.succeed(MOD2, "--size 8 --steps 2 --out out/life");
    check_files(&place.path("out/life"));
    assert_eq!(fs::read_dir(place.path("out/life/frames")).unwrap().count(), 3);
}

#[test]
fn a_configuration_file_gives_the_options() {
    let place = Workplace::new();
    place.write(
        "run.toml",
        "case = 'published'\nsteps = 5\nout = 'here'\nquiet = true\n\n[set]\ngravity = 0\n",
    );
    assert_eq!(place.succeed(CADEM, "--config run.toml --steps 3"), "");
    let report = report(&place.path("here"));
    assert_eq!(report["progress"]["steps"], 3);
    assert_eq!(report["options"]["case"], "published");
    assert_eq!(report["parameters"]["gravity"], 0.0);
    // Without gravity nothing moves.
    assert_eq!(Table::read(&place.path("here/observables.csv")).last("largest_speed"), 0.0);
}

#[test]
fn particles_leave_through_an_opening_and_are_counted() {
    let place = Workplace::new();
    place.write("drop.csv", "label,x,y,z,vx,vy,vz\n5,0.011,0.011,0.001,0,0,-2\n8,0.031,0.031,0.001,0,0,-2\n");
    place.succeed(CADEM, "--particles drop.csv --open z-low:5,5:5,5 --steps 200");
    let observables = Table::read(&place.path("out/cadem/observables.csv"));
    assert_eq!((observables.last("particles"), observables.last("left")), (1.0, 1.0));
    let rest = Table::read(&place.path("out/cadem/final.csv"));
    assert_eq!(rest.column("label"), [8.0]);
}

/// The guide promises it.
#[test]
fn life_has_at_most_thirty_lines() {
    let lines = include_str!("../../src/bin/life.rs").lines().count();
    assert!(lines <= 30, "{lines}");
}
