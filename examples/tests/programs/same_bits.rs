//! Engines and numbers of threads make no difference to a single byte.

use crate::running::{CADEM, HEAT, LIFE, MOD2, Workplace};
use std::fs;
use std::path::Path;

/// The files of a run that do not tell times, with their bytes.
fn results(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut results = Vec::new();
    for folder in [folder.to_owned(), folder.join("frames")] {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_str().unwrap().to_owned();
            if path.is_file() && name != "run.json" {
                results.push((name, fs::read(path).unwrap()));
            }
        }
    }
    results.sort();
    results
}

fn compare(program: &str, options: &str) {
    let place = Workplace::new();
    place.succeed(program, &format!("{options} --engine reference --out reference"));
    place.succeed(program, &format!("{options} --engine cpu --threads 3 --out cpu"));
    let (reference, cpu) = (results(&place.path("reference")), results(&place.path("cpu")));
    assert!(reference.len() >= 5);
    for (one, other) in reference.iter().zip(&cpu) {
        assert_eq!(one.0, other.0);
        assert!(one.1 == other.1, "{program} {options}: {} differs", one.0);
    }
    assert_eq!(reference.len(), cpu.len());
}

#[test]
fn cadem_in_both_precisions_and_under_both_laws_of_walls() {
    compare(CADEM, "--case published --steps 120");
    compare(CADEM, "--case published --walls single --precision f32 --steps 80");
}

#[test]
fn dense_models() {
    compare(LIFE, "--steps 25");
    compare(MOD2, "--size 24 --steps 9");
    compare(HEAT, "--size 20 --steps 40 --precision f32");
}
