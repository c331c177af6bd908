//! What a run leaves behind.

use crate::measured::{BESIDES, Subject, TestResult, alone, container};
use crate::model::{draw, read, run_of, set_up};
use std::fs;
use std::path::{Path, PathBuf};
use xca_checkpoint::Checkpoint;
use xca_core::{Engine, Reference};
use xca_ensemble::{Ensemble, MEMBERS};
use xca_io::table_csv::{SeriesWriter, Written};
use xca_io::vtk::{read_dense, read_particles};
use xca_picture::animation::write_gif;
use xca_record::record::ViewKind;
use xca_record::report::Earlier;
use xca_record::{Failure, SetUp};
use xca_tests_fuzz as fuzz;

/// Words of VTK files.
pub(crate) const VTK: &[&str] = &[
    "UInt8",
    "Int32",
    "UInt32",
    "Float32",
    "Float64",
    "ImageData",
    "PolyData",
    "NumberOfComponents=\"",
    " NumberOfTuples=\"",
    "NumberOfPoints",
    "Extent",
    "Origin",
    "Spacing",
    "TimeValue",
    "vtkGhostType",
    "Points",
    "connectivity",
    "offsets",
    "ComponentName0",
    "<DataArray ",
    "<Piece ",
    "<Array type=\"String\" Name=\"states of ",
    "offset=\"",
];

/// Words of reports and checkpoints.
const JSON: &[&str] = &[
    "null",
    "true",
    "[]",
    "{}",
    "\"\"",
    "cells",
    "items",
    "of",
    "left",
    "lanes",
    "length",
    "scalar",
    "u8",
    "f32",
    "f64",
    "step",
    "steps",
    "run",
    "model",
    "groups",
    "substates",
    "parameters",
    "missing",
    "first",
    "recorded",
    "series",
    "bytes",
    "files",
    "progress",
    "command_line",
    "xca",
    "\"missing\": [{\"first\": 0, \"cells\": 1}],",
];

/// A folder with the files of a run.
pub(crate) struct Folder {
    folder: tempfile::TempDir,
}

impl Folder {
    fn new() -> Result<Self, Failure> {
        Self::of(set_up()?)
    }

    /// The files of a run of this set-up.
    pub(crate) fn of(set_up: SetUp) -> Result<Self, Failure> {
        let folder = tempfile::tempdir()?;
        run_of(set_up, &folder.path().join("out"))?;
        Ok(Self { folder })
    }

    pub(crate) fn path(&self) -> PathBuf {
        self.folder.path().join("out")
    }

    /// The files with this ending, below the folder, the last one by name first.
    pub(crate) fn files(&self, below: &str, ending: &str) -> Vec<PathBuf> {
        let entries = fs::read_dir(self.path().join(below)).into_iter().flatten().flatten();
        let mut paths: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
        paths.retain(|path| path.extension().is_some_and(|extension| extension == ending));
        paths.sort();
        paths.reverse();
        paths
    }

    /// Has frames be all that there is to look into.
    pub(crate) fn without_checkpoints(&self) -> std::io::Result<()> {
        fs::remove_dir_all(self.path().join("checkpoints"))
    }
}

/// Looks into a folder or a checkpoint in each way that there is.
pub(crate) fn inspected(path: &Path) -> Result<(), Failure> {
    read(&["inspect", "--cell", "1,2,0", "--label", "3"], path).ok();
    read(&["inspect", "--json"], path).map(drop)
}

#[test]
fn frames_of_cells() -> TestResult {
    let _alone = alone();
    let folder = Folder::new()?;
    folder.without_checkpoints()?;
    let [path, ..] = &folder.files("frames", "vti")[..] else { return Err("no frame".into()) };
    let bytes = fs::read(path)?;
    let valid = vec![container(fuzz::Vtk::new(&bytes))?];
    Subject { name: "vti", path, valid, besides: BESIDES, cost: 1, words: VTK }.check(|path, _| {
        read_dense(path, u64::MAX)?;
        inspected(&folder.path())
    })
}

#[test]
fn frames_of_items() -> TestResult {
    let _alone = alone();
    let folder = Folder::new()?;
    folder.without_checkpoints()?;
    let [path, ..] = &folder.files("frames", "vtp")[..] else { return Err("no frame".into()) };
    let bytes = fs::read(path)?;
    let valid = vec![container(fuzz::Vtk::new(&bytes))?];
    Subject { name: "vtp", path, valid, besides: BESIDES, cost: 1, words: VTK }.check(|path, _| {
        read_particles(path, u64::MAX)?;
        inspected(&folder.path())
    })
}

/// The memory of a picture while it is drawn, in bytes.
pub(crate) const DRAWING: usize = 64 << 20;

fn check_drawing(name: &str, ending: &str, views: &[ViewKind]) -> TestResult {
    let _alone = alone();
    let folder = Folder::new()?;
    let [path, ..] = &folder.files("frames", ending)[..] else { return Err("no frame".into()) };
    draw(path, views)?;
    let valid = vec![container(fuzz::Vtk::new(&fs::read(path)?))?];
    Subject { name, path, valid, besides: DRAWING, cost: 20, words: VTK }.check(|path, _| draw(path, views))
}

#[test]
fn drawings_of_cells() -> TestResult {
    check_drawing("drawn-cells", "vti", &[ViewKind::Slice, ViewKind::Isometric])
}

#[test]
fn drawings_of_items() -> TestResult {
    check_drawing("drawn-items", "vtp", &[ViewKind::Spheres])
}

#[test]
fn checkpoints() -> TestResult {
    let _alone = alone();
    let folder = Folder::new()?;
    let [path, ..] = &folder.files("checkpoints", "checkpoint")[..] else {
        return Err("no checkpoint".into());
    };
    let bytes = fs::read(path)?;
    let valid = vec![container(fuzz::Checkpoint::new(&bytes))?];
    Subject { name: "checkpoint", path, valid, besides: BESIDES, cost: 1, words: JSON }.check(|path, _| {
        Checkpoint::read(path)?.description.mask();
        inspected(path)
    })
}

#[test]
fn reports() -> TestResult {
    let _alone = alone();
    let folder = Folder::new()?;
    let path = &folder.path().join("run.json");
    let valid = vec![container(Some(fs::read(path)?))?];
    Subject { name: "report", path, valid, besides: BESIDES, cost: 1, words: JSON }.check(|path, _| {
        Earlier::read(path)?;
        inspected(&folder.path())
    })
}

#[test]
fn time_series() -> TestResult {
    let _alone = alone();
    let folder = Folder::new()?;
    let path = &folder.path().join("observables.csv");
    let whole = fs::read(path)?;
    let written = Written { bytes: whole.len() as u64, crc32: crc32fast::hash(&whole) };
    let valid = vec![container(Some(whole))?];
    Subject { name: "series", path, valid, besides: BESIDES, cost: 1, words: &["step", "time", ","] }.check(
        |path, mutator| {
            let bytes = if mutator.below(2) == 0 { mutator.edge() } else { written.bytes };
            // What a checkpoint may say of any file.
            let found = fs::read(path)?;
            let crc32 = found.get(..bytes as usize).map_or(written.crc32, crc32fast::hash);
            SeriesWriter::resume(path, 7, Written { bytes, crc32 })?.append(5, 0.5, &[1.0; 7])?;
            Ok(())
        },
    )
}

/// A picture of 8 x 6 pixels.
fn picture() -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 8, 6);
    encoder.set_color(png::ColorType::Rgb);
    let rgb: Vec<u8> = (0..8 * 6 * 3).map(|place| (place * 37 % 256) as u8).collect();
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&rgb)?;
    writer.finish()?;
    Ok(bytes)
}

#[test]
fn pictures() -> TestResult {
    let _alone = alone();
    let folder = tempfile::tempdir()?;
    let path = &folder.path().join("picture.png");
    let valid = vec![container(fuzz::Png::new(&picture()?))?];
    let out = folder.path().join("film.gif");
    let subject = Subject {
        name: "png",
        path,
        valid,
        besides: BESIDES,
        cost: 1,
        words: &["IHDR", "IDAT", "IEND", "tEXt", "sRGB"],
    };
    subject.check(|path, _| Ok(write_gif(&out, &[path.to_owned(), path.to_owned()], 10)?))
}

fn engine() -> Result<Box<dyn Engine>, Failure> {
    Ok(Box::new(Reference))
}

fn sweep(folder: &Path) -> Result<(), Failure> {
    let ensemble = Ensemble::new().sweep("conductivity", [0.1, 0.2]).seeds(5, 2).jobs(1);
    ensemble.run(folder, &engine, &mut |_| set_up(), &mut ())?;
    Ok(())
}

#[test]
fn tables_of_sweeps() -> TestResult {
    let _alone = alone();
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("sweep");
    sweep(&out)?;
    let path = &out.join(MEMBERS);
    let valid = vec![container(Some(fs::read(path)?))?];
    let words = &["member", "seed", "end", "reason", "steps", "done", "stopped", "failed", ",", "\"", "nan"];
    Subject { name: "members", path, valid, besides: BESIDES, cost: 1, words }.check(|_, _| sweep(&out))
}

#[test]
fn reports_of_sweeps() -> TestResult {
    let _alone = alone();
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("sweep");
    sweep(&out)?;
    let path = &out.join("sweep.json");
    let valid = vec![container(Some(fs::read(path)?))?];
    Subject { name: "sweep", path, valid, besides: BESIDES, cost: 1, words: JSON }.check(|_, _| sweep(&out))
}
