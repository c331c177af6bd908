//! Sweeps: many runs in one table, each as if it had been run alone.

use crate::running::{HEAT, LANDSLIDE, Table, Workplace};
use std::process::{Command, Stdio};

/// The rows of a table, by column.
fn rows(place: &Workplace, file: &str) -> Vec<Vec<String>> {
    place.read(file).lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

/// What a command says that must succeed.
fn told(mut command: Command) -> String {
    let output = command.output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success() && said.is_empty(), "{said}");
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn a_member_is_what_a_run_with_its_options_gives() {
    let place = Workplace::new();
    let said = place
        .invocation(LANDSLIDE, "sweep --set adherence=0.5..1.5:3 --set rate=0.25|0.5 --steps 60 --jobs 2");
    let said = told(said);
    assert!(said.contains("6 of 6 runs"), "{said}");
    let members = rows(&place, "out/landslide-sweep/members.csv");
    assert_eq!(members[0][..7], ["member", "seed", "adherence", "rate", "end", "reason", "steps"]);
    assert_eq!(members.len(), 7);
    place.succeed(LANDSLIDE, "--set adherence=1 --set rate=0.5 --steps 60 --every 60 --out alone");
    let alone = Table::read(&place.path("alone/observables.csv"));
    let member = &members[4];
    assert_eq!(member[2..4], ["1", "0.5"]);
    for (name, text) in members[0].iter().zip(member).skip(7) {
        let name = name.split(" (").next().unwrap();
        assert_eq!(text.parse::<f64>().unwrap().to_bits(), alone.last(name).to_bits(), "{name}");
    }
    assert_eq!(rows(&place, "out/landslide-sweep/summary.csv").len(), 7);
}

/// A run with known parameters leaves a map; the sweep that is told of this map finds the parameters again.
#[test]
fn a_parameter_is_fitted_to_a_known_final_map() {
    let place = Workplace::new();
    place.succeed(LANDSLIDE, "--set adherence=0.8 --steps 200 --every 200 --out known");
    place.succeed(LANDSLIDE, "--steps 0 --out ground");
    let map = "--dem ground/final_altitude.asc --debris ground/final_thickness.asc";
    let observed = "--observed known/final_thickness.asc --steps 200 --maximise fitness";
    let said =
        told(place.invocation(LANDSLIDE, &format!("sweep --set adherence=0.4..1.2:5 {map} {observed}")));
    assert!(said.contains("largest fitness: 1 with adherence=0.8, seed 1\n"), "{said}");
    let members = rows(&place, "out/landslide-sweep/members.csv");
    let column = members[0].iter().position(|name| name == "fitness").unwrap();
    let fitness: Vec<f64> = members[1..].iter().map(|row| row[column].parse().unwrap()).collect();
    assert!(fitness.windows(2).take(2).all(|pair| pair[0] < pair[1]), "{fitness:?}");
    assert!(fitness.windows(2).skip(2).all(|pair| pair[0] > pair[1]), "{fitness:?}");
    let page = place.read("out/landslide-sweep/summary.html");
    assert!(page.contains("<figcaption>fitness</figcaption>") && page.contains("\nadherence\n"), "{page}");
    let output =
        place.invocation(LANDSLIDE, "sweep --steps 1 --maximise beauty --out other").output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("no run observes `beauty`; there are volume, covered_area"), "{said}");
}

#[test]
fn a_sweep_that_was_killed_goes_on() {
    let place = Workplace::new();
    let words = "sweep --set initial=10..90:9 --seeds 3 --size 24 --steps 400 --jobs 1 --out";
    told(place.invocation(HEAT, &format!("{words} whole")));
    let mut child = place.invocation(HEAT, &format!("{words} parts")).stdout(Stdio::null()).spawn().unwrap();
    while !place.path("parts/sweep.json").exists() {
        assert!(child.try_wait().unwrap().is_none(), "it ended before it wrote its report");
        std::thread::yield_now();
    }
    child.kill().unwrap();
    child.wait().unwrap();
    told(place.invocation(HEAT, &format!("{words} parts")));
    for file in ["members.csv", "summary.csv"] {
        assert_eq!(place.read(&format!("whole/{file}")), place.read(&format!("parts/{file}")), "{file}");
    }
}

/// The member under way is given up: it would take days.
#[test]
#[cfg(unix)]
fn ctrl_c_ends_a_sweep_within_a_long_member() {
    let place = Workplace::new();
    let words = "sweep --seeds 3 --size 24 --until 0 --steps 100000000000 --jobs 1 --out long";
    let mut child = place.invocation(HEAT, words).stdout(Stdio::piped()).spawn().unwrap();
    while !place.path("long/sweep.json").exists() {
        assert!(child.try_wait().unwrap().is_none(), "it ended before it wrote its report");
        std::thread::yield_now();
    }
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    let table = place.path("long/members.csv");
    assert!(!table.exists() || rows(&place, "long/members.csv").len() < 2);
}

#[test]
fn what_cannot_be_swept_is_refused_before_anything_runs() {
    let place = Workplace::new();
    for (options, wanted) in [
        ("--set adherence=-1..1:3", "`adherence` is -1, but must be at least 0"),
        ("--set adherence=0..1", "of the form LOW..HIGH:COUNT"),
        ("--set rate=0.5|x", "rate"),
        ("--set nothing=1|2", "nothing"),
        ("--seeds 0", "0 is not in 1.."),
        ("--jobs 0", "0 is not in 1..=1024"),
    ] {
        let output = place.invocation(LANDSLIDE, &format!("sweep {options}")).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{options}: {said}");
        assert!(said.contains(wanted), "{options}: {said}");
        assert!(!place.path("out").exists());
    }
}
