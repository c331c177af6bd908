//! What the features of the crates bring along: a program without them has no GPU library and no terminal
//! library.

use std::process::Command;

/// What a main of one's own need not build.
const COMMAND_LINE: &[&str] = &["xca-run", "clap", "ratatui", "wgpu", "plotters", "indicatif", "maud"];

type TestResult = Result<(), Box<dyn std::error::Error>>;

/// All crates that a crate of the workspace depends on.
fn dependencies(of: &str, features: &str) -> Result<Vec<String>, Box<dyn std::error::Error>> {
    let output = Command::new(env!("CARGO"))
        .args(["tree", "--offline", "--locked", "--edges", "normal", "--prefix", "none", "--format", "{p}"])
        .args(["--package", of, "--features", features])
        .current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
        .output()?;
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout)?;
    Ok(text.lines().filter_map(|line| line.split(' ').next()).map(str::to_owned).collect())
}

#[test]
fn a_program_has_what_its_features_ask_for() -> TestResult {
    for (of, features, there, absent) in [
        ("xca-run", "", &["xca-cpu", "clap"][..], &["wgpu", "ratatui", "mpi"][..]),
        ("xca-run", "mpi", &["xca-mpi", "mpi"], &["wgpu", "ratatui"]),
        ("xca-mpi", "", &["xca-parts"], &["mpi"]),
        ("xca-run", "gpu", &["wgpu"], &["ratatui"]),
        ("xca-run", "terminal", &["ratatui"], &["wgpu"]),
        ("xca", "", &["xca-cpu"], &["xca-run", "wgpu", "ratatui"]),
        ("xca", "run", &["xca-run"], &["wgpu", "ratatui"]),
        ("xca", "gpu", &["wgpu"], &["xca-run", "ratatui"]),
        ("xca", "terminal", &["xca-run", "ratatui"], &["wgpu"]),
        ("new-model", "", &["xca", "xca-run"], &["wgpu", "ratatui"]),
        ("new-model", "gpu,terminal", &["wgpu", "ratatui"], &[]),
        ("xca", "record", &["xca-record", "xca-io", "xca-cpu"], COMMAND_LINE),
        ("xca-tests-library", "", &["xca-record", "xca-io", "xca-cpu"], COMMAND_LINE),
        ("xca", "mpi", &["xca-run", "mpi"], &["wgpu", "ratatui"]),
        ("xca-examples", "", &["wgpu", "ratatui"], &["mpi"]),
        ("xca-examples", "mpi", &["mpi"], &[]),
    ] {
        let found = dependencies(of, features)?;
        let has = |name: &&str| found.iter().any(|found| found == name);
        assert!(there.iter().all(has), "{of} with `{features}` lacks some of {there:?}: {found:?}");
        assert!(!absent.iter().any(has), "{of} with `{features}` has some of {absent:?}");
    }
    Ok(())
}
