//! What is printed: results that are lost are an error, and files of others do not control the terminal.
#![cfg(target_os = "linux")]

use crate::running::{CADEM, HEAT, LIFE, Workplace};
use std::fs::File;
use std::process::{Command, Output, Stdio};

const RUN: &str = "run --size 6 --until 0 --steps 4";

/// Runs a program whose results go there.
fn told(command: &mut Command, stdout: Stdio) -> Output {
    command.stdout(stdout).stderr(Stdio::piped()).spawn().unwrap().wait_with_output().unwrap()
}

#[test]
fn results_on_a_full_disk_are_an_error() {
    let place = Workplace::new();
    let run = format!("{RUN} --out run");
    let compare = "compare --size 6 --until 0 --steps 2 --repeats 1 --engines reference,cpu:1";
    for words in [
        run.as_str(),
        &format!("{run} --json"),
        "inspect run",
        "inspect run --json",
        "list",
        "list --json",
        compare,
        &format!("{compare} --json"),
        "render run --pixels 400x300 --animation none",
        "new waves --json",
        "run --help",
        "--version",
        "run --engine gpu --print-source",
    ] {
        let full = File::options().write(true).open("/dev/full").unwrap();
        let output = told(&mut place.invocation(HEAT, words), full.into());
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{words}: {said}");
        assert!(said.contains("error: cannot write to standard output"), "{words}: {said}");
        assert!(said.contains("caused by: No space left on device"), "{words}: {said}");
    }
    assert!(place.path("run/final.png").is_file(), "the files of the run are whole");
    let full = || File::options().write(true).open("/dev/full").unwrap();
    let quiet = told(&mut place.invocation(HEAT, &format!("{run} --quiet")), full().into());
    assert!(quiet.status.success());
}

#[test]
fn that_no_one_reads_on_is_no_error() {
    let place = Workplace::new();
    for words in [format!("{RUN} --json"), RUN.to_owned(), "list".to_owned(), "run --help".to_owned()] {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let output = told(&mut place.invocation(HEAT, &words), writer.into());
        assert_eq!(String::from_utf8_lossy(&output.stderr), "", "{words}");
        assert!(output.status.success(), "{words}");
    }
}

#[test]
fn files_do_not_control_the_terminal() {
    let place = Workplace::new();
    place.write("in.csv", "label,x,y,z,vx,vy,vz\n1,\u{1b}[2J\u{9b}31m,0,0,0,0,0\n");
    let said = place.fail(2, CADEM, "--particles in.csv");
    assert!(said.contains(r"in.csv:2: `\u001b[2J\u009b31m` in column `x` is not a number"), "{said}");
    place.write("in.csv", &format!("label,x,y,z,vx,vy,vz\n1,{},0,0,0,0,0\n", "x".repeat(3_000_000)));
    let said = place.fail(2, CADEM, "--particles in.csv");
    assert!(said.len() < 3000 && said.contains("in column `x` is not a number"), "{}", said.len());
    place.write("run.toml", "\"\\u001b]0;gone\\u0007\" = 1\n");
    assert!(place.fail(2, HEAT, "--config run.toml").contains(r"unknown key `\u001b]0;gone\u0007`"));
    place.write("ground.asc", "ncols 1\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\n\u{1b}[31m\n");
    let said = place.fail(2, LIFE, "--initial alive=ground.asc");
    assert!(said.contains(r"\u001b[31m") && !said.contains('\u{1b}'), "{said}");
    // What a run has been called.
    place.succeed(HEAT, "--size 6 --until 0 --steps 2 --out run");
    let report =
        place.read("run/run.json").replace("\"heat\"", &format!("\"\\u001b[31m{}\"", "y".repeat(9999)));
    place.write("run/run.json", &report);
    let output = place.invocation(HEAT, "inspect run").output().unwrap();
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(said.starts_with(r"\u001b[31myyy") && !said.contains('\u{1b}'), "{said}");
    assert!(said.lines().all(|line| line.len() < 5000));
}
