//! The one door to folders: a command writes to a folder only after it has got it here.
//!
//! A folder has an owner, who is told by its report. Only a command of the same kind may replace the owner's
//! files, and no command replaces others. While a command writes, the folder is locked.

mod error;
mod kind;
mod names;
mod owner;

pub use error::FolderError;
pub use kind::Kind;
pub(crate) use names::SERIES;
pub use names::{COMPARISON, ENSEMBLE, FRAMES, REPORT};

use owner::{Owner, is_folder, meant};
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use xca_checkpoint::CHECKPOINTS;
use xca_checkpoint::InputFile;
use xca_io::atomic::{OutputFolder, remove_leftovers};
use xca_picture::is_picture_of_xca;

/// A folder that this process alone writes to.
#[derive(Debug, Clone)]
pub struct LockedFolder {
    pub top: OutputFolder,
    /// The folder itself, locked until the command ends in whatever way; nothing where the system does not
    /// lock folders.
    _lock: Option<Arc<File>>,
}

impl LockedFolder {
    fn open(path: &Path) -> Result<Self, FolderError> {
        let top = OutputFolder::create(path)?;
        let lock = lock(path)?;
        Ok(Self { top, _lock: lock })
    }

    /// The folder of a command that goes on in it.
    pub fn again(path: &Path) -> Result<Self, FolderError> {
        let folder = Self::open(path)?;
        remove_leftovers(path);
        Ok(folder)
    }

    /// Makes the folder, and refuses one in which something of others would be replaced. Removes nothing.
    pub fn prepare(path: &Path, claim: &Claim<'_>) -> Result<Self, FolderError> {
        let folder = Self::open(path)?;
        claim.replaced(path)?;
        Ok(folder)
    }

    /// A folder of anyone, for one picture beside what is there; an earlier picture of that name is replaced.
    pub fn beside(path: &Path, picture: &str) -> Result<Self, FolderError> {
        let folder = Self::open(path)?;
        let mut listed = Vec::new();
        for owner in Owner::all(path)? {
            listed.extend(owner.files(path, &[]));
        }
        let is_foreign =
            |file: &PathBuf| listed.contains(file) || !owner::is_file(file) || !is_picture_of_xca(file);
        match meant(path, picture).into_iter().find(is_foreign) {
            Some(file) => Err(foreign(path, &file, Kind::Pictures)),
            None => Ok(folder),
        }
    }
}

/// What a command wants of a folder.
#[derive(Debug, Clone, Copy)]
pub struct Claim<'a> {
    pub kind: Kind,
    /// What it will write, `*` standing for digits; its report beside.
    pub files: &'a [String],
    /// What it has read.
    pub inputs: &'a [InputFile],
    /// The program whose output alone may be replaced. `None` if it may be that of any program.
    pub program: Option<&'a str>,
    /// Whether an unfinished run may be replaced, also where it could be resumed.
    pub overwrite: bool,
}

impl Claim<'_> {
    /// The files of an earlier command of this kind, its report the last.
    fn replaced(&self, path: &Path) -> Result<Vec<PathBuf>, FolderError> {
        let mut old = Vec::new();
        for owner in Owner::all(path)? {
            if owner.kind != self.kind {
                return Err(FolderError::Taken { folder: path.to_owned(), kind: owner.kind });
            }
            let is_other = |found: &&String| self.program.is_some_and(|program| program != **found);
            if let Some(program) = owner.program.as_ref().filter(is_other) {
                return Err(FolderError::OtherProgram { folder: path.to_owned(), program: program.clone() });
            }
            if !self.overwrite && owner.can_resume(path) {
                return Err(FolderError::Unfinished { folder: path.to_owned() });
            }
            old.extend(owner.files(path, self.files));
        }
        let names = self.files.iter().map(String::as_str).chain([self.kind.report()]);
        let mut new = names.flat_map(|name| meant(path, name));
        if let Some(file) = new.find(|file| !old.contains(file)) {
            return Err(foreign(path, &file, self.kind));
        }
        for input in self.inputs {
            // A path that does not exist any more is in no one's way.
            let Ok(wanted) = input.path.canonicalize() else { continue };
            if old.iter().any(|file| file.canonicalize().is_ok_and(|file| file == wanted)) {
                return Err(FolderError::Input { file: input.path.clone() });
            }
        }
        Ok(old)
    }
}

fn foreign(folder: &Path, file: &Path, kind: Kind) -> FolderError {
    let file = file.strip_prefix(folder).unwrap_or(file).display().to_string();
    FolderError::Foreign { folder: folder.to_owned(), file, kind }
}

/// The folders of a run, ready to be written to.
#[derive(Debug, Clone)]
pub struct RunFolder {
    /// The run's own.
    pub top: OutputFolder,
    /// For one file for each time and view.
    pub frames: OutputFolder,
    _locked: LockedFolder,
}

impl RunFolder {
    /// Makes the folder, and removes what an earlier run left there: the files that its `run.json` lists, and
    /// no others.
    pub fn prepare(path: &Path, claim: &Claim<'_>) -> Result<Self, FolderError> {
        let locked = LockedFolder::open(path)?;
        let old = claim.replaced(path)?;
        let folder = Self::within(locked)?;
        remove(old)?;
        Ok(folder)
    }

    /// The folder of a run that goes on, and what was killed in it removed.
    pub fn open(path: &Path) -> Result<Self, FolderError> {
        let locked = LockedFolder::open(path)?;
        let owners = Owner::all(path)?;
        if let Some(owner) = owners.iter().find(|owner| owner.kind != Kind::Run) {
            return Err(FolderError::Taken { folder: path.to_owned(), kind: owner.kind });
        }
        match meant(path, REPORT).first() {
            Some(report) if owners.is_empty() => Err(foreign(path, report, Kind::Run)),
            _ => Self::within(locked),
        }
    }

    fn within(locked: LockedFolder) -> Result<Self, FolderError> {
        let top = locked.top.clone();
        let frames = top.subfolder(FRAMES)?;
        remove_leftovers(top.path());
        for below in [frames.path(), &top.file(CHECKPOINTS)] {
            if is_folder(below) {
                remove_leftovers(below);
            }
        }
        Ok(Self { top, frames, _locked: locked })
    }

    /// Where the report stands.
    pub fn report(&self) -> PathBuf {
        self.top.file(REPORT)
    }
}

/// Locks a folder for this process.
fn lock(folder: &Path) -> Result<Option<Arc<File>>, FolderError> {
    let Ok(file) = File::open(folder) else { return Ok(None) };
    match file.try_lock() {
        Ok(()) => Ok(Some(Arc::new(file))),
        Err(TryLockError::WouldBlock) => Err(FolderError::InUse { folder: folder.to_owned() }),
        Err(TryLockError::Error(_)) => Ok(None),
    }
}

/// Removes files, where they are there.
pub(super) fn remove(files: impl IntoIterator<Item = PathBuf>) -> Result<(), FolderError> {
    for path in files {
        match fs::remove_file(&path) {
            Err(source) if source.kind() != io::ErrorKind::NotFound => {
                return Err(FolderError::Remove { path, source });
            }
            _ => {}
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
