//! A run that goes on from a checkpoint ends with the files of a run that was never interrupted, byte by
//! byte.

use crate::running::{
    CADEM, HEAT, LANDSLIDE, LIFE, MOD2, Workplace, assert_same_results, check_files, report, warns_at_most,
};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Resumes a run, which must succeed; gives what it said.
fn resume(place: &Workplace, program: &str, words: &str) -> String {
    let output = place.invocation(program, &format!("resume {words}")).output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success() && warns_at_most(&said), "{program} resume {words}: {said}");
    String::from_utf8(output.stdout).unwrap()
}

/// The checkpoints of a run, the older one first.
fn checkpoints(run: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(run.join("checkpoints")).unwrap();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

/// Runs a program to its end, throws its last part away, and resumes it on other engines.
fn compare(program: &str, options: &str, every: u64) {
    let all =
        [("reference", "cpu --threads 3"), ("cpu --threads 2", "reference"), ("cpu --threads 3", "cpu")];
    compare_on(&all, program, options, every);
}

pub(crate) fn compare_on(parts: &[(&str, &str)], program: &str, options: &str, every: u64) {
    let place = Workplace::new();
    place.succeed(program, &format!("{options} --engine cpu --threads 2 --out whole"));
    for (begun, resumed) in parts {
        let name = format!("{program} {options} on {begun}, then on {resumed}");
        let run = place.path("here");
        place.succeed(program, &format!("{options} --engine {begun} --checkpoint-every {every} --out here"));
        assert_same_results(&place.path("whole"), &run, &name);
        let [older, latest] = checkpoints(&run).try_into().unwrap();
        let wanted = fs::read(&latest).unwrap();
        // What a run may leave that was killed later than its older checkpoint: rows and frames that come
        // again, a state in between, half of a file, and no end.
        fs::remove_file(&latest).unwrap();
        let series = run.join("observables.csv");
        let text = fs::read_to_string(&series).unwrap();
        fs::write(&series, &text[..text.len() - 3]).unwrap();
        for file in results_of(&run, "final") {
            fs::write(file, "another end").unwrap();
        }
        for frame in results_of(&run.join("frames"), "") {
            let name = frame.file_name().unwrap().to_str().unwrap();
            fs::copy(&frame, run.join("frames").join(name.replace("_0", "_9"))).unwrap();
        }
        fs::write(run.join(".final.csv.1-2.part"), "half").unwrap();
        fs::write(run.join("frames/.x.vti.1-2.part"), "half").unwrap();
        let file = older.strip_prefix(place.path("")).unwrap().display();
        let said = resume(&place, program, &format!("here --engine {resumed} --checkpoint {file}"));
        assert!(said.contains(", resumed after step "), "{said}");
        assert_same_results(&place.path("whole"), &run, &name);
        assert!(fs::read(&latest).unwrap() == wanted, "{name}: the checkpoint differs");
        assert_eq!(checkpoints(&run), [older, latest], "{name}");
        compare_reports(&report(&place.path("whole")), &report(&run));
    }
}

fn results_of(folder: &Path, start: &str) -> Vec<PathBuf> {
    let paths = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let is_meant = |path: &PathBuf| path.file_name().unwrap().to_str().unwrap().starts_with(start);
    paths.filter(|path| path.is_file() && is_meant(path)).collect()
}

/// The reports differ where docs/checkpoints.md says so, and nowhere else.
fn compare_reports(whole: &Value, resumed: &Value) {
    let taken = |name: &str| {
        let ends = ["_seconds", "_bytes", "_per_second", "engine_figures"];
        ends.iter().any(|end| name.ends_with(end))
    };
    let known = ["started", "resumed", "engine", "threads", "device"];
    // These differ because the command lines of the two runs do.
    let told = ["command_line", "checkpoint_every", "files"];
    let (whole, resumed) = (whole.as_object().unwrap(), resumed.as_object().unwrap());
    assert!(whole.keys().eq(resumed.keys()));
    for (key, value) in whole {
        let other = &resumed[key];
        if key == "progress" {
            for (key, value) in value.as_object().unwrap() {
                assert!(taken(key) || *value == other[key], "progress.{key}: {value} {}", other[key]);
            }
        } else if !known.contains(&key.as_str()) && !told.contains(&key.as_str()) {
            assert_eq!(value, other, "{key}");
        }
    }
    let resumed = resumed["resumed"].as_array().unwrap();
    assert_eq!(resumed.len(), 1);
    assert!(resumed[0]["step"].as_u64().unwrap() > 0 && resumed[0]["at"].is_string());
}

#[test]
fn life() {
    compare(LIFE, "--steps 40 --every 8", 15);
}

#[test]
fn landslide() {
    compare(LANDSLIDE, "--steps 40 --every 8", 15);
}

#[test]
fn mod2() {
    compare(MOD2, "--size 16 --steps 21", 6);
}

#[test]
fn heat_until_it_is_cool_enough() {
    compare(HEAT, "--size 14 --until 60", 8);
    compare_on(
        &[("reference", "cpu")],
        HEAT,
        "--size 11 --steps 30 --every 7 --precision f32 --set alpha=0.15",
        9,
    );
}

#[test]
fn cadem() {
    compare(CADEM, "--case published --steps 60 --every 9", 25);
    compare_on(
        &[("cpu", "reference")],
        CADEM,
        "--case published --walls single --precision f32 --steps 50 --seed 5",
        16,
    );
}

/// With particles of a file, of which one leaves: also how many have left is kept.
#[test]
fn cadem_with_an_opening() {
    let place = Workplace::new();
    place.write("drop.csv", "label,x,y,z,vx,vy,vz\n5,0.011,0.011,0.001,0,0,-2\n8,0.031,0.031,0.001,0,0,-2\n");
    let options = "--particles drop.csv --open z-low:5,5:5,5 --steps 200";
    place.succeed(CADEM, &format!("{options} --out whole"));
    place.succeed(CADEM, &format!("{options} --checkpoint-every 95 --out here"));
    let older = "here/checkpoints/step_00000190.checkpoint";
    resume(&place, CADEM, &format!("here --checkpoint {older}"));
    assert_same_results(&place.path("whole"), &place.path("here"), options);
    let left = |step: u64| {
        let bytes = fs::read(place.path(&format!("here/checkpoints/step_{step:08}.checkpoint"))).unwrap();
        String::from_utf8_lossy(&bytes).contains("\"left\": 1,")
    };
    assert!(left(190) && left(200));
}

/// What a configuration file said is in the checkpoint; the file is not asked again.
#[test]
fn a_configuration_file_may_change_meanwhile() {
    let place = Workplace::new();
    place.write("run.toml", "size = 10\nsteps = 12\ncheckpoint-every = 5\n\n[set]\nalpha = 0.1\n");
    place.succeed(HEAT, "--config run.toml --out whole");
    place.succeed(HEAT, "--config run.toml --out here");
    place.write("run.toml", "size = 11\n");
    resume(&place, HEAT, "here --checkpoint here/checkpoints/step_00000010.checkpoint --quiet");
    assert_same_results(&place.path("whole"), &place.path("here"), "with a configuration file");
}

#[test]
fn by_the_clock() {
    let place = Workplace::new();
    place.succeed(LIFE, "--steps 60 --out whole");
    place.succeed(LIFE, "--steps 60 --checkpoint-every 0.000001s --out here");
    let all = checkpoints(&place.path("here"));
    assert_eq!(all.len(), 2);
    let older = all[0].strip_prefix(place.path("")).unwrap().display();
    resume(&place, LIFE, &format!("here --checkpoint {older} --checkpoint-every 10min"));
    assert_same_results(&place.path("whole"), &place.path("here"), "by the clock");
    assert_eq!(checkpoints(&place.path("here")), all);
}

#[test]
fn a_run_that_has_ended_stays_as_it_is() {
    let place = Workplace::new();
    place.succeed(MOD2, "--size 8 --steps 9 --checkpoint-every 4");
    let before = fs::read(place.path("out/mod2/run.json")).unwrap();
    let said = resume(&place, MOD2, "out/mod2");
    assert_eq!(said, "the run in out/mod2 has ended after 9 steps; --steps continues past its end\n");
    assert_eq!(fs::read(place.path("out/mod2/run.json")).unwrap(), before);
}

/// The checkpoints of an earlier run go with its other files.
#[test]
fn a_new_run_does_not_keep_the_checkpoints_of_the_old_one() {
    let place = Workplace::new();
    place.succeed(MOD2, "--size 8 --steps 9 --checkpoint-every 2");
    assert_eq!(checkpoints(&place.path("out/mod2")).len(), 2);
    place.succeed(MOD2, "--size 8 --steps 3");
    assert!(checkpoints(&place.path("out/mod2")).is_empty());
    check_files(&place.path("out/mod2"));
}

/// Relaxed arithmetic has bits of its own: a run that has begun with it goes on with it, or says that it does
/// not.
#[test]
fn a_run_does_not_change_its_rounding_unawares() {
    let place = Workplace::new();
    let run =
        "--engine gpu --arithmetic relaxed --size 12 --until 0 --steps 30 --checkpoint-every 10 --out here";
    place.succeed(HEAT, run);
    let said = |words: &str| {
        let output = place.invocation(HEAT, &format!("resume here {words}")).output().unwrap();
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    let older = "--checkpoint here/checkpoints/step_00000020.checkpoint";
    for engine in ["--engine cpu", "--engine gpu --arithmetic strict"] {
        let (code, said) = said(&format!("{older} {engine}"));
        assert_eq!(code, Some(2), "{said}");
        assert!(said.contains("started with rounding that is relaxed on "), "{said}");
        assert!(said.contains("rounding that is exact would give other results"), "{said}");
    }
    assert_eq!(said(older), (Some(0), String::new()));
    assert_eq!(said(&format!("{older} --engine cpu --allow-rounding")), (Some(0), String::new()));
}

/// While a resumed run is under way, its folder has no file of the end.
#[test]
fn a_resumed_run_leaves_no_earlier_end() {
    let place = Workplace::new();
    let ends = |run: &str| {
        let entries = fs::read_dir(place.path(run)).unwrap().map(|entry| entry.unwrap().file_name());
        entries.filter(|name| name.to_str().unwrap().starts_with("final")).count()
    };
    for (program, run) in [(LANDSLIDE, "slide"), (LIFE, "life")] {
        let options = format!("--formats +asc --steps 200000 --every 5 --checkpoint-every 5 --out {run}");
        let frames = || fs::read_dir(place.path(run).join("frames")).map_or(0, Iterator::count);
        let wait = |count: usize| {
            let begin = Instant::now();
            while frames() < count {
                assert!(begin.elapsed() < Duration::from_secs(60), "the run does not get on");
                std::thread::sleep(Duration::from_millis(5));
            }
        };
        let child = place.command(program, &options).arg("--quiet").spawn().unwrap();
        wait(4);
        let sent =
            std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
        assert!(sent.success());
        assert_eq!(child.wait_with_output().unwrap().status.code(), Some(130));
        assert!(ends(run) > 1, "{program}");
        let before = frames();
        let mut child = place.invocation(program, &format!("resume {run} --quiet")).spawn().unwrap();
        wait(before + 2);
        child.kill().unwrap();
        child.wait().unwrap();
        assert_eq!(ends(run), 0, "{program}");
    }
}
