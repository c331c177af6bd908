//! The program of the crate that `new` writes, and that this crate is what it writes.

use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn invoke(folder: &Path, words: &[&str]) -> Output {
    let program = env!("CARGO_BIN_EXE_new-model");
    Command::new(program).args(words).current_dir(folder).output().expect("the program is there")
}

/// Runs the program in a folder; it must succeed.
fn run(folder: &Path, words: &[&str]) -> String {
    let output = invoke(folder, words);
    assert!(output.status.success(), "{words:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("it says text")
}

/// Runs the program in a folder; it must refuse with exit code 2.
fn refuse(folder: &Path, words: &[&str]) -> String {
    let output = invoke(folder, words);
    assert_eq!(output.status.code(), Some(2), "{words:?}");
    String::from_utf8(output.stderr).expect("it says text")
}

/// This checkout, named so that the tests also pass where the programs are built outside of it.
const CHECKOUT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

fn manifest(text: &str) -> toml::Table {
    text.parse().expect("a manifest")
}

fn framework_version() -> String {
    let workspace = manifest(include_str!("../../../Cargo.toml"));
    workspace["workspace"]["package"]["version"].as_str().expect("a version").to_owned()
}

#[test]
fn the_program_runs() {
    let folder = tempfile::tempdir().expect("a folder");
    let said = run(folder.path(), &["run", "--steps", "60", "--set", "immunity=30"]);
    assert!(said.contains("new-model, 160 x 160 cells") && said.contains("60 steps"), "{said}");
    let report = fs::read(folder.path().join("out/new-model/run.json")).expect("a report");
    let report: Value = serde_json::from_slice(&report).expect("it is JSON");
    assert_eq!(report["progress"]["outcome"], "done");
    // That of the crate that the program is written in, and beside it that of the framework.
    assert_eq!((&report["version"], &report["xca"]), (&json!("0.2.0"), &json!(framework_version())));
    assert_eq!(run(folder.path(), &["--version"]), "new-model 0.2.0\n");
    let parameters = json!({ "infected_at_start": 0.001, "contagion": 0.1, "infection": 7, "immunity": 30 });
    assert_eq!(report["parameters"], parameters);
    let said = refuse(folder.path(), &["run", "--set", "contagion=1.5"]);
    assert!(
        said.contains("the parameter `contagion` is 1.5, but must be at least 0 and at most 1"),
        "{said}"
    );
}

/// Where the program is built with a feature, this tests nothing of it: the workspace's programs have all.
#[test]
fn what_is_not_built_in_is_told() {
    let folder = tempfile::tempdir().expect("a folder");
    for (words, feature) in
        [(&["run", "--engine", "gpu", "--steps", "1"][..], "gpu"), (&["watch"], "terminal")]
    {
        let said = String::from_utf8(invoke(folder.path(), words).stderr).expect("it says text");
        if said.contains("built without") {
            let expected = format!(
                "error: this program was built without the feature `{feature}`; \
                 build it with `cargo run --release --features xca/{feature}`\n"
            );
            assert_eq!(said, expected);
        }
    }
}

#[test]
fn new_writes_this_crate() {
    let folder = tempfile::tempdir().expect("a folder");
    run(folder.path(), &["new", "new-model", "--xca-path", CHECKOUT]);
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
    let theirs = manifest(&written("Cargo.toml"));
    let ours = manifest(include_str!("../Cargo.toml"));
    let names = |of: &toml::Table| -> Vec<String> {
        of["dependencies"].as_table().expect("a table").keys().cloned().collect()
    };
    assert_eq!(names(&theirs), names(&ours));
    assert_eq!(theirs["features"], ours["features"]);
    assert_eq!(theirs["dependencies"]["xca"]["features"], ours["dependencies"]["xca"]["features"]);
    let workspace = manifest(include_str!("../../../Cargo.toml"));
    assert_eq!(theirs["profile"]["dev"]["opt-level"], workspace["profile"]["dev"]["opt-level"]);
    assert_eq!(theirs["package"]["edition"], workspace["workspace"]["package"]["edition"]);
}

/// Cargo accepts the crate, finds xca where the manifest says, and knows the features.
#[test]
fn the_crate_resolves() {
    let folder = tempfile::tempdir().expect("a folder");
    run(folder.path(), &["new", "my-waves", "--xca-path", CHECKOUT]);
    let crate_folder = folder.path().join("my-waves");
    // The versions that are known here, as a test must not depend on a network.
    fs::copy(format!("{CHECKOUT}/Cargo.lock"), crate_folder.join("Cargo.lock")).expect("a lock file");
    for (features, has_gpu) in [("", false), ("gpu,terminal", true)] {
        let output = Command::new(env!("CARGO"))
            .args(["tree", "--offline", "--edges", "normal", "--prefix", "none", "--features", features])
            .current_dir(&crate_folder)
            .output()
            .expect("cargo is there");
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{said}");
        let tree = String::from_utf8_lossy(&output.stdout);
        assert!(tree.starts_with("my-waves v0.1.0") && tree.contains("\nxca-run v"), "{tree}");
        assert_eq!(tree.contains("\nwgpu v"), has_gpu, "{tree}");
        assert_eq!(tree.contains("\nratatui v"), has_gpu, "{tree}");
    }
}

#[test]
fn new_depends_on_what_is_near_or_given() {
    let folder = tempfile::tempdir().expect("a folder");
    let dependency = |place: &Path, words: &[&str]| {
        run(place, &[&["new", "waves"], words].concat());
        let text = fs::read_to_string(place.join("waves/Cargo.toml")).expect("a file");
        fs::remove_dir_all(place.join("waves")).expect("the folder is there");
        let mut dependency = manifest(&text)["dependencies"]["xca"].as_table().expect("a table").clone();
        assert_eq!(dependency.remove("features"), Some(vec!["run"].into()));
        dependency
    };
    let entry = |key: &str, text: &str| -> toml::Table {
        [(key.to_owned(), toml::Value::from(text))].into_iter().collect()
    };
    let url = "https://example.org/xca.git";
    assert_eq!(dependency(folder.path(), &["--xca-git", url]), entry("git", url));
    // The package around the current folder says it.
    let package =
        "[package]\nname = \"sand\"\n[dependencies]\nxca = { version = \"0.3\", features = [\"gpu\"] }";
    fs::write(folder.path().join("Cargo.toml"), package).expect("a file");
    let below = folder.path().join("src/deep");
    fs::create_dir_all(&below).expect("a folder");
    assert_eq!(dependency(&below, &[]), entry("version", "0.3"));
}

#[test]
fn new_refuses_before_it_writes() {
    let folder = tempfile::tempdir().expect("a folder");
    let nowhere = folder.path().join("nowhere").display().to_string();
    for (words, reason) in [
        (&["new", "build"][..], "`build` is a folder that cargo builds in; give another name"),
        (&["new", "nul"], "`nul` is the name of a device on Windows"),
        (&["new", "match"], "`match` is a keyword of Rust"),
        (&["new", "Waves"], "the name of a crate has small letters"),
        (&["new", "waves", "--xca-path", &nowhere], "is not a folder of xca: it has no crate `xca`"),
        (&["new", "waves", "--xca-path", ".", "--xca-git", "url"], "cannot be used with"),
    ] {
        let said = refuse(folder.path(), words);
        assert!(said.contains(reason), "{words:?}: {said}");
    }
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 0);
    let new = ["new", "waves", "--xca-path", CHECKOUT];
    run(folder.path(), &new);
    let said = refuse(folder.path(), &new);
    assert!(said.contains("waves exists already"), "{said}");
}
