//! Engines and numbers of threads make no difference to a single byte.

use crate::running::{CADEM, HEAT, LIFE, MOD2, Workplace, assert_same_results};

fn compare(program: &str, options: &str) {
    let place = Workplace::new();
    place.succeed(program, &format!("{options} --engine reference --out reference"));
    place.succeed(program, &format!("{options} --engine cpu --threads 3 --out cpu"));
    let place_of = format!("{program} {options}");
    assert_same_results(&place.path("reference"), &place.path("cpu"), &place_of);
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
