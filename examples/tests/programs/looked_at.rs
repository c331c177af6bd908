//! What programs tell of themselves and of what runs left.

use crate::running::{CADEM, HEAT, LIFE, MOD2, Workplace, warns_at_most};
use serde_json::Value;
use std::fs;

/// What a command says that must succeed.
fn told(place: &Workplace, program: &str, words: &str) -> String {
    let output = place.invocation(program, words).output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success() && warns_at_most(&said), "{program} {words}: {said}");
    String::from_utf8(output.stdout).unwrap()
}

fn json(place: &Workplace, program: &str, words: &str) -> Value {
    serde_json::from_str(&told(place, program, words)).unwrap()
}

fn refused(place: &Workplace, program: &str, words: &str, wanted: &str) {
    let output = place.invocation(program, words).output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{words}: {said}");
    assert!(said.contains(wanted), "{words}: {said}");
}

/// The values after a word, divided by blanks.
fn row<'a>(text: &'a str, name: &str) -> Vec<&'a str> {
    let line = text.lines().find(|line| line.split_whitespace().next() == Some(name)).unwrap();
    line.split_whitespace().skip(1).collect()
}

#[test]
fn a_program_lists_its_parts() {
    let place = Workplace::new();
    let text = told(&place, HEAT, "list --size 12 --set alpha=0.15");
    assert!(text.starts_with("heat: 12 x 12 x 12 cells of side 0.00769"), "{text}");
    assert!(text.contains("boundaries: flat\n  neighbourhood: von Neumann"), "{text}");
    assert_eq!(row(&text, "Heat.temperature"), ["Real", "°C", "cells"]);
    assert_eq!(row(&text, "alpha"), ["Real", "0.15", "(0,", "0.16666666666666666]"]);
    assert_eq!(row(&text, "diffusivity"), ["Real", "0.000111", "m2/s", "(0,", "inf)"]);
    assert!(text.contains("\n    Thermal diffusivity D.\n"), "{text}");
    assert_eq!(row(&text, "diffuse"), ["cell", "each"]);
    assert_eq!(row(&text, "writes"), ["temperature"]);
    assert!(row(&text, "reference").len() > 2 && row(&text, "cpu").len() > 2);
    assert!(!told(&place, LIFE, "list").contains("parameter"));
    let cadem = json(&place, CADEM, "list --case published --slots 14 --json");
    for (pointer, value) in [
        ("/engines/0/name", "\"cpu\""),
        ("/model/groups/0/slots", "14"),
        ("/parameters/stiffness/value", "100.0"),
        ("/parameters/stiffness/unit", "\"N/m\""),
        ("/processes/0/name", "\"reset_forces\""),
        ("/processes/0/reads_elsewhere", "[]"),
        ("/processes/0/writes", "[\"force\"]"),
        ("/processes/2/for_each", "\"item\""),
        ("/processes/2/local_interaction", "true"),
        ("/processes/6/for_each", "\"item, to move it\""),
    ] {
        assert_eq!(cadem.pointer(pointer).unwrap_or(&Value::Null).to_string(), value, "{pointer}");
    }
    refused(&place, HEAT, "list --set beta=1", "no parameter is called `beta`");
    assert!(!place.path("out").exists());
}

#[test]
fn a_folder_and_its_checkpoints_are_told_of() {
    let place = Workplace::new();
    place.succeed(HEAT, "--size 9 --steps 22 --until 0 --checkpoint-every 10");
    let text = told(&place, HEAT, "inspect out/heat");
    assert!(text.starts_with("heat 0.1.0: done, 22 of 22 steps, 12 frames\n"), "{text}");
    assert!(
        text.contains("seed 1, started 20") && text.contains(" after 22 of 22 steps, time 2.47"),
        "{text}"
    );
    // The initial shape is an eigenvector of the scheme, and symmetric.
    let fade = 1.0 - 12.0 * 0.125 * (std::f64::consts::PI / 20.0).sin().powi(2);
    let json = json(&place, HEAT, "inspect out/heat --cell 4,4,4 --json");
    assert_eq!(json["checkpoints"].as_array().unwrap().len(), 2);
    assert_eq!(json["run"]["progress"]["steps"], 22);
    let of_substate = &json["state"]["substates"][0];
    assert_eq!((&of_substate["name"], &of_substate["count"]), (&"Heat.temperature".into(), &729.into()));
    let number = |value: &Value| value.as_f64().unwrap();
    assert!((number(&of_substate["largest"]) / (100.0 * fade.powi(22)) - 1.0).abs() < 1e-12, "{of_substate}");
    let value = &json["state"]["places"][0]["values"][0];
    assert_eq!(
        (&value["name"], number(&value["components"][0])),
        (&"temperature".into(), number(&of_substate["largest"]))
    );
    // Any program looks into any checkpoint, and tells which of them are not whole.
    let latest = place.path("out/heat/checkpoints/step_00000022.checkpoint");
    let bytes = fs::read(&latest).unwrap();
    fs::write(&latest, &bytes[..bytes.len() - 8]).unwrap();
    let text = told(&place, MOD2, "inspect out/heat");
    assert!(text.contains("step_00000022.checkpoint is truncated: "), "{text}");
    assert!(text.contains("step_00000020.checkpoint: heat 0.1.0 after 20 of 22 steps, time 2.25"), "{text}");
    refused(&place, HEAT, "inspect out/heat/checkpoints/step_00000022.checkpoint", "is truncated");
    refused(
        &place,
        HEAT,
        "inspect out/heat --cell 4,4,9",
        "the space of [9, 9, 9] cells has no cell [4, 4, 9]",
    );
    refused(&place, HEAT, "inspect out/heat --cell 4,x,4,4", "a cell is three whole numbers, such as 3,4,0");
    refused(&place, HEAT, "inspect out/heat --label 3", "there is no item with the label 3");
    refused(&place, HEAT, "inspect out", "out is not the output of a run");
    refused(&place, HEAT, "inspect away", "cannot read the checkpoint away");
}

#[test]
fn items_are_found_by_cell_and_by_label() {
    let place = Workplace::new();
    place
        .write("drop.csv", "label,x,y,z,vx,vy,vz\n5,0.0111,0.011,0.0051,0,0,0\n8,0.005,0.005,0.003,0,0,-1\n");
    place.succeed(CADEM, "--particles drop.csv --side 8 --steps 30 --checkpoint-every 25");
    let found = json(&place, CADEM, "inspect out/cadem --label 5 --json");
    let item = &found["state"]["places"][0];
    assert_eq!((&item["label"], &item["cell"]), (&5.into(), &serde_json::json!([5, 5, 2])));
    let position =
        item["values"].as_array().unwrap().iter().find(|value| value["name"] == "position").unwrap();
    assert_eq!(
        (position["components"][0].as_f64(), position["components"][1].as_f64()),
        (Some(0.0111), Some(0.011))
    );
    let text = told(&place, CADEM, "inspect out/cadem/checkpoints/step_00000025.checkpoint --cell 5,5,2");
    assert!(
        text.contains("\nDem 5 in cell 5,5,2\n") && text.contains("\n  position = 0.0111, 0.011, 0.005"),
        "{text}"
    );
    assert!(!text.contains("Dem 8"));
    // A run without checkpoints has its frames.
    place.succeed(CADEM, "--particles drop.csv --side 8 --steps 3 --out plain");
    let text = told(&place, CADEM, "inspect plain");
    assert!(text.starts_with("cadem 0.1.0: done, 3 of 3 steps"), "{text}");
    assert!(text.contains("\nplain/frames: cadem 0.1.0 after 3 of 3 steps, time 3.354"), "{text}");
    assert_eq!(row(&text, "particles.velocity.z")[..2], ["Vector3<f64>", "2"]);
    let found = json(&place, CADEM, "inspect plain --label 8 --json");
    let of_last = place.read("plain/final.csv");
    let last: Vec<f64> =
        of_last.lines().last().unwrap().split(',').map(|number| number.parse().unwrap()).collect();
    let item = &found["state"]["places"][0];
    assert_eq!((&item["of"], &item["label"], &item["cell"]), (&"particles".into(), &8.into(), &Value::Null));
    assert_eq!(item["values"][0]["components"], serde_json::json!(last[1..4]));
    refused(
        &place,
        CADEM,
        "inspect plain --label 6",
        "the frames in plain/frames have no item with the label 6",
    );
    refused(&place, CADEM, "inspect plain --cell 5,5,2", "the frames in plain/frames have no cell [5, 5, 2]");
}

#[test]
fn the_last_frames_are_looked_into_where_there_is_no_checkpoint() {
    let place = Workplace::new();
    place.succeed(HEAT, "--size 9 --steps 20 --until 0");
    let found = json(&place, MOD2, "inspect out/heat --cell 4,4,4 --json");
    assert_eq!((&found["state"]["step"], &found["state"]["steps_wanted"]), (&20.into(), &20.into()));
    let of_substate = &found["state"]["substates"][0];
    assert_eq!((&of_substate["name"], &of_substate["type"]), (&"heat.temperature".into(), &"f64".into()));
    let fade = 1.0 - 12.0 * 0.125 * (std::f64::consts::PI / 20.0).sin().powi(2);
    let largest = of_substate["largest"].as_f64().unwrap();
    assert!((largest / (100.0 * fade.powi(20)) - 1.0).abs() < 1e-12, "{of_substate}");
    assert_eq!(found["state"]["places"][0]["values"][0]["components"][0].as_f64(), Some(largest));
    refused(
        &place,
        HEAT,
        "inspect out/heat --cell 4,4,9",
        "the space of [9, 9, 9] cells has no cell [4, 4, 9]",
    );
    // Half a frame is none.
    let frame = place.path("out/heat/frames/heat_00000020.vti");
    let bytes = fs::read(&frame).unwrap();
    fs::write(&frame, &bytes[..bytes.len() / 2]).unwrap();
    refused(&place, HEAT, "inspect out/heat", "heat_00000020.vti is truncated");
}
