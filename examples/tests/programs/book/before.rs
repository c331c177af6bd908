//! What commands of the book take for granted: the runs that they go on from or look at.

use super::command::Command;
use std::fs;
use std::path::{Path, PathBuf};

/// A run before a command of a page.
pub(super) struct Before {
    pub(super) page: &'static str,
    pub(super) command: &'static str,
    pub(super) program: &'static str,
    pub(super) options: &'static str,
}

pub(super) const BEFORE: &[Before] = &[
    Before {
        page: "docs/checkpoints.md",
        command: "cargo run --release --bin lava -- resume out/lava --checkpoint-every 1",
        program: "lava",
        options: "--steps 4 --checkpoint-every 2",
    },
    Before {
        page: "docs/many-machines.md",
        command: "mpirun -n 8 cadem resume out/cadem",
        program: "cadem",
        options: "--engine mpi:cpu --steps 4 --checkpoint-every 2",
    },
    Before {
        page: "docs/many-machines.md",
        command: "cadem resume out/cadem --engine cpu",
        program: "cadem",
        options: "--steps 4 --checkpoint-every 2",
    },
];

impl Before {
    pub(super) fn is_before(&self, command: &Command) -> bool {
        (self.page, self.command) == (&command.page, &command.text)
    }
}

/// Makes an output directory that of a run killed after its last checkpoint but one, so that `resume` has
/// something to do. If there is no such directory, `resume` itself says so.
pub(super) fn leave_as_killed(folder: &Path) {
    let report = folder.join("run.json");
    if !report.exists() {
        return;
    }
    fs::remove_file(report).unwrap();
    let Ok(entries) = fs::read_dir(folder.join("checkpoints")) else { return };
    let entries = entries.map(|entry| entry.unwrap().path());
    let is_checkpoint = |path: &PathBuf| path.extension().is_some_and(|it| it == "checkpoint");
    let mut checkpoints: Vec<PathBuf> = entries.filter(is_checkpoint).collect();
    checkpoints.sort();
    if checkpoints.len() > 1 {
        fs::remove_file(checkpoints.pop().unwrap()).unwrap();
    }
}
