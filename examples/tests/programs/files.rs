//! What runs leave behind.

use crate::running::{CADEM, HEAT, LIFE, MOD2, POND, Table, Workplace, check_files, report, vtk_array};
use std::fs;
use xca_run::io::extended_xyz::{self, ReadValues};

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
    // Another program leaves the run as it is.
    let said = place.fail(2, MOD2, "--size 8 --steps 2 --out out/life");
    assert!(said.contains("out/life holds a run of `life`, which this would overwrite"), "{said}");
    check_files(&place.path("out/life"));
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

/// The frames in extended XYZ hold what the exact table holds, in the units and with the names of the model.
#[test]
fn frames_in_extended_xyz_are_those_of_the_table() {
    let place = Workplace::new();
    for precision in ["f32", "f64"] {
        let formats = "--formats csv,xyz --steps 20 --every 10";
        place.succeed(CADEM, &format!("--case published --precision {precision} {formats}"));
        let folder = place.path("out/cadem");
        let table = Table::read(&folder.join("final.csv"));
        let frames = extended_xyz::read(&folder.join("frames/particles_00000020.xyz")).unwrap();
        let [frame] = &frames[..] else { panic!("{} frames", frames.len()) };
        let time_step = report(&folder)["progress"]["time_step"].as_f64().unwrap();
        assert_eq!(frame.time, Some(20.0 * time_step));
        // The neighbourhood of this case is toroidal, as docs/cadem.md says.
        assert_eq!(frame.space.unwrap().periodic, [true; 3]);
        let column = |name: &str| frame.columns.iter().find(|column| column.name == name).unwrap();
        let labels = table.column("label").iter().map(|label| *label as i64).collect();
        assert_eq!(column("id").values, ReadValues::Whole(labels));
        let ReadValues::Real(velocities) = &column("velocity").values else { panic!("no numbers") };
        for (lane, [position, velocity]) in [["x", "vx"], ["y", "vy"], ["z", "vz"]].into_iter().enumerate() {
            let found: Vec<f64> = frame.positions.iter().map(|point| point[lane]).collect();
            assert_eq!(found, table.column(position), "{position} in {precision}");
            let found = velocities.iter().skip(lane).step_by(3);
            // Few digits are enough for f32.
            let rounded =
                found.map(|number| if precision == "f32" { f64::from(*number as f32) } else { *number });
            assert_eq!(rounded.collect::<Vec<_>>(), table.column(velocity), "{velocity} in {precision}");
        }
        let ReadValues::Real(radii) = &column("radius").values else { panic!("no numbers") };
        assert!(radii[0] > 0.0 && radii.iter().all(|radius| *radius == radii[0]), "{}", radii[0]);
        let files = report(&folder)["files"].to_string();
        assert!(files.contains("frames/particles_*.xyz"), "{files}");
    }
    // States and truth have their names.
    place.succeed(POND, "--formats csv,xyz --steps 4");
    let file = fs::read_dir(place.path("out/pond/frames")).unwrap().filter_map(Result::ok);
    let file = file.map(|entry| entry.path()).max().unwrap();
    let frame = extended_xyz::read(&file).unwrap().remove(0);
    assert_eq!(frame.space.unwrap().periodic, [true, true, false]);
    let table = place.read("out/pond/final.csv");
    let mut lines = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let header = lines.next().unwrap();
    let rows: Vec<Vec<&str>> = lines.collect();
    assert_eq!(frame.positions.len(), rows.len());
    let words = |name: &str| {
        let place = header.iter().position(|known| *known == name).unwrap();
        rows.iter().map(|row| row[place].to_owned()).collect::<Vec<String>>()
    };
    let mut checked = 0;
    for column in &frame.columns {
        match &column.values {
            ReadValues::Bool(values) => {
                assert_eq!(values.iter().map(bool::to_string).collect::<Vec<_>>(), words(&column.name));
            }
            ReadValues::Text(values) => assert_eq!(values, &words(&column.name)),
            _ => continue,
        }
        checked += 1;
    }
    assert!(checked >= 2, "{header:?}");
    let said = place.fail(2, HEAT, "--formats +xyz");
    assert!(said.contains("the format xyz is for models with items, and `heat` has none"), "{said}");
}
