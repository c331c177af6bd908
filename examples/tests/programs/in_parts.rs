//! Programs on parts of their space: the files of one machine, byte by byte.

use crate::resumed::compare_on;
use crate::running::{CADEM, HEAT, LANDSLIDE, LIFE, Workplace, report};

/// Begun and gone on in other parts, and on one engine.
const TURNS: [(&str, &str); 3] =
    [("parts:3:cpu:1", "parts:2:cpu"), ("parts:2:cpu", "reference"), ("cpu:2", "parts:4:cpu:1")];

#[test]
fn cells() {
    compare_on(&TURNS, LIFE, "--steps 30 --every 8", 11);
    compare_on(&TURNS[..2], LANDSLIDE, "--steps 30 --every 8", 11);
    compare_on(&[("parts:2x1:cpu:1", "parts:4x1:cpu")], LANDSLIDE, "--steps 80 --every 40", 30);
    compare_on(&TURNS[1..], HEAT, "--size 12 --steps 30 --every 7 --precision f32", 9);
}

#[test]
fn items() {
    compare_on(&TURNS, CADEM, "--case published --steps 60 --every 9", 25);
    compare_on(&TURNS[..1], CADEM, "--case published --walls single --precision f32 --steps 50 --seed 5", 16);
}

/// One thread has drawn the frames, whatever the parts; the report tells how many there were.
#[test]
fn the_report_tells_of_the_parts() {
    let place = Workplace::new();
    place.succeed(LIFE, "--steps 3 --engine parts:3:cpu:2");
    let told = report(&place.path("out/life"));
    assert_eq!((&told["engine"], &told["threads"]), (&"parts".into(), &6.into()));
    assert_eq!((&told["device"]["parts"], &told["device"]["part_engine"]), (&"3".into(), &"cpu".into()));
}

#[test]
fn what_parts_cannot_do_is_refused() {
    let place = Workplace::new();
    for (words, wanted) in [
        ("watch --engine parts:2:cpu", "`watch` does not run on the parts engine"),
        ("run --engine parts", "engine `parts`: write parts:N:cpu[:THREADS]"),
        ("run --engine parts:2", "say what runs each part: parts:2:cpu"),
        (
            "run --engine parts:2x:cpu",
            "`2x` is not a grid of parts; write two whole numbers from 1, such as 2x3",
        ),
        ("run --engine parts:1x2:cpu:1", "cannot be cut into 1 parts along y and 2 along z"),
        ("run --engine parts:2:mpi", "a part runs on the cpu or the gpu engine, not on `mpi`"),
        ("run --engine parts:2:cpu --threads 3", "--threads is for --engine cpu, not for the parts engine"),
        ("run --engine cpu:2 --threads 3", "--threads is given twice"),
        ("run --parts 3", "unexpected argument '--parts'"),
        (
            "run --engine parts:300:cpu:1",
            "cannot be cut into 300 parts; the model reaches so far that at most 256",
        ),
        ("sweep --engine parts:2", "say what runs each part"),
        ("compare --engines cpu,parts:2", "say what runs each part"),
    ] {
        let output = place.invocation(LIFE, words).output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{words}: {said}");
        assert!(said.contains(wanted), "{words}: {said}");
    }
}
