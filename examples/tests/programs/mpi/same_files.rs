//! The same files on any number of ranks, also across checkpoints, and the same verdicts.

use super::launched::{run, succeed};
use crate::running::{CADEM, HEAT, LANDSLIDE, LIFE, Workplace, assert_same_results, report};
use std::fs;
use std::path::Path;

/// The checkpoints of a run by name, with their bytes.
fn checkpoints(run: &Path) -> Vec<(String, Vec<u8>)> {
    let entries = fs::read_dir(run.join("checkpoints")).unwrap().map(|entry| entry.unwrap());
    let file =
        |entry: fs::DirEntry| (entry.file_name().into_string().unwrap(), fs::read(entry.path()).unwrap());
    let mut all: Vec<_> = entries.map(file).collect();
    all.sort();
    all
}

/// Frames, observables, pictures and final states on so many ranks, and on one machine without MPI.
fn compare(program: &str, options: &str, ranks: &[usize]) {
    compare_on("mpi:cpu:1", program, options, ranks);
}

fn compare_on(engine: &str, program: &str, options: &str, ranks: &[usize]) {
    let place = Workplace::new();
    place.succeed(program, &format!("{options} --engine cpu:2 --out whole"));
    for ranks in ranks {
        let out = format!("on{ranks}");
        succeed(&place, *ranks, program, &format!("run {options} --engine {engine} --out {out}"));
        assert_same_results(&place.path("whole"), &place.path(&out), &format!("{options} on {ranks} ranks"));
    }
}

#[test]
fn life() {
    compare(LIFE, "--steps 30 --every 8", &[1, 2, 3, 4]);
}

#[test]
fn landslide() {
    compare(LANDSLIDE, "--steps 30 --every 8", &[1, 2, 3, 4]);
}

#[test]
fn heat() {
    compare(HEAT, "--size 12 --steps 30 --every 7 --precision f32", &[2, 3]);
    compare(HEAT, "--size 14 --until 60", &[1, 4]);
}

#[test]
fn cadem() {
    compare(CADEM, "--case published --steps 60 --every 9", &[1, 2, 3, 4]);
    compare(CADEM, "--case published --walls single --precision f32 --steps 50 --seed 5", &[3]);
}

/// Each rank with a graphics card, or with the processor in its place.
#[test]
fn graphics_cards() {
    compare_on("mpi:gpu", LIFE, "--steps 12 --every 5", &[2]);
    compare_on("mpi:gpu", LANDSLIDE, "--steps 10 --every 4", &[3]);
    compare_on("mpi:1x2:gpu", HEAT, "--size 12 --steps 12 --every 5 --precision f32", &[2]);
}

/// A run that was begun on three ranks goes on on two, on one, on the reference engine and on parts.
#[test]
fn checkpoints_know_no_ranks() {
    for (program, options) in [
        (CADEM, "--case published --steps 60 --every 9 --checkpoint-every 25"),
        (HEAT, "--size 12 --steps 30 --every 7 --checkpoint-every 9"),
    ] {
        let place = Workplace::new();
        place.succeed(program, &format!("{options} --out whole"));
        let begin = format!("run {options} --engine mpi:cpu:1 --out here");
        succeed(&place, 3, program, &begin);
        let wanted = checkpoints(&place.path("here"));
        let [(older, _), (latest, _)] = &wanted[..] else { panic!("two checkpoints are kept") };
        for on in ["2", "1", "reference", "parts:2:cpu", "as begun"] {
            fs::remove_file(place.path("here/checkpoints").join(latest)).unwrap();
            let words = format!("resume here --checkpoint here/checkpoints/{older}");
            match on.parse() {
                Ok(ranks) => drop(succeed(&place, ranks, program, &format!("{words} --engine mpi:cpu:1"))),
                // The run's own engine.
                Err(_) if on == "as begun" => drop(succeed(&place, 2, program, &words)),
                Err(_) => {
                    let output =
                        place.invocation(program, &format!("{words} --engine {on}")).output().unwrap();
                    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
                }
            }
            assert_same_results(&place.path("whole"), &place.path("here"), &format!("{options}, on {on}"));
            assert!(checkpoints(&place.path("here")) == wanted, "{options}, on {on}");
        }
    }
}

/// A run that began on one machine goes on on ranks.
#[test]
fn ranks_go_on_with_a_run_of_one_machine() {
    let place = Workplace::new();
    let options = "--case published --steps 60 --every 9 --checkpoint-every 25";
    place.succeed(CADEM, &format!("{options} --out whole"));
    place.succeed(CADEM, &format!("{options} --engine cpu:1 --out here"));
    let wanted = checkpoints(&place.path("here"));
    let [(older, _), (latest, _)] = &wanted[..] else { panic!("two checkpoints are kept") };
    fs::remove_file(place.path("here/checkpoints").join(latest)).unwrap();
    let words = format!("resume here --checkpoint here/checkpoints/{older}");
    let refused = run(&place, 2, CADEM, &words);
    let said = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(said.contains("a launcher started 2 processes, and each would run the whole model"), "{said}");
    succeed(&place, 2, CADEM, &format!("{words} --engine mpi:cpu:1"));
    assert_same_results(&place.path("whole"), &place.path("here"), "from one machine");
    assert!(checkpoints(&place.path("here")) == wanted);
}

/// Several executions, some of them at the same time, also in another precision.
#[test]
fn ranks_are_compared_with_other_engines() {
    let place = Workplace::new();
    for (program, options) in [(LIFE, ""), (CADEM, "--case published")] {
        let engines = "reference,mpi:cpu:1,parts:2:cpu:1,mpi:cpu:2";
        let words = format!("compare {options} --engines {engines} --steps 12 --repeats 2 --out compared");
        succeed(&place, 3, program, &words);
        let told: serde_json::Value =
            serde_json::from_slice(&fs::read(place.path("compared/compare.json")).unwrap()).unwrap();
        for engine in &told["engines"].as_array().unwrap()[1..] {
            assert_eq!(engine["verdict"], "IDENTICAL", "{engine}");
        }
    }
    let words = "compare --case published --engines mpi:cpu:1,mpi:cpu:1@f32 --steps 6 --repeats 1";
    assert_eq!(run(&place, 2, CADEM, words).status.code(), Some(0));
}

/// Which process had which part is told.
#[test]
fn the_report_tells_of_the_ranks() {
    let place = Workplace::new();
    succeed(&place, 3, LIFE, "run --steps 3 --engine mpi:cpu:2");
    let told = report(&place.path("out/life"));
    assert_eq!((&told["engine"], &told["threads"]), (&"mpi".into(), &6.into()));
    assert_eq!((&told["device"]["parts"], &told["device"]["part_engine"]), (&"3".into(), &"cpu".into()));
    let ranks: Vec<&str> = told["device"]["ranks"].as_str().unwrap().split("; ").collect();
    let host = told["host"]["name"].as_str();
    for (number, rank) in ranks.iter().enumerate() {
        assert!(rank.starts_with(&format!("{number}: ")) && rank.ends_with(", 2 threads"), "{ranks:?}");
        assert!(host.is_none_or(|host| rank.contains(host)), "{ranks:?} on {host:?}");
    }
    assert_eq!(ranks.len(), 3);
    // Where none are chosen, processes share the cores.
    succeed(&place, 4, LIFE, "run --steps 3 --engine mpi:cpu");
    let threads = report(&place.path("out/life"))["threads"].as_u64().unwrap() as usize;
    assert!(
        threads >= 4 && threads <= 4.max(std::thread::available_parallelism().unwrap().get()),
        "{threads}"
    );
}
