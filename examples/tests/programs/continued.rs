//! Runs that go on otherwise than they were begun: beyond their end, with more slots, from another folder,
//! with other inputs.

use crate::running::{
    CADEM, LANDSLIDE, LIFE, POND, Table, Workplace, assert_same_results, report, warns_at_most,
};
use std::fs;
use std::process::Output;

fn resume(place: &Workplace, program: &str, words: &str) -> Output {
    place.invocation(program, &format!("resume {words}")).output().unwrap()
}

/// Resumes a run, which must succeed; gives what it said.
fn succeed(place: &Workplace, program: &str, words: &str) -> String {
    let output = resume(place, program, words);
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success() && warns_at_most(&said), "{program} resume {words}: {said}");
    String::from_utf8(output.stdout).unwrap()
}

/// Resumes a run, which must be refused; gives what it said.
fn refuse(place: &Workplace, program: &str, words: &str) -> String {
    let output = resume(place, program, words);
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{program} resume {words}: {said}");
    said
}

/// A run that has come to its end becomes the longer run that it might have been, byte by byte: also the
/// frame of its end goes, where a longer run has none.
#[test]
fn a_run_goes_on_beyond_its_end() {
    for (program, options, every) in [
        (LIFE, "", 7),
        (POND, "", 7),
        (LANDSLIDE, "--until 0", 6),
        (CADEM, "--case published --walls single", 9),
        (env!("CARGO_BIN_EXE_elementary"), "", 7),
    ] {
        let place = Workplace::new();
        place.succeed(program, &format!("{options} --steps 41 --every {every} --out whole"));
        place.succeed(
            program,
            &format!("{options} --steps 20 --every {every} --checkpoint-every 8 --out here"),
        );
        assert!(place.path("here/checkpoints/step_00000020.checkpoint").is_file(), "{program}");
        succeed(&place, program, "here --steps 33");
        let said = succeed(&place, program, "here --steps 41 --engine reference");
        assert!(said.contains("resumed after step 33"), "{program}: {said}");
        assert_same_results(&place.path("whole"), &place.path("here"), program);
        let report = report(&place.path("here"));
        assert_eq!(report["progress"]["steps_wanted"], 41, "{program}");
        assert_eq!(report["resumed"][1]["steps_wanted"], 41, "{program}");
    }
}

/// How often it is written stays as it was, although it follows from the number of steps.
#[test]
fn the_interval_of_outputs_stays() {
    let place = Workplace::new();
    place.succeed(LIFE, "--steps 40 --checkpoint-every 15 --out here");
    succeed(&place, LIFE, "here --steps 60");
    place.succeed(LIFE, "--steps 60 --every 2 --out whole");
    assert_same_results(&place.path("whole"), &place.path("here"), "every 2 steps");
}

/// A run until its criterion holds writes states ever further apart, also after it was interrupted.
#[test]
fn a_run_until_it_stops_goes_on() {
    let place = Workplace::new();
    let sandpile = env!("CARGO_BIN_EXE_sandpile");
    place.succeed(sandpile, "--grains 3000 --size 31 --out whole");
    place.succeed(sandpile, "--grains 3000 --size 31 --checkpoint-every 100 --out here");
    let older =
        fs::read_dir(place.path("here/checkpoints")).unwrap().map(|entry| entry.unwrap().path()).min();
    let said = succeed(&place, sandpile, &format!("here --checkpoint {}", older.unwrap().display()));
    assert!(said.contains(", at most 1000000 steps, resumed after step "), "{said}");
    assert_same_results(&place.path("whole"), &place.path("here"), "until it stops");
    let steps = Table::read(&place.path("here/observables.csv")).column("step");
    assert_eq!(steps[..12], [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 10.0, 12.0, 14.0]);
    assert_eq!(report(&place.path("here"))["every"], "growing");
}

/// A run that is killed on its way beyond its end, before its next checkpoint, goes on without being told
/// again.
#[test]
fn the_later_end_is_remembered() {
    let place = Workplace::new();
    place.succeed(LIFE, "--steps 40 --every 10 --checkpoint-every 15 --out here");
    place.succeed(LIFE, "--steps 60 --every 10 --out whole");
    let text = place.read("here/run.json").replace("\"steps_wanted\": 40", "\"steps_wanted\": 60");
    place.write("here/run.json", &text.replace("\"outcome\": \"done\"", "\"outcome\": \"running\""));
    succeed(&place, LIFE, "here");
    assert_same_results(&place.path("whole"), &place.path("here"), "60 steps");
}

#[test]
fn no_run_becomes_shorter_or_goes_on_against_its_model() {
    let place = Workplace::new();
    place.succeed(LIFE, "--steps 40 --checkpoint-every 15 --out here");
    let said = refuse(&place, LIFE, "here --steps 39");
    assert!(said.contains("40 steps of the run are done; --steps must be larger"), "{said}");
    place.succeed(LANDSLIDE, "--until 1e9 --steps 100 --checkpoint-every 15 --out slide");
    let said = refuse(&place, LANDSLIDE, "slide --steps 200");
    assert!(said.contains("the model has stopped the run after 20 steps: no cell sends more than"), "{said}");
    let said = succeed(&place, LANDSLIDE, "slide");
    assert_eq!(said, "the run in slide has ended after 20 steps\n");
}

/// A third particle falls into a cell on the floor, where the floor takes one of three slots. With more slots
/// the run goes on, to the files of a run that had them all along. The slots are remembered.
#[test]
fn a_run_with_a_full_cell_goes_on_with_more_slots() {
    let place = Workplace::new();
    let rows = "1,0.0105,0.0105,0.0006,0,0,0\n2,0.0115,0.0115,0.0006,0,0,0\n3,0.011,0.011,0.0025,0,0,-1\n";
    place.write("cloud.csv", &format!("label,x,y,z,vx,vy,vz\n{rows}"));
    let options = "--particles cloud.csv --steps 2000 --every 100 --checkpoint-every 10";
    let said = place.fail(1, CADEM, &format!("{options} --slots 3 --out here"));
    assert!(said.contains("give the population more slots"), "{said}");
    place.succeed(CADEM, &format!("{options} --slots 6 --out whole"));
    let said = String::from_utf8(resume(&place, CADEM, "here --quiet").stderr).unwrap();
    assert!(said.contains("give the population more slots"), "{said}");
    succeed(&place, CADEM, "here --slots 6");
    assert_same_results(&place.path("whole"), &place.path("here"), "more slots");
    assert_eq!(report(&place.path("here"))["model"]["groups"][0]["slots"], 6);
    // Neither the run that goes on now, nor its pictures, are told of the slots again.
    succeed(&place, CADEM, "here --steps 2010");
    assert_eq!(report(&place.path("here"))["model"]["groups"][0]["slots"], 6);
    let output = place.invocation(CADEM, "render here --out pictures").output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

/// A map that was changed meanwhile makes another run of it.
#[test]
fn inputs_must_be_as_they_were() {
    let place = Workplace::new();
    let grid = |value: f64| {
        let rows = ["1 1 1 1\n", "1 2 1 1\n", &format!("1 1 {value} 1\n")].concat();
        format!("ncols 4\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 10\n{rows}")
    };
    place.write("ground.asc", &grid(1.0));
    place.write("debris.asc", &grid(0.5));
    let options = "--dem ground.asc --debris debris.asc --until 0 --steps 30 --checkpoint-every 8";
    place.succeed(LANDSLIDE, &format!("{options} --out here"));
    place.succeed(LANDSLIDE, &format!("{options} --out whole"));
    place.write("debris.asc", &grid(0.75));
    let said = refuse(&place, LANDSLIDE, "here --checkpoint here/checkpoints/step_00000024.checkpoint");
    assert!(said.contains("input file is debris.asc of the checksum "), "{said}");
    // The older checkpoint began from the same file: it is not offered.
    let said = refuse(&place, LANDSLIDE, "here --steps 40");
    assert!(said.contains("input file is debris.asc of") && !said.contains("resume from it with"), "{said}");
    place.write("debris.asc", &grid(0.5));
    succeed(&place, LANDSLIDE, "here --checkpoint here/checkpoints/step_00000024.checkpoint");
    assert_same_results(&place.path("whole"), &place.path("here"), "the same inputs");
    let inputs = &report(&place.path("here"))["inputs"];
    assert_eq!(inputs[1]["path"], "debris.asc");
}

/// Relative paths on the command line go from the folder in which it was given; those of `resume` and
/// `render` from theirs.
#[test]
fn a_run_goes_on_from_another_folder() {
    let place = Workplace::new();
    fs::create_dir(place.path("below")).unwrap();
    place.write("drop.csv", "label,x,y,z,vx,vy,vz\n5,0.011,0.011,0.004,0,0,0\n8,0.031,0.031,0.005,0,0,0\n");
    let options = "--particles drop.csv --steps 60 --checkpoint-every 25";
    place.succeed(CADEM, &format!("{options} --out whole"));
    place.succeed(CADEM, &format!("{options} --out here"));
    for words in
        ["resume ../here --checkpoint ../here/checkpoints/step_00000050.checkpoint", "render ../here"]
    {
        let output = place.invocation(CADEM, words).current_dir(place.path("below")).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
    assert_same_results(&place.path("whole"), &place.path("here"), "another folder");
    assert!(place.path("here_pictures/run.json").is_file());
}
