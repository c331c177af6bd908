//! Comparisons as the command line asks for them.

use super::*;
use crate::command::{execute, parse};
use crate::engines::Engines;
use crate::program::Given;
use serde_json::Value;
use std::ffi::OsString;
use std::fs;
use xca_core::prelude::*;
use xca_record::Failure;
use xca_record::SetUp;

#[derive(Substates, Clone, Copy)]
struct Drop {
    height: Real,
}

/// Logistic growth where it is chaotic.
#[elementary_process]
fn fall(cell: &mut Cell<Drop>) {
    cell.height = 3.9 * cell.height * (1.0 - cell.height);
}

fn set_up() -> Result<SetUp, Failure> {
    let model = Model::builder("drops")
        .extents([8, 4, 1])
        .substates::<Drop>()
        .process(fall)
        .fill(|site| Drop { height: 0.1 + 0.8 * site.random(0) })
        .build()?;
    Ok(SetUp::new(model, 12))
}

/// Runs the command, and gives back what it has written as JSON.
fn compared(words: &[&str]) -> (Result<Ended, Unable>, Value) {
    let set_up = |_: &clap::ArgMatches, _: Given| set_up().map_err(Unable::Refused);
    let definition = Definition {
        name: "drops",
        about: "",
        version: "0",
        examples: "",
        options: std::convert::identity,
        set_up: &set_up,
        engines: &Engines::default(),
    };
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let first = ["drops", "compare", "--quiet", "--out", out.to_str().unwrap()];
    let words: Vec<OsString> = first.iter().chain(words).map(OsString::from).collect();
    let ended = parse::invocation(&definition, &words).and_then(execute);
    let json =
        fs::read(out.join("compare.json")).map_or(Value::Null, |text| serde_json::from_slice(&text).unwrap());
    if ended.is_ok() {
        assert!(json["compiler"].as_str().is_some_and(|compiler| compiler.starts_with("rustc 1.")));
        let mut names: Vec<_> = fs::read_dir(&out).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        let all = [
            "compare.html",
            "compare.json",
            "compare.md",
            "differences.csv",
            "divergence.csv",
            "engines.csv",
        ];
        assert_eq!(names[..6], all);
        assert_eq!(names[6], "observables.csv");
    }
    (ended, json)
}

#[test]
fn engines_that_agree_end_well() {
    let (ended, json) = compared(&["--engines", "reference,cpu:1,cpu:2", "--steps", "30", "--repeats", "2"]);
    assert!(matches!(ended, Ok(Ended::Done)), "{:?}", ended.err());
    assert_eq!((&json["verdict"], &json["steps"]), (&"IDENTICAL".into(), &30.into()));
    assert_eq!((&json["engines"][2]["name"], &json["engines"][2]["threads"]), (&"cpu:2".into(), &2.into()));
    assert_eq!(json["engines"][1]["history"].as_array().unwrap().len(), 31);
    assert_eq!((&json["number"], &json["updated"]), (&32.into(), &"cells".into()));
}

#[test]
fn engines_that_do_not_agree_have_an_exit_code() {
    let few = ["--engines", "cpu:1,cpu:1@f32", "--steps", "2", "--repeats", "1"];
    let (ended, json) = compared(&few);
    assert!(matches!(ended, Ok(Ended::Done)), "{:?}", ended.err());
    assert_eq!(json["verdict"], "ROUNDING");
    let (ended, json) = compared(&[&few[..], &["--tolerance", "1e-12"]].concat());
    assert!(matches!(ended, Ok(Ended::Different)));
    assert_eq!((&json["verdict"], &json["tolerance"]), (&"DIFFERENT".into(), &1e-12.into()));
    // Chaos makes more of it.
    let (ended, json) = compared(&["--engines", "cpu:1,cpu:1@f32", "--steps", "200", "--repeats", "1"]);
    assert!(matches!(ended, Ok(Ended::Different)));
    assert_eq!(
        (&json["check_every"], &json["engines"][1]["first_difference"]["step"]),
        (&4.into(), &1.into())
    );
}

#[test]
fn what_makes_no_sense_is_refused() {
    for (words, wanted) in [
        (&["--engines", "cpu,cup"][..], "unknown engine `cup`"),
        (&["--engines", "reference:2"], "the reference engine takes nothing after a colon"),
        (&["--arithmetic", "strict"], "none of the compared engines has --arithmetic"),
        (&["--repeats", "0"], "it must be a whole number from 1 to 1000"),
        (&["--tolerance", "-1"], "it must be a finite number at least 0"),
        (&["--check-every", "0"], "the interval must be at least 1 step"),
        (&["--set", "speed=1"], "has no parameters"),
    ] {
        let (ended, json) = compared(words);
        let message = match ended {
            Err(Unable::CommandLine(error)) => error.to_string(),
            Err(Unable::Refused(error)) => error.to_string(),
            _ => panic!("{words:?}"),
        };
        assert!(message.contains(wanted), "{message}");
        assert_eq!(json, Value::Null);
    }
}
