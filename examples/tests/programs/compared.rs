//! `compare` as its users see it: verdicts, exit codes, files.

use crate::running::{HEAT, LIFE, Workplace};
use serde_json::Value;

fn compare(place: &Workplace, program: &str, options: &str) -> (Option<i32>, Value) {
    let output = place.invocation(program, &format!("compare {options}")).output().unwrap();
    let said = String::from_utf8(output.stdout).unwrap();
    let json = serde_json::from_str(&said)
        .unwrap_or_else(|error| panic!("{error}: {said}{}", String::from_utf8_lossy(&output.stderr)));
    (output.status.code(), json)
}

#[test]
fn engines_that_agree() {
    let place = Workplace::new();
    let (code, report) = compare(
        &place,
        LIFE,
        "--engines reference,cpu:1,cpu:3,gpu --steps 12 --repeats 2 --json --out agree",
    );
    assert_eq!(code, Some(0));
    let engines = report["engines"].as_array().unwrap();
    assert_eq!(engines.len(), 4);
    for engine in &engines[1..] {
        assert_eq!(engine["verdict"], "IDENTICAL", "{engine}");
    }
    for file in ["compare.html", "compare.md", "compare.json", "engines.csv", "differences.csv"] {
        assert!(place.path("agree").join(file).is_file(), "{file}");
    }
    let engines = place.read("agree/engines.csv");
    assert_eq!(engines.lines().count(), 5, "{engines}");
}

/// Another precision is another model of numbers: that is more than rounding within a run.
#[test]
fn engines_that_differ() {
    let place = Workplace::new();
    let (code, report) = compare(
        &place,
        HEAT,
        "--size 12 --engines cpu:1,cpu:1@f32 --steps 20 --repeats 1 --tolerance 0 --json --out differ",
    );
    assert_eq!(code, Some(3));
    assert!(report.to_string().contains("DIFFERENT"), "{report}");
    assert!(place.read("differ/compare.md").contains("DIFFERENT"));
}
