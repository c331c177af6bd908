//! Where the results go.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should")]
#![cfg(unix)]

use std::fs::File;
use std::process::{Command, Output, Stdio};

/// Runs the quickest benchmark.
fn mathematics(stdout: Stdio) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_xca-benchmarks"));
    let child = command.args(["--rounds", "1", "mathematics"]).stdout(stdout).stderr(Stdio::piped());
    child.spawn().unwrap().wait_with_output().unwrap()
}

#[test]
fn that_no_one_reads_on_is_no_error() {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let output = mathematics(writer.into());
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
    assert!(output.status.success());
}

#[cfg(target_os = "linux")]
#[test]
fn results_on_a_full_disk_are_an_error() {
    let full = File::options().write(true).open("/dev/full").unwrap();
    let output = mathematics(full.into());
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.starts_with("error: No space left on device"), "{said}");
    assert_eq!(output.status.code(), Some(1));
}
