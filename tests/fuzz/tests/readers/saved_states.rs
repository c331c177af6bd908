//! States of a run in the formats that are read as the model stores them: frames of hexagons, rasters,
//! extended XYZ.

use crate::measured::{BESIDES, Subject, TestResult, alone, container};
use crate::model::{set_up, set_up_on};
use crate::run_files::{DRAWING, Folder, VTK, inspected};
use std::fs;
use xca_core::prelude::*;
use xca_io::vtk::read_collection;
use xca_record::record::{Drawing, Look, Recorder, SavedRun, ViewKind};
use xca_record::{Failure, SetUp};
use xca_tests_fuzz::{self as fuzz, Container};

const STEP: u64 = 4;

fn hexagons() -> Result<SetUp, Failure> {
    set_up_on(Neighbourhood::hexagonal(Hexagons::CornerUp))
}

/// The model, whose states are saved in this format alone.
fn saved_as(format: &str) -> Result<SetUp, Failure> {
    let mut set_up = set_up()?;
    set_up.formats.choose(&[format])?;
    Ok(set_up)
}

/// Draws the last state of a run.
fn draw(drawing: &Drawing<'_>, run: &SavedRun) -> TestResult {
    let seen = drawing.seen_in(run, STEP)?;
    let mut scales = drawing.fixed_scales();
    drawing.widen(&mut scales, &seen);
    drawing.picture(STEP, &seen, &scales)?;
    Ok(())
}

/// A VTK file in its parts, another as it is.
fn parts(bytes: Vec<u8>) -> Result<Box<dyn Container>, String> {
    match fuzz::Vtk::new(&bytes) {
        Some(parts) => container(Some(parts)),
        None => container(Some(bytes)),
    }
}

/// A run of a set-up, whose states are looked at in one way.
struct Saved {
    set_up: fn() -> Result<SetUp, Failure>,
    view: ViewKind,
    /// The file that is damaged, below the folder of the run.
    file: &'static str,
    words: &'static [&'static str],
}

impl Saved {
    /// Has the last state of the run read as `render` reads it, and one in 20 drawn.
    fn check(&self, name: &str) -> TestResult {
        let _alone = alone();
        let folder = Folder::of((self.set_up)()?)?;
        let recorder = Recorder::new((self.set_up)()?)?;
        let look = Look { view: Some(self.view), ..Look::default() };
        let drawing = recorder.drawing(&[look], Some([400, 300]))?;
        let run = SavedRun { folder: folder.path(), precision: Precision::F64, last_step: STEP };
        draw(&drawing, &run)?;
        let path = &folder.path().join(self.file);
        let bytes = fs::read(path)?;
        let valid = parts(bytes)?;
        let subject =
            Subject { name, path, valid: vec![valid], besides: DRAWING, cost: 1, words: self.words };
        subject.check(|_, mutator| match mutator.below(20) {
            0 => draw(&drawing, &run),
            _ => Ok(drawing.seen_in(&run, STEP).map(drop)?),
        })
    }
}

const GRID: &[&str] = &["ncols", "nrows", "xllcorner", "yllcenter", "cellsize", "NODATA_value", "\n", "1 "];
const TIFF: &[&str] = &["-9999", "nan", "II*\0", "MM\0*"];
const XYZ: &[&str] =
    &["Lattice=", "Properties=", "pos:R:3", "id:I:1", "wet:L:1", "Time=", "\"", "T", "F", "nan", "\n"];

#[test]
fn rasters_of_a_run() -> TestResult {
    for (name, set_up, file, words) in [
        ("saved-asc", (|| saved_as("asc")) as fn() -> Result<SetUp, Failure>, "final_temperature.asc", GRID),
        ("saved-asc-states", || saved_as("asc"), "final_phase.asc", GRID),
        ("saved-tif", || saved_as("tif"), "final_temperature.tif", TIFF),
    ] {
        Saved { set_up, view: ViewKind::Slice, file, words }.check(name)?;
    }
    Ok(())
}

#[test]
fn extended_xyz_of_a_run() -> TestResult {
    let set_up = || saved_as("xyz");
    Saved { set_up, view: ViewKind::Spheres, file: "frames/grain_00000004.xyz", words: XYZ }
        .check("saved-xyz")
}

#[test]
fn hexagons_of_a_run() -> TestResult {
    let file = "frames/plate_00000004.vtp";
    Saved { set_up: hexagons, view: ViewKind::Slice, file, words: VTK }.check("saved-hexagons")
}

/// What `inspect` reads without knowing the model.
fn check_inspected(name: &str, set_up: SetUp, file: &str, words: &'static [&'static str]) -> TestResult {
    let _alone = alone();
    let folder = Folder::of(set_up)?;
    folder.without_checkpoints()?;
    let path = &folder.path().join(file);
    let bytes = fs::read(path)?;
    let valid = parts(bytes)?;
    Subject { name, path, valid: vec![valid], besides: BESIDES, cost: 1, words }
        .check(|_, _| inspected(&folder.path()))
}

#[test]
fn hexagons_looked_into() -> TestResult {
    let path = "frames/plate_00000004.vtp";
    check_inspected("hexagons", hexagons()?, path, VTK)
}

#[test]
fn extended_xyz_looked_into() -> TestResult {
    check_inspected("inspected-xyz", saved_as("xyz")?, "frames/grain_00000004.xyz", XYZ)
}

#[test]
fn collections() -> TestResult {
    let _alone = alone();
    let folder = Folder::of(set_up()?)?;
    let path = &folder.path().join("plate.pvd");
    let valid = vec![container(Some(fs::read(path)?))?];
    let words =
        &["timestep=", "file=", "<DataSet ", "/>", "../", "/", "&quot;", "</Collection>", "inf", "\"", "\n"];
    Subject { name: "pvd", path, valid, besides: BESIDES, cost: 1, words }
        .check(|path, _| Ok(read_collection(path).map(drop)?))
}
