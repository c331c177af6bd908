//! A model whose values are of every type, through all files and commands.

use crate::running::{POND, Pixels, Workplace, report};
use serde_json::{Value, json};
use std::fs;

const STATES: [&str; 3] = ["Rock", "Soil", "Mud"];

/// The words of the lines of a command's output that begin with this name.
fn rows(said: &str, name: &str) -> Vec<Vec<String>> {
    let lines = said.lines().filter(|line| line.split_whitespace().next() == Some(name));
    lines.map(|line| line.split_whitespace().map(str::to_owned).collect()).collect()
}

fn succeed(place: &Workplace, words: &str) -> String {
    let output = place.invocation(POND, words).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success() && said.is_empty(), "{words}: {said}");
    String::from_utf8(output.stdout).unwrap()
}

fn fail(place: &Workplace, code: i32, words: &str) -> String {
    let output = place.invocation(POND, words).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(code), "{words}: {said}");
    said
}

/// A table with a header, as words.
fn table(place: &Workplace, file: &str) -> (Vec<String>, Vec<Vec<String>>) {
    let text = place.read(file);
    let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect());
    (lines.next().unwrap(), lines.collect())
}

#[test]
fn parameters_of_every_type_are_set_told_and_kept() {
    let place = Workplace::new();
    place.write(
        "dry.toml",
        "steps = 2\n[set]\nraining = false\nsource = \"Mud\"\nshares = [0.125, 0.0, 0.25, 0.5]\n",
    );
    place.succeed(POND, "--config dry.toml --set soaked_after=7 --out out");
    let report = report(&place.path("out"));
    let wanted = json!({
        "raining": false,
        "source": "Mud",
        "rain": 0.002,
        "shares": [0.125, 0.0, 0.25, 0.5],
        "soaked_after": 7,
    });
    assert_eq!(report["parameters"], wanted);
    assert_eq!(report["units"], json!({ "rain": "m", "Pond.depth": "m", "Pond.outflow": "m" }));
    assert_eq!(report["version"], env!("CARGO_PKG_VERSION"));
    let said = succeed(&place, "list --set shares=0.5,0,0,0.25 --set source=Soil");
    assert_eq!(rows(&said, "Pond.ground")[0][1..], ["Ground", "cells"]);
    assert_eq!(rows(&said, "Pond.currents")[0][1..3], ["[Vector2<Real>;", "2]"]);
    assert_eq!(rows(&said, "shares")[0][3..], ["0.5,", "0,", "0,", "0.25", "[0,", "1]"]);
    assert_eq!(rows(&said, "source")[0].last().unwrap(), "Soil");
    assert_eq!(said.matches("\n    states: Rock, Soil, Mud\n").count(), 2, "{said}");
    for (wrong, message) in [
        ("source=Ice", "`Ice` is no value for the parameter `source`, which is a Ground: Rock, Soil, Mud"),
        ("raining=1", "which is a bool: true or false"),
        ("shares=1,2", "which is a [Real; 4]"),
        ("soaked_after=256", "which is a u8"),
    ] {
        let said = place.fail(2, POND, &format!("--set {wrong}"));
        assert!(said.contains(message), "{said}");
    }
}

#[test]
fn a_resumed_run_has_the_same_files() {
    let place = Workplace::new();
    place.succeed(POND, "--steps 60 --every 20 --out whole");
    place.succeed(POND, "--steps 60 --every 20 --checkpoint-every 40 --out parted");
    let checkpoint = "parted/checkpoints/step_00000040.checkpoint";
    succeed(&place, &format!("resume parted --checkpoint {checkpoint} --engine reference"));
    crate::running::assert_same_results(&place.path("whole"), &place.path("parted"), "resumed");

    // A byte that is no state, in a file whose checksum is right.
    let whole = fs::read(place.path(checkpoint)).unwrap();
    let line = whole.iter().position(|byte| *byte == b'\n').unwrap();
    let words = String::from_utf8_lossy(&whole[..line]).into_owned();
    let description: usize = words.split(' ').nth(2).unwrap().parse().unwrap();
    let mut wrong = whole[..whole.len() - 4].to_vec();
    wrong[line + 1 + description + 7] = 3;
    let mut sum = flate2::Crc::new();
    sum.update(&wrong);
    wrong.extend(sum.sum().to_le_bytes());
    fs::write(place.path("wrong.checkpoint"), &wrong).unwrap();
    let said = fail(&place, 2, "resume parted --checkpoint wrong.checkpoint");
    assert!(said.contains("`Pond`: `ground` is a Ground: Rock, Soil, Mud, which 3 is not"), "{said}");
    // It can still be looked into.
    let said = succeed(&place, "inspect wrong.checkpoint --cell 7,0,0");
    assert!(said.contains("\n  ground = 3.0\n"), "{said}");
}

#[test]
fn inspect_counts_states_and_names_components() {
    let place = Workplace::new();
    place.succeed(POND, "--steps 60 --every 60 --out out");
    // The last frames, and a checkpoint of another run of the same steps.
    place.succeed(POND, "--steps 61 --checkpoint-every 60 --out kept");
    let kept = "kept/checkpoints/step_00000060.checkpoint";
    let of_checkpoint = succeed(&place, &format!("inspect {kept} --cell 20,16,0 --label 3"));
    for name in ["Pond.outflow[3]", "Pond.currents[1].y", "Litter.ages[2]", "Litter.position.z", "Pond.depth"]
    {
        assert_eq!(rows(&of_checkpoint, name).len(), 1, "{name}: {of_checkpoint}");
    }
    for words in ["ground = Rock", "wet = true", "raining = true", "source = Rock", "state = Soaked"] {
        assert!(of_checkpoint.contains(&format!("\n  {words}")), "{words}: {of_checkpoint}");
    }
    let json: Value = serde_json::from_str(&succeed(&place, &format!("inspect {kept} --json"))).unwrap();
    let json_of_frames: Value = serde_json::from_str(&succeed(&place, "inspect out --json")).unwrap();
    let states = |json: &Value, name: &str| -> Vec<(String, u64)> {
        let all = json["state"]["substates"].as_array().unwrap();
        let found = all.iter().find(|substate| substate["name"] == name).unwrap();
        assert!(found.get("mean").is_none(), "{found}");
        let states = found["states"].as_array().unwrap().iter();
        states.map(|it| (it["state"].as_str().unwrap().to_owned(), it["count"].as_u64().unwrap())).collect()
    };
    let ground = states(&json, "Pond.ground");
    assert_eq!(ground.iter().map(|(state, _)| state.as_str()).collect::<Vec<_>>(), STATES);
    assert_eq!(ground.iter().map(|(_, count)| count).sum::<u64>(), 48 * 32);
    assert_eq!(states(&json_of_frames, "pond.ground"), ground);
    assert_eq!(states(&json_of_frames, "leaves.state"), states(&json, "Litter.state"));
    // The observables count them too, and rain falls on every rock.
    let observables: Vec<Value> = report(&place.path("out"))["observables"].as_array().unwrap().clone();
    let last = |name: &str| -> u64 {
        let found = observables.iter().find(|observable| observable["name"] == name);
        found.unwrap_or_else(|| panic!("{name}: {observables:?}"))["final"].as_f64().unwrap() as u64
    };
    for (state, count) in &ground {
        assert_eq!(last(&format!("pond_ground_{state}")), *count, "{state}");
    }
    assert_eq!(last("pond_wet_true"), states(&json, "Pond.wet")[1].1);
}

#[test]
fn tables_keep_types_and_grids_keep_numbers() {
    let place = Workplace::new();
    place.succeed(POND, "--steps 50 --formats +asc --out out");
    let (header, leaves) = table(&place, "out/final.csv");
    assert_eq!(header, ["label", "x", "y", "z", "state", "moved", "ages_0", "ages_1", "ages_2"]);
    assert_eq!(leaves.len(), 32);
    for leaf in &leaves {
        let ages: Vec<u32> = leaf[6..].iter().map(|age| age.parse().unwrap()).collect();
        assert_eq!(ages.iter().sum::<u32>(), 50, "{leaf:?}");
        assert!(["true", "false"].contains(&leaf[5].as_str()), "{leaf:?}");
        // After 40 steps none floats.
        assert!(["Soaked", "Sunk"].contains(&leaf[4].as_str()), "{leaf:?}");
    }
    let grid = |name: &str| -> Vec<f64> {
        let text = place.read(&format!("out/final_{name}.asc"));
        let values = text.lines().skip(6).flat_map(str::split_whitespace);
        values.map(|value| value.parse().unwrap()).collect()
    };
    for name in ["outflow_0", "outflow_3", "currents_0_x", "currents_1_y", "wet", "depth"] {
        assert_eq!(grid(name).len(), 48 * 32, "{name}");
    }
    let (ground, depth, outflow) = (grid("ground"), grid("depth"), grid("outflow_2"));
    assert!(ground.iter().all(|state| [0.0, 1.0, 2.0].contains(state)));
    assert!(depth.iter().zip(&outflow).filter(|(depth, _)| **depth > 0.0).count() > 100);

    // A state, a bool and an element of an array begin with these grids, and nothing else changes.
    let again = "--initial ground=out/final_ground.asc --initial wet=out/final_wet.asc \
                 --initial outflow.2=out/final_depth.asc --initial currents.1.x=out/final_outflow_2.asc";
    place.succeed(POND, &format!("--steps 0 --formats +asc --out again {again}"));
    let begun = |name: &str| place.read(&format!("again/final_{name}.asc"));
    let ended = |name: &str| place.read(&format!("out/final_{name}.asc"));
    assert_eq!(begun("ground"), ended("ground"));
    assert_eq!(begun("wet"), ended("wet"));
    assert_eq!(begun("outflow_2"), ended("depth"));
    assert_eq!(begun("currents_1_x"), ended("outflow_2"));
    let zeros = begun("outflow_1");
    assert!(zeros.lines().skip(6).all(|line| line.split(' ').all(|value| value == "0")), "{zeros}");
    for (initial, message) in [
        ("ground=out/final_depth.asc", "is no value for `ground`, which is a Ground: Rock, Soil, Mud"),
        (
            "outflow=out/final_depth.asc",
            "`outflow` is a [Real; 4]; give one of its components, such as `outflow.0`",
        ),
        ("outflow.4=out/final_depth.asc", "unknown substate of cells `outflow.4`"),
    ] {
        let said = place.fail(2, POND, &format!("--initial {initial}"));
        assert!(said.contains(message), "{said}");
    }
}

#[test]
fn engines_are_compared_component_by_component() {
    let place = Workplace::new();
    let output =
        place.invocation(POND, "compare --engines reference,cpu:2 --steps 30 --repeats 1 --json").output();
    let same: Value = serde_json::from_slice(&output.unwrap().stdout).unwrap();
    assert_eq!(same["verdict"], "IDENTICAL");
    // In other precision, floats differ in each component.
    let words = "compare --engines reference,cpu@f32 --steps 30 --repeats 1 --json";
    let output = place.invocation(POND, words).output().unwrap();
    let other: Value = serde_json::from_slice(&output.stdout).unwrap();
    let substates = other["engines"][1]["differences"]["substates"].as_array().unwrap();
    let outflow = substates.iter().find(|substate| substate["substate"] == "Pond.outflow").unwrap();
    let components = outflow["components"].as_array().unwrap();
    assert_eq!(components[2]["substate"], "Pond.outflow[2]");
    let sum: u64 = components.iter().map(|component| component["different"].as_u64().unwrap()).sum();
    assert_eq!(Some(sum), outflow["different"].as_u64());
}

#[test]
fn every_substate_and_component_is_drawn() {
    let place = Workplace::new();
    place.succeed(POND, "--steps 40 --every 20 --out out");
    let substates = "ground,wet,depth,outflow,outflow.2,currents[1].x,state,moved,ages.0";
    for name in substates.split(',') {
        let out = format!("pictures/{}", name.replace(['[', ']', '.'], "_"));
        succeed(&place, &format!("render out --quiet --animation none --substate {name} --out {out}"));
        assert!(place.path(&out).join("frames/frame_00000040.png").is_file(), "{name}");
    }
    let said = fail(&place, 2, "render out --substate outflow.4 --out pictures/none");
    assert!(
        said.contains("unknown substate `outflow.4`; there are ground, wet, depth, outflow ([0] to [3])"),
        "{said}"
    );
    // Rock has the colour that the model gives it.
    let pixels = Pixels::read(&place.path("out/final.png")).colours;
    let count = |colour: [u8; 3]| pixels.iter().filter(|pixel| **pixel == colour).count();
    assert!(count([150, 150, 150]) > 1000 && count([110, 70, 40]) > 100);
}
