//! Limits of the machine, and files that are none: a sentence in time.
#![cfg(target_os = "linux")]

use crate::running::{CADEM, HEAT, LIFE, Workplace};
use std::ffi::OsStr;
use std::os::unix::ffi::OsStrExt;
use std::process::Command;

#[test]
fn memory_that_the_process_may_not_have() {
    let place = Workplace::new();
    let script = r#"ulimit -v 3000000; exec "$0" "$@""#;
    for words in ["run --size 600 --until 0", "compare --size 600 --until 0"] {
        let mut command = Command::new("sh");
        command.args(["-c", script, HEAT]).args(words.split(' ')).current_dir(place.path(""));
        let output = command.args(["--set", "alpha=0.1"]).output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{words}: {said}");
        assert!(said.contains("GB of memory, and the limit of this process (ulimit -v) has "), "{said}");
    }
}

#[test]
fn threads_without_end() {
    let place = Workplace::new();
    let run = |threads: &str| {
        let mut command = place.command(HEAT, "--size 6 --until 0 --steps 1 --json");
        command.env("RAYON_NUM_THREADS", threads).output().unwrap()
    };
    let output = run("99999");
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("99999 threads are too many for the cpu engine; take at most 1024"), "{said}");
    let report: serde_json::Value = serde_json::from_slice(&run("3").stdout).unwrap();
    assert_eq!(report["threads"], 3);
}

#[test]
fn words_that_are_not_utf_8() {
    let place = Workplace::new();
    let name = OsStr::from_bytes(b"non\xff");
    for words in ["run --out", "render", "inspect", "resume", "run --checkpoint-every 50 --particles"] {
        let output = place.invocation(CADEM, words).arg(name).output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{words}: {said}");
        let wanted = "error: `non\u{fffd}` on the command line is not UTF-8; rename the file or the folder\n";
        assert_eq!(said, wanted, "{words}");
    }
    assert!(!place.path("out").exists() && !place.path("").join(name).exists());
}

#[test]
fn folders_that_are_not_utf_8_can_be_worked_in() {
    let place = Workplace::new();
    let folder = place.path("").join(OsStr::from_bytes(b"non\xff"));
    std::fs::create_dir(&folder).unwrap();
    for words in [
        "run --size 6 --until 0 --steps 4 --checkpoint-every 2 --out .",
        "render . --pixels 400x300 --animation none",
        "render ./checkpoints/step_00000002.checkpoint --pixels 400x300 --json",
        "inspect . --json",
    ] {
        let output = place.invocation(HEAT, words).current_dir(&folder).output().unwrap();
        assert!(output.status.success(), "{words}: {}", String::from_utf8_lossy(&output.stderr));
    }
}

/// A pipe without a writer, or a device without an end, would be read for ever.
#[test]
fn only_regular_files_are_read() {
    let place = Workplace::new();
    for folder in ["run", "run/checkpoints"] {
        std::fs::create_dir(place.path(folder)).unwrap();
    }
    for pipe in ["run/run.json", "run/pipe"] {
        assert!(Command::new("mkfifo").arg(place.path(pipe)).status().unwrap().success());
    }
    for file in ["run/pipe", "/dev/zero"] {
        for (program, words) in [
            (CADEM, format!("run --particles {file}")),
            (LIFE, format!("run --initial alive={file}")),
            (HEAT, format!("run --config {file}")),
            (HEAT, format!("render {file}")),
            (HEAT, format!("inspect {file}")),
            (HEAT, format!("resume run --checkpoint {file}")),
            (HEAT, "render run".to_owned()),
            (HEAT, "inspect run".to_owned()),
            (HEAT, "run --size 6 --out run".to_owned()),
        ] {
            let mut command = Command::new("timeout");
            command.args(["20", program]).args(words.split(' ')).current_dir(place.path(""));
            let output = command.output().unwrap();
            let said = String::from_utf8(output.stderr).unwrap();
            assert_eq!(output.status.code(), Some(2), "{words}: {said}");
            assert!(
                said.contains("it is not a regular file but a folder, a pipe or a device"),
                "{words}: {said}"
            );
        }
    }
}
