//! What a program adds takes part in every subcommand.

mod engine;
mod format;

use std::error::Error;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

type TestResult = Result<(), Box<dyn Error>>;

/// Runs the program in a folder.
fn plate(folder: &Path, words: &str) -> Result<Output, Box<dyn Error>> {
    let words = words.split_whitespace();
    Ok(Command::new(env!("CARGO_BIN_EXE_xca-tests-additions")).args(words).current_dir(folder).output()?)
}

/// What it says where it does not fail.
fn succeed(folder: &Path, words: &str) -> Result<String, Box<dyn Error>> {
    let output = plate(folder, words)?;
    assert!(output.status.success(), "{words}: {}", String::from_utf8_lossy(&output.stderr));
    Ok(String::from_utf8(output.stdout)?)
}

fn report(path: &Path) -> Result<serde_json::Value, Box<dyn Error>> {
    Ok(serde_json::from_slice(&fs::read(path)?)?)
}
