//! Honest files whose values are as large as memory allows: they are held once.

use crate::ALLOCATED;
use crate::measured::{TestResult, alone};
use crate::model::{read, run};
use std::fs;
use std::path::Path;
use xca_checkpoint::{Checkpoint, CheckpointFolder, Kind};
use xca_core::GroupSnapshot;
use xca_io::vtk::{DataArray, Grid, write_dense};

/// The side of a square of cells, of a byte each: 64 MiB.
const SIDE: usize = 8192;

/// What `inspect` says of a path, and the memory that it takes for it, in bytes.
fn inspected(path: &Path) -> Result<(String, usize), xca_record::Failure> {
    ALLOCATED.reset_peak_usage();
    let before = ALLOCATED.current_usage();
    let text = read(&["inspect", "--cell", "5,0,0"], path)?;
    Ok((text, ALLOCATED.peak_usage() - before))
}

#[test]
fn values_of_frames_are_held_once() -> TestResult {
    let _alone = alone();
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("out");
    run(&out)?;
    fs::remove_dir_all(out.join("checkpoints"))?;
    let path = out.join("frames/square_00000099.vti");
    let mut values = vec![7_u8; SIDE * SIDE];
    values[5] = 8;
    write_dense(&path, 9.0, &Grid::cubic([SIDE, SIDE, 1], 1.0), &[DataArray::new("plate", &values[..])])?;
    drop(values);
    let length = fs::metadata(&path)?.len();
    assert!(length < 1 << 20, "{length}");
    let (text, memory) = inspected(&out)?;
    assert!(text.contains("67108864") && text.contains("plate = 8.0"), "{text}");
    assert!(memory < SIDE * SIDE + (16 << 20), "{memory}");
    Ok(())
}

#[test]
fn values_of_checkpoints_are_held_once() -> TestResult {
    let _alone = alone();
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("out");
    run(&out)?;
    let path = CheckpointFolder::of_run(&out).pop().ok_or("no checkpoint")?;
    // The same run with one substate in more cells.
    let mut checkpoint = Checkpoint::read(&path)?;
    checkpoint.description.run.model["cells"] = vec![SIDE, SIDE, 1].into();
    let groups = &mut checkpoint.description.groups;
    groups.truncate(1);
    groups[0].kind = Kind::Cells { cells: SIDE * SIDE };
    groups[0].substates.retain(|substate| substate.name == "phase");
    checkpoint.snapshot.groups = vec![GroupSnapshot::Cells(vec![vec![1; SIDE * SIDE]])];
    checkpoint.write(&path)?;
    drop(checkpoint);
    let (text, memory) = inspected(&path)?;
    assert!(text.contains("67108864") && text.contains("phase = Liquid"), "{text}");
    assert!(memory < SIDE * SIDE + (16 << 20), "{memory}");
    Ok(())
}
