//! Copies the programs to where tests can include them: `include!` takes no documentation of a whole file.
#![allow(clippy::print_stdout, reason = "so a build script speaks to cargo")]

use std::error::Error;
use std::path::PathBuf;
use std::{env, fs};

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=src/bin");
    let target = PathBuf::from(env::var("OUT_DIR")?);
    for entry in fs::read_dir("src/bin")? {
        let entry = entry?;
        let text = fs::read_to_string(entry.path())?.replace("//!", "//");
        fs::write(target.join(entry.file_name()), text)?;
    }
    Ok(())
}
