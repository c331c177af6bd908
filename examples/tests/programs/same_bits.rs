//! Engines and numbers of threads make no difference to a single byte.

use crate::running::{CADEM, HEAT, LANDSLIDE, LIFE, MOD2, POND, Workplace, assert_same_results};

fn compare(program: &str, options: &str) {
    let place = Workplace::new();
    place.succeed(program, &format!("{options} --engine reference --out reference"));
    let engines = ["cpu --threads 1", "cpu --threads 2", "cpu --threads 3", "gpu --arithmetic strict"];
    for engine in engines {
        place.succeed(program, &format!("{options} --engine {engine} --out other --overwrite"));
        let place_of = format!("{program} {options} --engine {engine}");
        assert_same_results(&place.path("reference"), &place.path("other"), &place_of);
    }
}

#[test]
fn cadem_in_both_precisions_and_under_both_laws_of_walls() {
    compare(CADEM, "--case published --steps 120");
    compare(CADEM, "--case published --walls single --precision f32 --steps 80");
}

/// The adapter is named, and one that is no GPU is not taken for one.
#[test]
fn the_gpu_engine_tells_what_it_ran_on() {
    let place = Workplace::new();
    let said = place.succeed(LIFE, "--steps 3 --engine gpu --out gpu");
    let report: serde_json::Value =
        serde_json::from_slice(&std::fs::read(place.path("gpu").join("run.json")).unwrap()).unwrap();
    let device = &report["device"];
    assert_eq!(report["engine"], "gpu");
    assert!(device["adapter"].as_str().is_some_and(|name| !name.is_empty()), "{device}");
    assert_eq!(device["arithmetic"], "strict");
    let no_gpu = device["kind"].as_str().is_some_and(|kind| kind.contains("no GPU"));
    assert_eq!(said.contains("is no GPU: the processor plays one"), no_gpu, "{said}");
    let said = place.succeed(LIFE, "--steps 3 --engine gpu --arithmetic relaxed --out relaxed");
    assert!(said.contains("float arithmetic is relaxed"), "{said}");
}

#[test]
fn processes_are_printed_as_shaders() {
    let place = Workplace::new();
    let said = place.succeed(CADEM, "--engine gpu --print-source --precision f32");
    for words in
        ["alias Real = f32;", "fn outer_contacts(", "@compute @workgroup_size(", "destinations[item]"]
    {
        assert!(said.contains(words), "{words}");
    }
    assert!(!place.path("out").exists());
}

#[test]
fn dense_models() {
    compare(LIFE, "--steps 25");
    compare(LANDSLIDE, "--steps 60");
    compare(LANDSLIDE, "--steps 60 --precision f32");
    compare(MOD2, "--size 24 --steps 9");
    compare(HEAT, "--size 20 --steps 40");
    compare(HEAT, "--size 20 --steps 40 --precision f32");
    compare(POND, "--steps 25");
    compare(POND, "--steps 25 --precision f32");
}
