//! Folders of others: no command replaces or removes what is not its own.

use crate::running::{HEAT, LIFE, Workplace, results};
use std::fs;

/// A quick run with checkpoints.
const RUN: &str = "--size 6 --until 0 --steps 10 --every 5 --checkpoint-every 5";

impl Workplace {
    /// What a command says that must be refused.
    fn refuse(&self, program: &str, words: &str) -> String {
        let output = self.invocation(program, words).output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{words}: {said}");
        said
    }

    /// Runs a command that must succeed.
    fn obey(&self, program: &str, words: &str) {
        let output = self.invocation(program, words).output().unwrap();
        assert!(output.status.success(), "{words}: {}", String::from_utf8_lossy(&output.stderr));
    }
}

#[test]
fn no_command_takes_the_folder_of_another_kind() {
    let place = Workplace::new();
    place.succeed(HEAT, &format!("{RUN} --out run"));
    place.obey(HEAT, "render run --pixels 400x300 --animation none --out pictures");
    let compare = "compare --size 6 --until 0 --steps 2 --repeats 1 --engines reference,cpu:1";
    place.obey(HEAT, &format!("{compare} --out compared"));
    let folders = ["run", "pictures"];
    let before = folders.map(|folder| results(&place.path(folder)));
    let compared = place.read("compared/observables.csv");
    for (words, wanted) in [
        (format!("{compare} --out run"), "run holds a run, which this would overwrite"),
        (format!("{compare} --out pictures"), "pictures holds a rendering, which this would overwrite"),
        ("render run --out compared".to_owned(), "compared holds a comparison, which this would overwrite"),
        (format!("run {RUN} --out pictures"), "pictures holds a rendering, which this would overwrite"),
        (format!("run {RUN} --out compared"), "compared holds a comparison, which this would overwrite"),
        (
            "resume pictures --checkpoint run/checkpoints/step_00000005.checkpoint".to_owned(),
            "belongs to another run: its command line is",
        ),
    ] {
        let said = place.refuse(HEAT, &words);
        assert!(said.contains(wanted), "{words}: {said}");
    }
    assert!(before == folders.map(|folder| results(&place.path(folder))));
    assert_eq!(place.read("compared/observables.csv"), compared);
    // Each goes on with its own.
    place.succeed(HEAT, &format!("{RUN} --out run"));
    place.obey(HEAT, "render run --pixels 400x300 --animation none --out pictures");
    place.obey(HEAT, &format!("{compare} --out compared"));
}

#[test]
fn a_comparison_does_not_replace_files_of_others() {
    let place = Workplace::new();
    fs::create_dir(place.path("data")).unwrap();
    place.write("data/engines.csv", "mine");
    let said = place.refuse(LIFE, "compare --steps 2 --repeats 1 --out data");
    assert!(said.contains("data holds `engines.csv`, which is not from an earlier comparison"), "{said}");
    assert_eq!(place.read("data/engines.csv"), "mine");
    assert_eq!(fs::read_dir(place.path("data")).unwrap().count(), 1);
}

#[test]
fn a_picture_of_a_checkpoint_may_stand_beside_the_run() {
    let place = Workplace::new();
    place.succeed(HEAT, &format!("{RUN} --out run"));
    let before = results(&place.path("run"));
    let render = "render run/checkpoints/step_00000005.checkpoint --pixels 400x300 --out run";
    for _ in 0..2 {
        place.obey(HEAT, render);
    }
    fs::remove_file(place.path("run/step_00000005.png")).unwrap();
    assert!(before == results(&place.path("run")));
    place.write("run/step_00000005.png", "a photograph");
    let said = place.refuse(HEAT, render);
    assert!(said.contains("run holds `step_00000005.png`, which is not from an earlier rendering"), "{said}");
    assert_eq!(place.read("run/step_00000005.png"), "a photograph");
}

#[cfg(unix)]
#[test]
fn a_run_removes_only_what_runs_make() {
    let place = Workplace::new();
    place.succeed(HEAT, &format!("{RUN} --out run"));
    fs::create_dir(place.path("away")).unwrap();
    let precious = ["away/precious.txt", "away/p_1.vti", "run/thesis.pdf", "run/7", "run/data.csv"];
    for name in precious {
        place.write(name, "mine");
    }
    std::os::unix::fs::symlink(place.path("away"), place.path("run/sub")).unwrap();
    let names = ["sub/precious.txt", "sub/p_*.vti", "../away/precious.txt", "thesis.pdf", "*", "data.csv"];
    let path = place.path("run/run.json");
    let mut report: serde_json::Value = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
    report["files"].as_array_mut().unwrap().extend(names.map(Into::into));
    fs::write(&path, report.to_string()).unwrap();
    place.succeed(HEAT, &format!("{RUN} --out run"));
    for name in precious {
        assert_eq!(place.read(name), "mine", "{name}");
    }
}

#[test]
fn reports_of_another_shape_are_refused_with_the_key() {
    let place = Workplace::new();
    place.succeed(HEAT, &format!("{RUN} --out run"));
    let whole = place.read("run/run.json");
    let mut report: serde_json::Value = serde_json::from_str(&whole).unwrap();
    report["progress"] = 5.into();
    place.write("run/run.json", &report.to_string());
    for words in ["render run", "inspect run", "resume run", &format!("run {RUN} --out run")] {
        let said = place.refuse(HEAT, words);
        let wanted = "run/run.json is not the report of a run: `progress`: invalid type: integer `5`";
        assert!(said.contains(wanted), "{words}: {said}");
    }
    place.write("run/run.json", &whole);
    place.obey(HEAT, "inspect run");
}
