//! Folders that commands get, and those that they do not.

use super::*;
use crate::view::CellView;
use crate::{Run, SetUp};
use xca_core::prelude::*;
use xca_picture::{Domain, ParticlePicture};

fn files() -> Vec<String> {
    ["final.csv", "frames/p_*.vtp"].map(str::to_owned).to_vec()
}

fn write(folder: &Path, names: &[&str]) {
    for name in names {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, "old").unwrap();
    }
}

fn report(folder: &Path, command: &str, files: &str) {
    let text = format!(r#"{{"xca": "0.1.0", "command_line": ["heat", "{command}"], "files": [{files}]}}"#);
    fs::write(folder.join(REPORT), text).unwrap();
}

fn prepare(folder: &Path, files: &[String], inputs: &[InputFile]) -> Result<RunFolder, FolderError> {
    RunFolder::prepare(folder, &Claim { kind: Kind::Run, files, inputs, program: None, overwrite: false })
}

fn refused(folder: &Path, claim: &Claim<'_>) -> String {
    LockedFolder::prepare(folder, claim).unwrap_err().to_string()
}

#[test]
fn what_an_earlier_run_left_is_removed_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let kept = [
        "notes.txt",
        "frames/p_old.vtp",
        "frames/q_00000001.vtp",
        "frames/p_1.vti",
        "away.csv",
        "7",
        "sub/p_1.vtp",
    ];
    write(path, &kept);
    write(path, &["final.csv", "observables.csv", "frames/p_00000000.vtp", "frames/p_123456789.vtp"]);
    let listed = r#""final.csv", "observables.csv", "frames/p_*.vtp", "../away.csv", "away.csv", "/etc/x", "", "*", "sub/p_*.vtp""#;
    report(path, "run", listed);
    prepare(path, &files(), &[]).unwrap();
    for name in kept {
        assert!(path.join(name).is_file(), "{name}");
    }
    for name in ["final.csv", "observables.csv", "frames/p_00000000.vtp", "frames/p_123456789.vtp", REPORT] {
        assert!(!path.join(name).exists(), "{name}");
    }
}

#[cfg(unix)]
#[test]
fn nothing_is_removed_below_or_through_a_link() {
    use std::os::unix::fs::symlink;
    let folder = tempfile::tempdir().unwrap();
    let (path, away) = (folder.path().join("run"), folder.path().join("away"));
    write(&away, &["p_00000001.vtp", "final.csv", ".p.vtp.1-1.part"]);
    fs::create_dir(&path).unwrap();
    symlink(&away, path.join(FRAMES)).unwrap();
    symlink(away.join("final.csv"), path.join("final.csv")).unwrap();
    report(&path, "run", r#""final.csv", "frames/p_*.vtp""#);
    // Of a run that makes none of these: nothing is in its way.
    prepare(&path, &[], &[]).unwrap();
    for name in ["p_00000001.vtp", "final.csv", ".p.vtp.1-1.part"] {
        assert!(away.join(name).is_file(), "{name}");
    }
    assert!(fs::symlink_metadata(path.join("final.csv")).unwrap().is_symlink());
    for (wanted, names) in [("final.csv", &files()[..1]), ("frames/p_00000001.vtp", &files()[1..])] {
        let error = prepare(&path, names, &[]).unwrap_err().to_string();
        assert!(error.contains(&format!("holds `{wanted}`, which is not from an earlier run")), "{error}");
    }
}

#[test]
fn files_of_someone_else_are_not_replaced() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), &["final.csv"]);
    let error = prepare(folder.path(), &files(), &[]).unwrap_err().to_string();
    assert!(error.contains("holds `final.csv`, which is not from an earlier run"), "{error}");
    assert!(folder.path().join("final.csv").is_file());
    // Nor such that no earlier run has listed.
    report(folder.path(), "run", r#""observables.csv""#);
    assert!(prepare(folder.path(), &files(), &[]).is_err());
    assert!(folder.path().join("final.csv").is_file());
    // Another program's run.json.
    fs::write(folder.path().join(REPORT), "{}").unwrap();
    assert!(prepare(folder.path(), &[], &[]).is_err());
    assert!(RunFolder::open(folder.path()).is_err());
}

#[test]
fn each_kind_of_command_keeps_to_its_folders() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let kinds = [Kind::Run, Kind::Pictures, Kind::Comparison];
    for (owner, command) in kinds.into_iter().zip(["run", "render", "compare"]) {
        report(path, command, "");
        if owner == Kind::Comparison {
            fs::rename(path.join(REPORT), path.join(owner.report())).unwrap();
        }
        for kind in kinds {
            let claim = Claim { kind, files: &[], inputs: &[], program: None, overwrite: false };
            if kind == owner {
                LockedFolder::prepare(path, &claim).unwrap();
            } else {
                let said = refused(path, &claim);
                assert!(
                    said.contains(&format!("holds a {}, which this would overwrite", owner.noun())),
                    "{said}"
                );
            }
        }
        assert_eq!(RunFolder::open(path).is_ok(), owner == Kind::Run);
        fs::remove_file(path.join(owner.report())).unwrap();
    }
}

#[test]
fn a_run_of_another_program_is_not_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let text =
        r#"{"xca": "0.1.0", "program": "slide", "command_line": ["slide", "run"], "files": ["final.csv"]}"#;
    fs::write(path.join(REPORT), text).unwrap();
    write(path, &["final.csv"]);
    let claim = |program| Claim {
        kind: Kind::Run,
        files: &[],
        inputs: &[],
        program: Some(program),
        overwrite: false,
    };
    assert!(refused(path, &claim("life")).contains("holds a run of `slide`, which this would overwrite"));
    assert!(path.join("final.csv").exists());
    RunFolder::prepare(path, &claim("slide")).unwrap();
    assert!(!path.join("final.csv").exists());
}

/// Only a run that can be resumed, unless the command says so.
#[test]
fn an_unfinished_run_with_checkpoints_is_not_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let claim =
        |overwrite| Claim { kind: Kind::Run, files: &[], inputs: &[], program: Some("life"), overwrite };
    let checkpoint = path.join("checkpoints/step_00000007.checkpoint");
    let left = |outcome: &str, names: &[&str]| {
        let listed = r#""final.csv", "checkpoints/step_*.checkpoint""#;
        let progress = format!(r#"{{"outcome": "{outcome}"}}"#);
        let text = format!(
            r#"{{"xca": "0.1.0", "program": "life", "command_line": ["life", "run"], "progress": {progress}, "files": [{listed}]}}"#
        );
        write(path, names);
        fs::write(path.join(REPORT), text).unwrap();
    };
    let all = ["final.csv", "checkpoints/step_00000007.checkpoint"];
    for outcome in ["running", "interrupted", "failed"] {
        left(outcome, &all);
        let said = refused(path, &claim(false));
        assert!(
            said.ends_with(
                "holds an unfinished run with checkpoints; resume it, overwrite it with --overwrite, or give \
                 another directory with --out"
            ),
            "{said}"
        );
        assert!(checkpoint.is_file());
        RunFolder::prepare(path, &claim(true)).unwrap();
        assert!(!checkpoint.exists() && !path.join("final.csv").exists());
    }
    for (outcome, names) in [("done", &all[..]), ("stopped", &all), ("interrupted", &all[..1])] {
        left(outcome, names);
        RunFolder::prepare(path, &claim(false)).unwrap();
        assert!(!checkpoint.exists() && !path.join("final.csv").exists());
    }
}

#[test]
fn a_folder_is_one_command_s_at_a_time() {
    let folder = tempfile::tempdir().unwrap();
    let held = prepare(folder.path(), &files(), &[]).unwrap();
    for kind in [Kind::Run, Kind::Pictures, Kind::Comparison] {
        let said =
            refused(folder.path(), &Claim { kind, files: &[], inputs: &[], program: None, overwrite: false });
        assert!(said.contains("another run is writing to"), "{said}");
    }
    assert!(matches!(LockedFolder::beside(folder.path(), "a.png"), Err(FolderError::InUse { .. })));
    drop(held);
    LockedFolder::beside(folder.path(), "a.png").unwrap();
}

#[test]
fn a_picture_beside_a_run_replaces_pictures_alone() {
    let folder = tempfile::tempdir().unwrap();
    report(folder.path(), "run", r#""initial.png""#);
    let beside = |name: &str| LockedFolder::beside(folder.path(), name);
    let path = folder.path().join("step_00000001.png");
    beside("step_00000001.png").unwrap();
    fs::write(&path, "a photograph").unwrap();
    let said = beside("step_00000001.png").unwrap_err().to_string();
    assert!(said.contains("holds `step_00000001.png`, which is not from an earlier rendering"), "{said}");
    let domain = Domain { lower: [0.0; 3], upper: [1.0; 3] };
    let picture = ParticlePicture::new(&[[0.5; 3]], 0.1, domain).render().unwrap();
    picture.write(&path).unwrap();
    beside("step_00000001.png").unwrap();
    // One of the run's own.
    picture.write(&folder.path().join("initial.png")).unwrap();
    assert!(beside("initial.png").is_err());
}

#[test]
fn a_run_does_not_replace_its_own_input() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), &["final.csv"]);
    report(folder.path(), "run", r#""final.csv""#);
    let input = folder.path().join("frames/../final.csv");
    fs::create_dir(folder.path().join(FRAMES)).unwrap();
    let error = prepare(folder.path(), &files(), &[InputFile::new(input)]).unwrap_err().to_string();
    assert!(error.contains("final.csv, which it would overwrite"), "{error}");
    assert!(folder.path().join("final.csv").is_file());
}

#[test]
fn a_report_of_another_shape_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join(REPORT), r#"{"xca": "0.1.0", "progress": 5}"#).unwrap();
    for error in [prepare(folder.path(), &[], &[]).unwrap_err(), RunFolder::open(folder.path()).unwrap_err()]
    {
        assert!(error.to_string().contains("`progress`: invalid type: integer `5`"), "{error}");
    }
}

#[derive(Substates, Clone)]
struct Field {
    heat: Real,
}

#[elementary_process]
fn rest(cell: &mut Cell<Field>) {
    cell.heat += 0.0;
}

/// Whatever a view is called, frames of an earlier run do not stay among those of a later one.
#[test]
fn frames_of_an_earlier_run_are_removed_under_any_name() {
    for (name, stem) in
        [("lava flow", "lava_flow"), ("a/b", "a_b"), ("flux (m²)", "flux__m__"), ("..", "_"), ("x*", "x_")]
    {
        let folder = tempfile::tempdir().unwrap();
        let run = |steps: u64, every: u64| {
            let model = Model::builder("field").extents([3, 2, 1]).substates::<Field>();
            let model = model.process(rest).fill(|_| Field { heat: 1.0 }).build().unwrap();
            let set_up = SetUp::new(model, steps).cells(CellView::<Field>::named(name));
            let mut recording =
                Run::new(set_up).unwrap().every(every).begin(folder.path(), &Reference).unwrap();
            recording.go(&mut ()).unwrap();
            drop(recording);
            let entries = fs::read_dir(folder.path().join(FRAMES)).unwrap();
            let mut names: Vec<String> =
                entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
            names.sort();
            names
        };
        assert_eq!(run(100, 10).len(), 11, "{name}");
        let wanted = [0, 20, 40].map(|step| format!("{stem}_{step:08}.vti"));
        assert_eq!(run(40, 20), wanted, "{name}");
    }
}
