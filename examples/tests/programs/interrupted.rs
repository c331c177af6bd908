//! Ctrl-C ends a run after its step, with its files complete.
#![cfg(unix)]

use crate::running::{CADEM, HEAT, Workplace, check_files, report};
use std::fs;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

fn interrupt(signal: &str, program: &str, options: &str) {
    let place = Workplace::new();
    let mut command = place.command(program, &format!("{options} --out here"));
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    // It is well under way when the third row is written.
    let begin = Instant::now();
    let rows =
        || fs::read_to_string(place.path("here/observables.csv")).map_or(0, |text| text.lines().count());
    while rows() < 4 {
        assert!(begin.elapsed() < Duration::from_secs(60), "the run does not get on");
        std::thread::sleep(Duration::from_millis(5));
    }
    let sent = Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
    assert!(sent.success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130));
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(said.contains("interrupted after "), "{said}");
    let folder = place.path("here");
    check_files(&folder);
    let report = report(&folder);
    assert_eq!(report["progress"]["outcome"], "interrupted");
    assert!(report["progress"]["steps"].as_u64().unwrap() >= 20);
    assert!(folder.join("final.png").is_file());
}

#[test]
fn by_ctrl_c() {
    interrupt("-INT", CADEM, "--steps 100000000 --every 10");
}

#[test]
fn by_a_request_to_terminate() {
    interrupt("-TERM", HEAT, "--size 20 --until 0 --steps 1000000000 --every 10");
}

/// Below `nohup` a run outlives its terminal.
#[cfg(target_os = "linux")]
#[test]
fn not_by_a_terminal_that_closes_below_nohup() {
    let place = Workplace::new();
    let script = r#"trap '' HUP; exec "$0" "$@""#;
    let mut command = Command::new("sh");
    let words = "run --size 20 --until 0 --steps 1000000000 --every 10 --out here";
    command.args(["-c", script, HEAT]).args(words.split(' ')).current_dir(place.path(""));
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let begin = Instant::now();
    let rows =
        || fs::read_to_string(place.path("here/observables.csv")).map_or(0, |text| text.lines().count());
    let id = child.id();
    let mut wait_for = |wanted: usize| {
        while rows() < wanted {
            assert!(begin.elapsed() < Duration::from_secs(60), "the run does not get on");
            assert!(child.try_wait().unwrap().is_none(), "the run has ended");
            std::thread::sleep(Duration::from_millis(5));
        }
    };
    let send = |signal: &str| {
        assert!(Command::new("kill").args([signal, &id.to_string()]).status().unwrap().success());
    };
    wait_for(4);
    send("-HUP");
    wait_for(rows() + 4);
    send("-TERM");
    assert_eq!(child.wait().unwrap().code(), Some(130));
}
