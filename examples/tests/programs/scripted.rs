//! What scripts rely on: with `--json` a command tells its result as one JSON document, and nothing else.

use crate::running::{HEAT, LIFE, Workplace};
use serde_json::Value;
use std::fs;

/// What a command tells, which must succeed with nothing on stderr.
fn told(place: &Workplace, program: &str, words: &str) -> Value {
    let output = place.invocation(program, &format!("{words} --json")).output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success() && said.is_empty(), "{words}: {said}");
    serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|error| panic!("{words}: {error} in {}", String::from_utf8_lossy(&output.stdout)))
}

#[test]
fn every_command_tells_its_result_as_json() {
    let place = Workplace::new();
    let run = told(&place, HEAT, "run --size 10 --until 0 --steps 12 --checkpoint-every 5 --engine gpu");
    assert_eq!((&run["progress"]["outcome"], &run["progress"]["steps"]), (&"done".into(), &12.into()));
    assert_eq!(run["observables"][0]["name"], "hottest");
    let written: Value = serde_json::from_str(&place.read("out/heat/run.json")).unwrap();
    assert_eq!(run, written);
    assert_eq!(told(&place, HEAT, "resume out/heat"), written);
    let checkpoint = "out/heat/checkpoints/step_00000010.checkpoint";
    let resumed = told(&place, HEAT, &format!("resume out/heat --checkpoint {checkpoint}"));
    assert_eq!(
        (&resumed["progress"]["outcome"], &resumed["resumed"][0]["step"]),
        (&"done".into(), &10.into())
    );
    let inspected = told(&place, HEAT, "inspect out/heat");
    assert_eq!((&inspected["run"]["seed"], &inspected["state"]["step"]), (&1.into(), &12.into()));
    assert_eq!(told(&place, HEAT, "list")["parameters"]["alpha"]["value"], 0.125);
    for words in
        ["render --size 10 --steps 4 --every 2", "render out/heat --every 3", &format!("render {checkpoint}")]
    {
        let rendered = told(&place, HEAT, words);
        let files = rendered["files"].as_array().unwrap();
        assert!(!files.is_empty(), "{words}: {rendered}");
    }
    let compared = told(&place, HEAT, "compare --size 10 --steps 4 --repeats 1 --engines reference,cpu:2");
    assert_eq!(
        (&compared["verdict"], &compared["engines"][1]["verdict"]),
        (&"IDENTICAL".into(), &"IDENTICAL".into())
    );
    let new = told(&place, LIFE, "new waves");
    let files: Vec<&str> = new["files"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
    assert!(files.contains(&"waves/src/lib.rs"));
    assert!(files.iter().all(|file| fs::exists(place.path(file)).unwrap()));
}

/// An error is a sentence on stderr, whatever was asked for.
#[test]
fn errors_are_no_json() {
    let place = Workplace::new();
    let said = place.fail(2, LIFE, "--json --quiet");
    assert!(said.contains("cannot be used with"), "{said}");
    let output = place.run(LIFE, "--json --initial alive=nowhere.asc");
    assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0));
    assert!(String::from_utf8(output.stderr).unwrap().starts_with("error: cannot open the grid nowhere.asc"));
}
