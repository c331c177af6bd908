//! How jobs end before they are done: by a signal, a dead process, a fault, a mistake.

use super::launched::{ended, mpirun, process_of, run, signal, wait_until};
use crate::running::{CADEM, LIFE, Table, Workplace, assert_same_results, report};
use std::fs;
use std::path::PathBuf;

/// A run without end, which writes a checkpoint every so often.
const ENDLESS: &str =
    "run --steps 100000000 --every 50000000 --checkpoint-every 20 --engine mpi:cpu:1 --out here";

fn checkpoints(place: &Workplace) -> Vec<PathBuf> {
    let entries = fs::read_dir(place.path("here/checkpoints")).into_iter().flatten();
    let paths = entries.map(|entry| entry.unwrap().path());
    let mut all: Vec<_> =
        paths.filter(|path| path.extension().is_some_and(|it| it == "checkpoint")).collect();
    all.sort();
    all
}

/// A run that goes on from the latest checkpoint on one machine ends as one that was never interrupted.
fn assert_usable(place: &Workplace, program: &str) {
    let latest = checkpoints(place).pop().unwrap();
    let name = latest.file_stem().unwrap().to_str().unwrap();
    let step: u64 = name.trim_start_matches("step_").parse().unwrap();
    let options = format!("--steps {} --every 50000000", step + 5);
    let resume = format!("resume here --steps {} --engine cpu:1 --quiet", step + 5);
    let output = place.invocation(program, &resume).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    place.succeed(program, &format!("{options} --out whole"));
    assert_same_results(&place.path("whole"), &place.path("here"), program);
}

/// Whichever rank it is.
#[test]
fn a_killed_process_ends_all_and_leaves_a_checkpoint() {
    for rank in [1, 2, 0] {
        let place = Workplace::new();
        let child = mpirun(&place, 3, LIFE, ENDLESS).spawn().unwrap();
        wait_until("a checkpoint", || checkpoints(&place).len() == 2);
        signal(process_of(child.id(), rank), "-KILL");
        let output = ended(child, "a job with a killed process");
        assert!(!output.status.success());
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(said.contains("signal 9"), "{said}");
        assert_usable(&place, LIFE);
    }
}

/// Ctrl-C reaches the launcher, which tells its processes; so does a job manager.
#[test]
fn an_interrupted_job_ends_with_all_its_files() {
    for name in ["-INT", "-TERM"] {
        let place = Workplace::new();
        let mut command = mpirun(&place, 3, LIFE, ENDLESS);
        // How many seconds processes that are told to end may take to write their files.
        let child = command.env("OMPI_MCA_odls_base_sigkill_timeout", "10").spawn().unwrap();
        wait_until("a checkpoint", || checkpoints(&place).len() == 2);
        signal(child.id(), name);
        let output = ended(child, "an interrupted job");
        assert!(!output.status.success());
        let told = report(&place.path("here"));
        assert_eq!(told["progress"]["outcome"], "interrupted", "{}", String::from_utf8_lossy(&output.stderr));
        let steps = told["progress"]["steps"].as_f64().unwrap();
        assert_eq!(Table::read(&place.path("here/observables.csv")).last("step"), steps);
        assert!(place.path("here/final.png").is_file());
        assert_usable(&place, LIFE);
    }
}

/// Wherever it is: in the part of the host, or in another one.
#[test]
fn a_fault_is_told_as_on_one_machine() {
    let place = Workplace::new();
    for y in [0.005, 0.021, 0.035] {
        place.write("fast.csv", &format!("label,x,y,z,vx,vy,vz\n7,0.011,{y},0.011,1e6,0,0\n"));
        // A third particle falls into a cell on the floor, where the floor takes one of three slots.
        let [first, second, third] = [y - 0.0005, y + 0.0005, y];
        let rows = format!(
            "1,0.0105,{first},0.0006,0,0,0\n2,0.0115,{second},0.0006,0,0,0\n3,0.011,{third},0.0025,0,0,-1\n"
        );
        place.write("full.csv", &format!("label,x,y,z,vx,vy,vz\n{rows}"));
        for words in ["--particles fast.csv --steps 3", "--particles full.csv --slots 3 --steps 2000"] {
            let wanted = place.fail(1, CADEM, words);
            let output = run(&place, 3, CADEM, &format!("run {words} --engine mpi:cpu:1"));
            let said = String::from_utf8(output.stderr).unwrap();
            assert_eq!(output.status.code(), Some(1), "{said}");
            let told = wanted.lines().filter(|line| line.starts_with("error: ") || line.contains("cell ["));
            for line in told {
                assert!(said.lines().any(|said| said == line), "{said}: not {line}");
            }
        }
    }
}
