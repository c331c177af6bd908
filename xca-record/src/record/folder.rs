//! The folder of a run, and what an earlier run left in it.

use crate::checkpoint::CHECKPOINTS;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use xca_io::atomic::{OutputFolder, WriteError, remove_leftovers};

/// The folder, below the run's own, that holds the frames.
pub const FRAMES: &str = "frames";

/// The report, by which a folder is known to be a run's.
pub const REPORT: &str = "run.json";

/// The folders of a run, ready to be written to.
#[derive(Debug, Clone)]
pub struct RunFolder {
    /// The run's own.
    pub top: OutputFolder,
    /// For one file for each time and view.
    pub frames: OutputFolder,
    /// The folder itself, locked until the run ends in whatever way; nothing where the system does not lock folders.
    _lock: Option<Arc<File>>,
}

/// A folder that a run must not or cannot write to.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages explain the fields")]
#[non_exhaustive]
pub enum FolderError {
    #[error(transparent)]
    Write(#[from] WriteError),
    #[error(
        "{} holds `{file}` but no run.json of an earlier run; move it away or give another folder with --out",
        folder.display()
    )]
    Foreign { folder: PathBuf, file: String },
    #[error(
        "the run starts from {}, which it would replace; move it away or give another folder with --out",
        file.display()
    )]
    Input { file: PathBuf },
    #[error("another run is writing to {}", folder.display())]
    InUse { folder: PathBuf },
    #[error("cannot remove {}, which an earlier run left", path.display())]
    Remove { path: PathBuf, source: io::Error },
}

impl RunFolder {
    /// Makes the folder, and removes what an earlier run left there: the files that its `run.json` lists, and no others.
    ///
    /// `files` are those that the new run will make, `inputs` those that it has read.
    pub fn prepare(path: &Path, files: &[String], inputs: &[PathBuf]) -> Result<Self, FolderError> {
        let earlier = earlier_files(path);
        let mut old = Vec::new();
        for file in earlier.as_deref().unwrap_or_default() {
            old.extend(existing(path, file));
        }
        let mut new = Vec::new();
        for file in files.iter().map(String::as_str).chain([REPORT]) {
            new.extend(existing(path, file));
        }
        if let Some(file) = new.iter().find(|file| earlier.is_none() && !old.contains(file)) {
            let file = file.strip_prefix(path).unwrap_or(file).display().to_string();
            return Err(FolderError::Foreign { folder: path.to_owned(), file });
        }
        for input in inputs {
            // A path that does not exist any more is in no one's way.
            let Ok(wanted) = input.canonicalize() else { continue };
            let same = |file: &PathBuf| file.canonicalize().is_ok_and(|file| file == wanted);
            if old.iter().chain(&new).any(same) {
                return Err(FolderError::Input { file: input.clone() });
            }
        }
        let folder = Self::open(path)?;
        remove(old.into_iter().chain(new))?;
        Ok(folder)
    }

    /// The folder of a run that goes on, and what was killed in it removed.
    pub fn open(path: &Path) -> Result<Self, FolderError> {
        let top = OutputFolder::create(path)?;
        let lock = lock(path)?;
        let frames = top.subfolder(FRAMES)?;
        for folder in [top.path(), frames.path(), &top.file(CHECKPOINTS)] {
            remove_leftovers(folder);
        }
        Ok(Self { top, frames, _lock: lock })
    }

    /// Where the report stands.
    pub fn report(&self) -> PathBuf {
        self.top.file(REPORT)
    }
}

/// Locks a folder for this process.
pub(crate) fn lock(folder: &Path) -> Result<Option<Arc<File>>, FolderError> {
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

/// The files that the report of an earlier run lists; nothing where there is no such report.
fn earlier_files(folder: &Path) -> Option<Vec<String>> {
    let text = fs::read_to_string(folder.join(REPORT)).ok()?;
    let report: serde_json::Value = serde_json::from_str(&text).ok()?;
    report.get("xca")?;
    let files = report.get("files")?.as_array()?;
    let names = files.iter().filter_map(serde_json::Value::as_str);
    // A list that someone has edited must not lead out of the folder.
    let plain = |part: &str| !part.is_empty() && part != "." && part != ".." && !part.contains(['\\', ':']);
    Some(names.filter(|name| name.split('/').all(plain)).map(str::to_owned).collect())
}

/// The files of the folder that a name means, where `*` stands for digits.
fn existing(folder: &Path, name: &str) -> Vec<PathBuf> {
    let path = folder.join(name);
    let Some((before, after)) = name.rsplit('/').next().and_then(|last| last.split_once('*')) else {
        return if path.is_file() { vec![path] } else { Vec::new() };
    };
    path.parent().map(|folder| numbered_files(folder, before, after)).unwrap_or_default()
}

/// The files of a folder whose names have only digits between `before` and `after`, in the order of these numbers.
pub fn numbered_files(folder: &Path, before: &str, after: &str) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let is_meant = |file: &str| {
        let middle = file.strip_prefix(before).and_then(|rest| rest.strip_suffix(after));
        middle.is_some_and(|middle| !middle.is_empty() && middle.bytes().all(|byte| byte.is_ascii_digit()))
    };
    let mut files: Vec<PathBuf> = entries
        .filter_map(Result::ok)
        .filter(|entry| entry.file_name().to_str().is_some_and(is_meant))
        .map(|entry| entry.path())
        .filter(|path| path.is_file())
        .collect();
    files.sort_by_key(|file| (file.as_os_str().len(), file.clone()));
    files
}

#[cfg(test)]
mod tests {
    use super::*;

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

    fn report(folder: &Path, files: &str) {
        fs::write(folder.join(REPORT), format!(r#"{{"xca": "0.1.0", "files": [{files}]}}"#)).unwrap();
    }

    #[test]
    fn what_an_earlier_run_left_is_removed_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path();
        let kept = ["notes.txt", "frames/p_old.vtp", "frames/q_00000001.vtp", "frames/p_1.vti", "away.csv"];
        write(path, &kept);
        write(path, &["final.csv", "last.csv", "frames/p_00000000.vtp", "frames/p_123456789.vtp"]);
        report(path, r#""final.csv", "last.csv", "frames/p_*.vtp", "../away.csv", "/etc/x", """#);
        RunFolder::prepare(path, &files(), &[]).unwrap();
        for name in kept {
            assert!(path.join(name).is_file(), "{name}");
        }
        for name in ["final.csv", "last.csv", "frames/p_00000000.vtp", "frames/p_123456789.vtp", REPORT] {
            assert!(!path.join(name).exists(), "{name}");
        }
    }

    #[test]
    fn files_of_someone_else_are_not_replaced() {
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), &["final.csv"]);
        let error = RunFolder::prepare(folder.path(), &files(), &[]).unwrap_err().to_string();
        assert!(error.contains("holds `final.csv` but no run.json"), "{error}");
        assert!(folder.path().join("final.csv").is_file());
        // Another program's run.json.
        fs::write(folder.path().join(REPORT), "{}").unwrap();
        assert!(RunFolder::prepare(folder.path(), &[], &[]).is_err());
    }

    #[test]
    fn a_run_does_not_replace_its_own_input() {
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), &["final.csv"]);
        report(folder.path(), r#""final.csv""#);
        let input = folder.path().join("frames/../final.csv");
        fs::create_dir(folder.path().join(FRAMES)).unwrap();
        let error = RunFolder::prepare(folder.path(), &files(), &[input]).unwrap_err().to_string();
        assert!(error.contains("final.csv, which it would replace"), "{error}");
        assert!(folder.path().join("final.csv").is_file());
    }
}
