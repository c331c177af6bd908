//! What a run begins with.

use crate::measured::{BESIDES, Subject, TestResult, alone, container};
use crate::model::{Grain, read};
use std::path::Path;
use xca_io::extended_xyz;
use xca_io::geotiff::{self, SampleType};
use xca_io::map::Placement;
use xca_io::particle_csv::{self, ColumnType};
use xca_io::raster::Raster;
use xca_record::read_items;

const TYPES: [(&str, ColumnType<'static>); 4] = [
    ("x", ColumnType::Number),
    ("age", ColumnType::Whole { least: 0, largest: 4_294_967_295 }),
    ("wet", ColumnType::Bool),
    ("phase", ColumnType::State { name: "Phase", states: &["Solid", "Liquid"] }),
];

/// A file in a folder of its own, and what a reader does with it.
fn check_text(
    name: &str,
    texts: &[&str],
    words: &'static [&'static str],
    read: impl Fn(&Path) -> TestResult,
) -> TestResult {
    let _alone = alone();
    let folder = tempfile::tempdir()?;
    let path = &folder.path().join("file");
    let valid =
        texts.iter().map(|text| container(Some(text.as_bytes().to_vec()))).collect::<Result<_, _>>()?;
    Subject { name, path, valid, besides: BESIDES, cost: 1, words }.check(|path, _| read(path))
}

#[test]
fn tables_of_items() -> TestResult {
    let text = "label,x,y,z,wet,age\n7,0.5,1.25e-3,-2,true,3\n# more\n\n2,1,2,3,false,0\n";
    let words = &["label", "x", "y", "wet", "age", "true", "false", ",", "#", "\"", "\n"];
    check_text("items", &[text], words, |path| Ok(read_items::<Grain>(path).map(drop)?))
}

#[test]
fn tables_of_particles() -> TestResult {
    let text = "\u{feff}# of a run\nlabel, x, age, wet, phase\n7, 0.5, 3, true, Solid\n2, 1e-300, 4, false, Liquid\n";
    let words = &["label", "x", "age", "wet", "phase", "Solid", "Liquid", "true", ",", "#", "\"", "\n"];
    check_text("particles", &[text], words, |path| Ok(particle_csv::read(path, &TYPES).map(drop)?))
}

#[test]
fn grids() -> TestResult {
    let whole = "ncols 3\nnrows 2\nxllcorner 100.5\nyllcorner -7\ncellsize 10\nNODATA_value -9999\n1 2 3\n-9999 5 6e2\n";
    let other = "NCOLS 2 NROWS 2 xllcenter 5 yllcenter 5 dx 10 dy 10\n1 2 3 4\n";
    let bare = "1 2 3\n4 5 6\n";
    let words =
        &["ncols", "nrows", "xllcorner", "yllcenter", "cellsize", "dx", "dy", "NODATA_value", "\n", "1 "];
    check_text("grid", &[whole, other, bare], words, |path| {
        Raster::read_heights(path).ok();
        let placement = Placement { extents: [3, 2], corner: [0.0; 2], side: 1.0 };
        Ok(Raster::read_on(path, placement).map(drop)?)
    })
}

/// As they are written, and as they are packed by others: in tiles, compressed, as integers.
#[test]
fn geotiffs() -> TestResult {
    let _alone = alone();
    let folder = tempfile::tempdir()?;
    let path = &folder.path().join("file.tif");
    let mut valid = Vec::new();
    for (extents, samples) in [([3, 2], SampleType::F64), ([40, 30], SampleType::F32)] {
        let values =
            (0..extents[0] * extents[1]).map(|cell| if cell % 5 == 0 { f64::NAN } else { cell as f64 });
        let raster =
            Raster::new(extents, 10.0, values.collect()).ok_or("no raster")?.with_corner([100.5, -7.0]);
        geotiff::write(path, &raster, samples)?;
        valid.push(container(Some(std::fs::read(path)?))?);
    }
    Subject {
        name: "geotiff",
        path,
        valid,
        besides: BESIDES,
        cost: 1,
        words: &["-9999", "nan", "II*\0", "MM\0*"],
    }
    .check(|path, _| Ok(geotiff::read(path).map(drop)?))
}

#[test]
fn extended_xyz_files() -> TestResult {
    let plain = "2\nLattice=\"1 0 0 0 2 0 0 0 3\" Origin=\"0 0 0\" Properties=id:I:1:pos:R:3:v:R:2:on:L:1:phase:S:1 Time=0.5 pbc=\"F F F\"\n7 0.5 1e-3 -2 1 2 T Solid\n2 1 2 3 0 0 F Liquid\n";
    let two = "1\nProperties=species:S:1:pos:R:3\nH 0 0 0\n1\nProperties=species:S:1:pos:R:3\nH 0 0 1\n";
    let words =
        &["Lattice=", "Properties=", "pos:R:3", "id:I:1", ":S:", "Time=", "\"", "{", "}", "T", "nan", "\n"];
    check_text("xyz", &[plain, two], words, |path| Ok(extended_xyz::read(path).map(drop)?))
}

#[test]
fn configurations() -> TestResult {
    let text = "steps = 10\nseed = 7\nprecision = \"f32\"\nquiet = true\nformats = [\"vtk\", \"png\"]\n\
                [set]\nconductivity = 0.2\n";
    let words = &[
        "steps",
        "seed",
        "precision",
        "quiet",
        "formats",
        "set",
        "config",
        "help",
        "true",
        "inf",
        "[",
        "]",
        "[[",
        "\"",
        "'''",
        "=",
        ".",
        "{",
        "}",
        "1979-05-27",
        "0x7f",
    ];
    check_text("config", &[text], words, |path| read(&["run", "--config"], path).map(drop))
}
