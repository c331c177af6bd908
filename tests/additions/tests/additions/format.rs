//! A format from elsewhere.

use super::{TestResult, plate, report, succeed};
use std::fs;
use std::path::Path;

fn log(run: &Path) -> std::io::Result<String> {
    fs::read_to_string(run.join("states.log"))
}

#[test]
fn its_files_are_told_guarded_resumed_and_replaced() -> TestResult {
    let folder = tempfile::tempdir()?;
    let (folder, run) = (folder.path(), folder.path().join("run"));
    succeed(folder, "run --out run --every 10 --checkpoint-every 20 --quiet")?;
    let listed = report(&run.join("run.json"))?["files"].clone();
    let listed: Vec<&str> =
        listed.as_array().into_iter().flatten().filter_map(|file| file.as_str()).collect();
    assert!(listed.contains(&"frames/plate_*.json") && listed.contains(&"states.log"), "{listed:?}");
    let (whole, last) = (log(&run)?, fs::read(run.join("frames/plate_00000040.json"))?);
    assert_eq!(whole.lines().count(), 5);
    // What a run has written after its checkpoint is taken back, and comes again.
    succeed(folder, "resume run --checkpoint run/checkpoints/step_00000020.checkpoint --quiet")?;
    assert_eq!((log(&run)?, fs::read(run.join("frames/plate_00000040.json"))?), (whole, last));
    // A shorter run leaves nothing of the longer one.
    succeed(folder, "run --out run --every 10 --steps 20 --quiet")?;
    assert_eq!(log(&run)?.lines().count(), 3);
    assert!(!run.join("frames/plate_00000030.json").exists());
    // A file of someone else is not replaced.
    fs::create_dir(folder.join("mine"))?;
    fs::write(folder.join("mine/states.log"), "precious")?;
    let output = plate(folder, "run --out mine --quiet")?;
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(fs::read_to_string(folder.join("mine/states.log"))?, "precious");
    Ok(())
}

#[test]
fn its_states_are_drawn_like_those_of_any_other() -> TestResult {
    let folder = tempfile::tempdir()?;
    let folder = folder.path();
    succeed(folder, "run --out json --formats json --every 10 --quiet")?;
    assert!(!folder.join("json/plate.pvd").exists() && !folder.join("json/final.png").exists());
    succeed(folder, "run --out vtk --formats vtk --every 10 --quiet")?;
    for run in ["json", "vtk"] {
        succeed(folder, &format!("render {run} --out {run}_pictures --quiet"))?;
    }
    let picture = |run: &str| fs::read(folder.join(run).join("frames/frame_00000030.png"));
    assert_eq!(picture("json_pictures")?, picture("vtk_pictures")?);
    // What a program has added, its `inspect` reads too.
    let [of_json, of_vtk] = [succeed(folder, "inspect json")?, succeed(folder, "inspect vtk")?];
    let statistics =
        |text: &str| text.lines().find(|line| line.trim_start().starts_with("plate.")).map(str::to_owned);
    assert!(
        statistics(&of_json).is_some() && statistics(&of_json) == statistics(&of_vtk),
        "{of_json}{of_vtk}"
    );
    let list = succeed(folder, "list")?;
    assert!(list.contains("json        yes       all states of cells as JSON"), "{list}");
    let output = plate(folder, "run --formats jsn --quiet")?;
    let said = String::from_utf8(output.stderr)?;
    assert!(
        said.contains("unknown format `jsn`; there are vtk, csv, png, asc, tif, xyz, spacetime, json"),
        "{said}"
    );
    Ok(())
}
