//! What is refused, with a sentence and without a hang.

use super::launched::run;
use crate::running::{LIFE, Workplace};

#[test]
fn what_makes_no_sense_is_refused_once() {
    let place = Workplace::new();
    for (words, wanted) in [
        ("run --engine cpu", "a launcher started 3 processes, and each would run the whole model"),
        ("run --engine parts:2:cpu", "share it with --engine mpi:cpu, or start one process"),
        ("run --engine mpi", "engine `mpi`: write mpi:cpu[:THREADS]"),
        ("run --engine mpi:2x1:cpu", "2x1 are 2 parts, but the job has 3 processes"),
        ("run --engine mpi:parts", "a part runs on the cpu or the gpu engine, not on `parts`"),
        ("run --engine mpi:cpu --threads 2", "--threads is for --engine cpu, not for the mpi engine"),
        ("watch --engine mpi:cpu", "`watch` does not run on the mpi engine"),
        ("sweep --engine mpi:cpu", "`sweep` does not run on the mpi engine"),
        ("render --engine mpi:cpu", "`render` does not run on the mpi engine"),
        ("run --engine mpi:cpu --formats none", "none"),
        ("run --engine mpi:cpu --initial alive=away.asc", "away.asc"),
    ] {
        let output = run(&place, 3, LIFE, words);
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{words}: {said}");
        assert!(said.contains(wanted), "{words}: {said}");
        let errors = said.lines().filter(|line| line.starts_with("error: ")).count();
        assert_eq!(errors, 1, "{words}: {said}");
    }
}

#[test]
fn engines_of_one_process_are_not_compared_by_many() {
    let place = Workplace::new();
    let output = run(&place, 2, LIFE, "compare --engines reference,cpu");
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("a launcher started 2 processes"), "{said}");
}

/// A space that is too thin for so many parts.
#[test]
fn what_cannot_be_cut_is_refused() {
    let place = Workplace::new();
    let output = run(&place, 5, crate::running::HEAT, "run --size 2 --steps 3 --engine mpi:cpu:1");
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("2 rows along y and 2 along z cannot be cut into 5 parts"), "{said}");
}

/// A launcher of another MPI starts processes that each believe to be alone.
#[test]
fn a_launcher_of_another_library_is_noticed() {
    let place = Workplace::new();
    let mut command = place.command(LIFE, "--steps 3 --engine mpi:cpu:1");
    let output = command.env("PMI_SIZE", "3").env("OMPI_ALLOW_RUN_AS_ROOT", "1").output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("has started 3 processes, but each is alone"), "{said}");
}

/// Without a launcher there is one part.
#[test]
fn one_process_needs_no_launcher() {
    let place = Workplace::new();
    place.succeed(LIFE, "--steps 3 --engine mpi:cpu:1");
    let told = crate::running::report(&place.path("out/life"));
    assert_eq!((&told["engine"], &told["device"]["parts"]), (&"mpi".into(), &"1".into()));
}
