//! Checkpoints that a run cannot go on from are refused with the reason, nothing is changed, and another one
//! is offered.

use crate::running::{HEAT, LIFE, MOD2, Workplace, report, results};
use std::fs;
use std::path::{Path, PathBuf};

/// A run that was killed, with two checkpoints.
struct Killed {
    place: Workplace,
    older: PathBuf,
    latest: PathBuf,
}

/// What is offered instead of the latest checkpoint, with the words that start the program.
fn offer(start: &str) -> String {
    format!(
        "another checkpoint is intact; resume from it with\n  \
         {start} resume here --checkpoint here/checkpoints/step_00000020.checkpoint\n"
    )
}

impl Killed {
    fn new() -> Self {
        let place = Workplace::new();
        place.succeed(HEAT, "--size 10 --steps 22 --until 0 --checkpoint-every 10 --out here");
        let report = place.read("here/run.json").replace("\"outcome\": \"done\"", "\"outcome\": \"running\"");
        place.write("here/run.json", &report);
        let path = |step: u64| place.path(&format!("here/checkpoints/step_{step:08}.checkpoint"));
        Self { older: path(20), latest: path(22), place }
    }

    /// What a command says that must refuse and change nothing.
    fn refuse(&self, program: &str, words: &str) -> String {
        let before = (results(&self.place.path("here")), self.place.read("here/run.json"));
        let output = self.place.invocation(program, words).output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{words}: {said}");
        assert!(
            output.stdout.is_empty() && said.starts_with("error: ") && !said.contains("panicked"),
            "{said}"
        );
        assert!(before == (results(&self.place.path("here")), self.place.read("here/run.json")), "{words}");
        said
    }

    fn resume(&self, words: &str) {
        let output = self.place.invocation(HEAT, &format!("resume here --quiet {words}")).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
}

/// A hint can be pasted: it starts the program as the user did.
#[test]
fn the_offer_names_the_program_as_it_was_started() {
    let run = Killed::new();
    fs::write(&run.latest, "").unwrap();
    let package = env!("CARGO_MANIFEST_DIR");
    let mut command = run.place.invocation(HEAT, "resume here");
    command.env("CARGO", "cargo").env("CARGO_MANIFEST_DIR", package).env("CARGO_PKG_NAME", "xca-examples");
    let said = String::from_utf8(command.output().unwrap().stderr).unwrap();
    let profile = if Path::new(HEAT).parent().unwrap().ends_with("release") { " --release" } else { "" };
    assert!(said.ends_with(&offer(&format!("cargo run{profile} --bin heat --"))), "{said}");
    #[cfg(unix)]
    {
        let mut command = run.place.invocation(HEAT, "resume here");
        std::os::unix::process::CommandExt::arg0(&mut command, "./heat");
        let said = String::from_utf8(command.output().unwrap().stderr).unwrap();
        assert!(said.ends_with(&offer("./heat")), "{said}");
    }
}

/// A run that could be resumed is overwritten only on demand; one that has ended always.
#[test]
fn an_unfinished_run_is_not_overwritten_silently() {
    let run = Killed::new();
    let words = "run --size 10 --steps 3 --until 0 --out here";
    let said = run.refuse(HEAT, words);
    assert_eq!(
        said,
        format!(
            "error: here holds an unfinished run with checkpoints; resume it, overwrite it with --overwrite, \
             or give another directory with --out\nresume it with\n  {HEAT} resume here\n"
        )
    );
    assert!(run.latest.is_file() && run.older.is_file());
    run.place.succeed(HEAT, "--size 10 --steps 3 --until 0 --out here --overwrite");
    assert!(!run.latest.exists() && !run.older.exists());
    run.place.succeed(HEAT, "--size 10 --steps 4 --until 0 --checkpoint-every 2 --out here");
    run.place.succeed(HEAT, "--size 10 --steps 5 --until 0 --out here");
    assert_eq!(report(&run.place.path("here"))["progress"]["steps"], 5);
}

#[test]
fn truncated_or_altered_ones() {
    let run = Killed::new();
    let whole = fs::read(&run.latest).unwrap();
    let wanted = results(&run.place.path("here"));
    let line = whole.iter().position(|byte| *byte == b'\n').unwrap();
    for length in [0, 5, line, line + 1, line + 300, whole.len() / 2, whole.len() - 4, whole.len() - 1] {
        fs::write(&run.latest, &whole[..length]).unwrap();
        let said = run.refuse(HEAT, "resume here");
        let file = "error: here/checkpoints/step_00000022.checkpoint is truncated: ";
        assert!(
            said.starts_with(&format!("{file}{length} bytes of ")) && said.ends_with(&offer(HEAT)),
            "{said}"
        );
    }
    for place in [line + 30, whole.len() - 2000, whole.len() - 1] {
        let mut altered = whole.clone();
        altered[place] ^= 16;
        fs::write(&run.latest, altered).unwrap();
        let said = run.refuse(HEAT, "resume here");
        assert!(
            said.contains("has been altered: its checksum does not match its content\n")
                && said.ends_with(&offer(HEAT)),
            "{said}"
        );
    }
    fs::write(&run.latest, [&whole[..], b"\n"].concat()).unwrap();
    assert!(run.refuse(HEAT, "resume here").contains("has been altered: it has "));
    fs::write(&run.latest, "label,x,y,z\n").unwrap();
    assert!(run.refuse(HEAT, "resume here").contains("is not a checkpoint of an xca program\n"));
    let newer = [b"xca-checkpoint 2 ", &whole[17..]].concat();
    fs::write(&run.latest, newer).unwrap();
    assert!(run.refuse(HEAT, "resume here").contains("has format 2; this program reads format 1\n"));
    // The one that is offered does.
    run.resume("--checkpoint here/checkpoints/step_00000020.checkpoint");
    assert!(results(&run.place.path("here")) == wanted);
    assert!(fs::read(&run.latest).unwrap() == whole);
    // Where there is no other one, none is offered.
    fs::write(&run.latest, "").unwrap();
    fs::remove_file(&run.older).unwrap();
    let said = run.refuse(HEAT, "resume here --checkpoint here/checkpoints/step_00000022.checkpoint");
    assert_eq!(said.lines().count(), 1, "{said}");
}

#[test]
fn those_of_others() {
    let run = Killed::new();
    let said = run.refuse(MOD2, "resume here");
    assert!(said.ends_with("belongs to another run: its program is heat, not mod2\n"), "{said}");
    // Of the same program, with other parameters.
    run.place
        .succeed(HEAT, "--size 10 --steps 22 --until 0 --set alpha=0.1 --checkpoint-every 10 --out there");
    let theirs = "there/checkpoints/step_00000020.checkpoint";
    let said = run.refuse(HEAT, &format!("resume here --checkpoint {theirs}"));
    assert!(
        said.contains("belongs to another run: its command line is ") && said.contains("alpha=0.1"),
        "{said}"
    );
    assert!(said.ends_with(&offer(HEAT).replace("00000020", "00000022")), "{said}");
    // Also where nothing else tells that the run was another one.
    fs::copy(run.place.path("there/run.json"), run.place.path("here/run.json")).unwrap();
    let report = run.place.read("here/run.json").replace("\"done\"", "\"running\"");
    run.place.write("here/run.json", &report);
    let said = run.refuse(HEAT, &format!("resume here --checkpoint {theirs}"));
    assert!(said.contains("bytes have changed"), "{said}");
}

/// The report only adds what the run took until then.
#[test]
fn a_lost_report_is_no_obstacle() {
    for (text, reason) in [
        (None, ""),
        (Some(""), "is not JSON: EOF"),
        (Some("[1]"), "is not the report of a run: "),
        (Some("{\"progress\": 3}"), "is not the report of a run: `progress`: invalid type: integer `3`"),
    ] {
        let run = Killed::new();
        let wanted = results(&run.place.path("here"));
        // One that may be of someone else is not replaced.
        if let Some(text) = text {
            run.place.write("here/run.json", text);
            let said = run.refuse(HEAT, "resume here");
            assert!(said.contains(&format!("here/run.json {reason}")), "{said}");
            assert!(said.ends_with("move it away to resume without it\n"), "{said}");
        }
        fs::remove_file(run.place.path("here/run.json")).unwrap();
        fs::remove_file(run.place.path("here/final.png")).unwrap();
        run.resume("");
        assert!(results(&run.place.path("here")) == wanted, "{text:?}");
        assert_eq!(report(&run.place.path("here"))["resumed"][0]["step"], 22);
    }
}

#[test]
fn none_at_all() {
    let run = Killed::new();
    for (words, wanted) in [
        ("resume", "the following required arguments were not provided:\n  <DIR>"),
        ("resume away", "error: there is no folder away\n"),
        ("resume here --steps 5", "error: 22 steps of the run are done; --steps must be larger"),
        ("resume here --slots 0", "the number of slots must be a whole number, at least 1"),
        ("resume here --seed 5", "unexpected argument '--seed'"),
        ("resume here --threads 0", "the number of threads must be at least 1"),
        (
            "resume here --engine reference --threads 2",
            "--threads is for --engine cpu, not for the reference engine",
        ),
        ("resume here --checkpoint away", "error: cannot read the checkpoint away\ncaused by: "),
        ("run --checkpoint-every soon", "it must be a number of steps, such as 500, or a time"),
        ("run --checkpoint-every 0", "the interval must be at least 1 step"),
    ] {
        let said = run.refuse(HEAT, words);
        assert!(said.contains(wanted), "{words}: {said}");
    }
    run.place.succeed(LIFE, "--steps 3");
    let said = run.place.invocation(LIFE, "resume out/life --checkpoint here/checkpoints").output().unwrap();
    assert_eq!(said.status.code(), Some(2));
    fs::remove_dir_all(run.place.path("here/checkpoints")).unwrap();
    let said = run.refuse(HEAT, "resume here");
    assert_eq!(said, "error: there is no checkpoint in here; `run --checkpoint-every` writes them\n");
}
