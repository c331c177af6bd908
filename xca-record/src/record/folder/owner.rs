//! Whose folder it is, and which files in it are of its owner.

use super::{FolderError, Kind};
use crate::format::{Moment, Shape, shape};
use crate::record::SERIES;
use crate::report::Earlier;
use std::fs;
use std::path::{Path, PathBuf};
use xca_checkpoint::CheckpointFolder;
use xca_io::numbered;

/// The command that has written to a folder before, as its report tells.
pub(super) struct Owner {
    pub(super) kind: Kind,
    /// The program that was run, if the report says so.
    pub(super) program: Option<String>,
    /// Whether there is nothing left to do.
    has_ended: bool,
    /// What the report lists, `*` standing for digits.
    files: Vec<String>,
}

impl Owner {
    /// The owners of a folder: none of a new one.
    pub(super) fn all(folder: &Path) -> Result<Vec<Self>, FolderError> {
        let mut owners = Vec::new();
        for kind in [Kind::Run, Kind::Comparison, Kind::Ensemble] {
            let earlier = Earlier::read(&folder.join(kind.report())).map_err(FolderError::Report)?;
            if let Some(earlier) = earlier.filter(|earlier| earlier.xca.is_some()) {
                let is_pictures = kind == Kind::Run && earlier.is_of("render");
                let kind = if is_pictures { Kind::Pictures } else { kind };
                let has_ended = earlier.has_ended();
                owners.push(Self { kind, program: earlier.program, has_ended, files: earlier.files });
            }
        }
        Ok(owners)
    }

    /// Whether it is a run that can be resumed to its end.
    pub(super) fn can_resume(&self, folder: &Path) -> bool {
        self.kind == Kind::Run && !self.has_ended && !CheckpointFolder::of_run(folder).is_empty()
    }

    /// The files that are there of those that the report lists: as far as a command can have made them. A
    /// report that someone has edited must not lead out of the folder, nor to files of others in it.
    ///
    /// Beside the formats of the framework, a run has those of the files that `others` name.
    pub(super) fn files(&self, folder: &Path, others: &[String]) -> Vec<PathBuf> {
        let mut files = Vec::new();
        for name in self.files.iter().filter(|name| can_be_made(name, self.kind, others)) {
            let is_below_link =
                name.split_once('/').is_some_and(|(below, _)| !is_folder(&folder.join(below)));
            if !is_below_link {
                files.extend(meant(folder, name).into_iter().filter(|path| is_file(path)));
            }
        }
        let report = folder.join(self.kind.report());
        files.extend(is_file(&report).then_some(report));
        files
    }
}

/// Whether it is a file, and not a link to one.
pub(super) fn is_file(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|found| found.is_file())
}

/// Whether it is a folder, and not a link to one.
pub(super) fn is_folder(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|found| found.is_dir())
}

/// The files of a comparison beside its report.
const COMPARISON_FILES: [&str; 6] =
    ["compare.html", "compare.md", "engines.csv", "differences.csv", "divergence.csv", "observables.csv"];

/// The files of an ensemble beside its report.
const ENSEMBLE_FILES: [&str; 3] = ["members.csv", "summary.csv", "summary.html"];

/// Whether a command makes files of that name.
fn can_be_made(name: &str, kind: Kind, others: &[String]) -> bool {
    let is_plain = |part: &str| {
        let mut letters = part.chars();
        letters.next().is_some_and(|first| first != '.')
            && letters.all(|letter| letter.is_ascii_alphanumeric() || "._-*".contains(letter))
    };
    if !name.split('/').all(is_plain) {
        return false;
    }
    match kind {
        Kind::Comparison => COMPARISON_FILES.contains(&name),
        Kind::Ensemble => ENSEMBLE_FILES.contains(&name),
        Kind::Pictures => {
            matches!(name, "animation.png" | "animation.gif")
                || shape(name) == Some(Shape { moment: Moment::Each, extension: "png" })
        }
        Kind::Run => name == SERIES || name == CheckpointFolder::files() || is_of_run(name, others),
    }
}

/// The shapes of the files of the framework's own formats.
const SHAPES: [(Moment, &[&str]); 4] = [
    (Moment::Run, &["pvd"]),
    (Moment::First, &["png"]),
    (Moment::Each, &["vti", "vtp", "xyz"]),
    (Moment::Last, &["asc", "csv", "png", "tif"]),
];

fn is_of_run(name: &str, others: &[String]) -> bool {
    let Some(found) = shape(name) else { return false };
    // A view may be called `final`.
    let as_of_run = Shape { moment: Moment::Run, ..found };
    let is_own = |it: Shape<'_>| {
        SHAPES.iter().any(|(moment, extensions)| *moment == it.moment && extensions.contains(&it.extension))
    };
    // A file of the whole run could have any name but for its extension, so it must have the same.
    let is_alike = |other: &String| found.moment != Moment::Run && shape(other) == Some(found);
    is_own(found) || is_own(as_of_run) || others.iter().any(|other| other == name || is_alike(other))
}

/// What there is in the folder, of whatever kind, under a name in which `*` stands for digits.
pub(super) fn meant(folder: &Path, name: &str) -> Vec<PathBuf> {
    let path = folder.join(name);
    let Some((before, after)) = name.rsplit('/').next().and_then(|last| last.split_once('*')) else {
        return if fs::symlink_metadata(&path).is_ok() { vec![path] } else { Vec::new() };
    };
    path.parent().map(|folder| numbered::entries(folder, before, after)).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_that_commands_make() {
        for name in [
            "observables.csv",
            "final.csv",
            "final_fish.csv",
            "final_altitude.asc",
            "final_altitude.tif",
            "initial.png",
            "final_pond-2.png",
            "water.pvd",
            "final_lava.pvd",
            "frames/water_*.vti",
            "frames/fish_*.vtp",
            "frames/fish_*.xyz",
            "checkpoints/step_*.checkpoint",
        ] {
            assert!(can_be_made(name, Kind::Run, &[]), "{name}");
        }
        for name in ["animation.png", "animation.gif", "frames/frame_*.png"] {
            assert!(can_be_made(name, Kind::Pictures, &[]), "{name}");
        }
        assert!(can_be_made("compare.html", Kind::Comparison, &[]));
        for kind in [Kind::Run, Kind::Pictures, Kind::Comparison] {
            for name in [
                "",
                "*",
                "*.csv",
                "final*.csv",
                "/final.csv",
                "../final.csv",
                "./final.csv",
                "frames/../final.csv",
                "sub/final.csv",
                "sub/precious.txt",
                "frames/*",
                "frames/*.vti",
                "frames/_*.vti",
                "frames/a_*b_*.vti",
                "frames/a_*.txt",
                "frames/a/b_*.vti",
                "checkpoints/*",
                "checkpoints/precious.checkpoint",
                "precious.csv",
                "thesis.png",
                "finale.csv",
                ".final.csv",
                "run.json",
                "a\\b.pvd",
                "c:d.pvd",
            ] {
                assert!(!can_be_made(name, kind, &[]), "{name} {kind:?}");
            }
        }
    }

    /// A format of the program's own lays claim to what has the shape of its files, and to nothing else.
    #[test]
    fn other_formats_have_files_of_their_shapes() {
        let others = ["frames/water_*.json", "final_water.txt", "water.log"].map(str::to_owned);
        for name in ["frames/fish_*.json", "final.txt", "final_fish.txt", "water.log"] {
            assert!(can_be_made(name, Kind::Run, &others), "{name}");
            assert!(!can_be_made(name, Kind::Run, &[]), "{name}");
        }
        for name in
            ["water.json", "precious.txt", "precious.log", "initial.txt", "frames/water_*.txt", "final.json"]
        {
            assert!(!can_be_made(name, Kind::Run, &others), "{name}");
        }
        assert!(!can_be_made("frames/fish_*.json", Kind::Pictures, &others));
    }
}
