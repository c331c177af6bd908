//! The last two checkpoints of a run.

use super::{CheckpointWriteError, Description, file};
use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use xca_core::Simulation;
use xca_io::atomic::{OutputFolder, WriteError};
use xca_io::numbered;

/// The name of the folder with the checkpoints, inside the run's folder.
pub const CHECKPOINTS: &str = "checkpoints";

const STEM: &str = "step";
const EXTENSION: &str = "checkpoint";

/// The folder of the checkpoints of a run.
#[derive(Debug)]
pub struct CheckpointFolder {
    folder: OutputFolder,
    /// The name of the checkpoint that was written last, or that the run resumed from.
    last: Option<OsString>,
}

impl CheckpointFolder {
    /// Creates the folder inside that of a run. `last` is the checkpoint that the run resumes from.
    pub fn create(run: &OutputFolder, last: Option<&Path>) -> Result<Self, WriteError> {
        let last = last.and_then(Path::file_name).map(OsString::from);
        Ok(Self { folder: run.subfolder(CHECKPOINTS)?, last })
    }

    /// Writes a checkpoint of a run in its present state, block by block. Keeps this one and the previous
    /// one, and removes all others.
    pub fn write(
        &mut self,
        description: &Description,
        simulation: &Simulation,
    ) -> Result<(), CheckpointWriteError> {
        let path = self.folder.numbered(STEM, description.step, EXTENSION);
        file::write(&path, description, simulation)?;
        self.folder.sync()?;
        let name = path.file_name().map(OsString::from);
        if self.last == name {
            return Ok(());
        }
        let before = std::mem::replace(&mut self.last, name);
        let is_kept = |file: &Path| {
            let name = file.file_name();
            name == self.last.as_deref() || name == before.as_deref()
        };
        for file in Self::all(self.folder.path()).into_iter().filter(|file| !is_kept(file)) {
            match fs::remove_file(&file) {
                Err(source) if source.kind() != io::ErrorKind::NotFound => {
                    return Err(WriteError::File { path: file, source }.into());
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// The checkpoints in the folder of a run, the latest first.
    pub fn of_run(run: &Path) -> Vec<PathBuf> {
        let mut all = Self::all(&run.join(CHECKPOINTS));
        all.reverse();
        all
    }

    fn all(folder: &Path) -> Vec<PathBuf> {
        numbered::files(folder, &format!("{STEM}_"), &format!(".{EXTENSION}"))
    }

    /// The file names for a report, with `*` for the number of the step.
    pub fn files() -> String {
        format!("{CHECKPOINTS}/{STEM}_*.{EXTENSION}")
    }
}
