//! The program of the crate that `new` writes, and that this crate is what it writes.

use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Command;

/// Runs the program in a folder; it must succeed.
fn run(folder: &Path, words: &[&str]) -> String {
    let program = env!("CARGO_BIN_EXE_new-model");
    let output =
        Command::new(program).args(words).current_dir(folder).output().expect("the program is there");
    assert!(output.status.success(), "{words:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("it says text")
}

#[test]
fn the_program_runs() {
    let folder = tempfile::tempdir().expect("a folder");
    let said = run(folder.path(), &["run", "--steps", "60"]);
    assert!(said.contains("new-model, 160 x 160 cells") && said.contains("60 steps"), "{said}");
    let report = fs::read(folder.path().join("out/new-model/run.json")).expect("a report");
    let report: Value = serde_json::from_slice(&report).expect("it is JSON");
    assert_eq!(report["progress"]["outcome"], "done");
    assert_eq!(report["parameters"], serde_json::json!({"threshold": 1, "duration": 7}));
}

#[test]
fn new_writes_this_crate() {
    let folder = tempfile::tempdir().expect("a folder");
    run(folder.path(), &["new", "new-model"]);
    let written =
        |file: &str| fs::read_to_string(folder.path().join("new-model").join(file)).expect("a file");
    for (file, built) in [
        ("src/lib.rs", include_str!("../../../xca-run/src/command/new/lib.rs")),
        ("src/main.rs", include_str!("../../../xca-run/src/command/new/main.rs")),
        ("tests/engines.rs", include_str!("../../../xca-run/src/command/new/engines.rs")),
    ] {
        assert!(written(file) == built, "{file}");
    }
    // What it depends on, and how it is compiled for tests, is as here.
    let manifest = |text: &str| -> toml::Table { text.parse().expect("a manifest") };
    let theirs = manifest(&written("Cargo.toml"));
    let ours = manifest(include_str!("../Cargo.toml"));
    let names = |of: &toml::Table| -> Vec<String> {
        of["dependencies"].as_table().expect("a table").keys().cloned().collect()
    };
    assert_eq!(names(&theirs), names(&ours));
    let workspace = manifest(include_str!("../../../Cargo.toml"));
    assert_eq!(theirs["profile"]["dev"], workspace["profile"]["dev"]);
    assert_eq!(theirs["package"]["edition"], workspace["workspace"]["package"]["edition"]);
}
