//! Files read and written by other libraries: GeoTIFF by rasterio, extended XYZ by ASE.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should")]

mod extended_xyz;
mod geotiff;

use serde_json::Value;
use std::ffi::OsStr;
use std::path::Path;
use std::process::Command;

/// Runs a script of this folder in the environment of `scripts/readers`. Reads the JSON that it prints.
fn run<Argument: AsRef<OsStr>>(script: &str, arguments: impl IntoIterator<Item = Argument>) -> Vec<Value> {
    let python = Path::new(env!("CARGO_TARGET_TMPDIR")).with_file_name("readers").join("bin/python");
    let missing = format!("{} is not there: run `bash scripts/readers`", python.display());
    assert!(python.is_file(), "{missing}");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/readers").join(script);
    let output = Command::new(python).arg(script).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// A number that a script prints as its bits.
fn number(text: &Value) -> f64 {
    f64::from_bits(u64::from_str_radix(text.as_str().unwrap(), 16).unwrap())
}

/// Whether two lists have the same bits. All NaN are equal.
fn are_same(one: &[f64], other: &[f64]) -> bool {
    let is_same =
        |(one, other): (&f64, &f64)| one.to_bits() == other.to_bits() || one.is_nan() && other.is_nan();
    one.len() == other.len() && one.iter().zip(other).all(is_same)
}
