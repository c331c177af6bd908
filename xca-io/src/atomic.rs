//! Files that appear complete or not at all, and the folder that a run writes to.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// A file or folder that could not be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WriteError {
    /// The output folder does not exist and cannot be made.
    #[error("cannot create the output folder {}", path.display())]
    CreateFolder {
        /// The folder.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// The path of the output folder is not a folder.
    #[error("cannot use {} as the output folder: it exists and is not a folder", path.display())]
    NotAFolder {
        /// The path.
        path: PathBuf,
    },
    /// The output folder exists, but no file can be made in it.
    #[error("cannot write into the output folder {}", path.display())]
    NotWritable {
        /// The folder.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// A file could not be written, completed or renamed.
    #[error("cannot write {}", path.display())]
    File {
        /// The file under its final name.
        path: PathBuf,
        /// The error of the system or of the encoder.
        source: io::Error,
    },
}

/// Writes a file that appears complete or not at all.
///
/// `fill` receives a buffered temporary file in the same folder. If `fill` succeeds, the file is flushed to
/// the disk and renamed to `path`. The rename replaces an earlier file in one move. If `fill` fails, the
/// temporary file is removed, and an earlier file keeps its content.
///
/// # Errors
/// [`WriteError::File`] with `path` and the error of `fill` or of the system.
pub fn write_atomically(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> Result<(), WriteError> {
    let failed = |source| WriteError::File { path: path.to_owned(), source };
    let temporary = temporary_name(path).map_err(failed)?;
    let result = fill_and_rename(path, &temporary, fill);
    if result.is_err() {
        // Report the first error. A leftover file has a telling name and does no harm.
        let _ = fs::remove_file(&temporary);
    }
    result.map_err(failed)
}

fn fill_and_rename(
    path: &Path,
    temporary: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> io::Result<()> {
    let mut writer = BufWriter::with_capacity(1 << 18, File::create_new(temporary)?);
    fill(&mut writer)?;
    writer.into_inner().map_err(io::IntoInnerError::into_error)?.sync_all()?;
    fs::rename(temporary, path)
}

/// Removes the temporary files that a killed process left in a folder. See [`write_atomically`].
pub fn remove_leftovers(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.filter_map(Result::ok) {
        if entry.file_name().to_str().is_some_and(is_temporary) {
            // A file that cannot be removed does no harm.
            let _ = fs::remove_file(entry.path());
        }
    }
}

fn is_temporary(name: &str) -> bool {
    let numbers = || name.strip_prefix('.')?.strip_suffix(".part")?.rsplit_once('.')?.1.split_once('-');
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    numbers().is_some_and(|(process, count)| is_number(process) && is_number(count))
}

/// `folder/name.csv` gives `folder/.name.csv.PROCESS-COUNT.part`, which no other writer uses.
fn temporary_name(path: &Path) -> io::Result<PathBuf> {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    let name = path
        .file_name()
        .ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "the path does not end in a file name"))?;
    loop {
        let mut hidden = std::ffi::OsString::from(".");
        hidden.push(name);
        hidden.push(format!(".{}-{}.part", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed)));
        let temporary = path.with_file_name(hidden);
        // The name may exist: left by a process with the same number, or made as a link.
        if fs::symlink_metadata(&temporary).is_err() {
            return Ok(temporary);
        }
    }
}

/// The folder for the files of a run.
///
/// Create it at the start of a run. A folder that is not writable is then reported before hours of
/// computation.
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let temporary = tempfile::tempdir()?;
/// # let somewhere = temporary.path();
/// use xca_io::atomic::OutputFolder;
///
/// let out = OutputFolder::create(somewhere.join("runs/first"))?;
/// assert!(out.file("final.csv").ends_with("runs/first/final.csv"));
/// assert!(out.numbered("particles", 250, "vtp").ends_with("runs/first/particles_00000250.vtp"));
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone)]
pub struct OutputFolder {
    path: PathBuf,
}

impl OutputFolder {
    /// Creates the folder and its parents if they do not exist. Then checks that it is writable by making a
    /// file and removing it. Earlier content stays.
    ///
    /// # Errors
    /// [`WriteError::CreateFolder`], [`WriteError::NotAFolder`] or [`WriteError::NotWritable`], each with the
    /// path.
    pub fn create(path: impl Into<PathBuf>) -> Result<Self, WriteError> {
        let path = path.into();
        if path.exists() && !path.is_dir() {
            return Err(WriteError::NotAFolder { path });
        }
        if let Err(source) = fs::create_dir_all(&path) {
            return Err(WriteError::CreateFolder { path, source });
        }
        match probe(&path) {
            Ok(()) => Ok(Self { path }),
            Err(source) => Err(WriteError::NotWritable { path, source }),
        }
    }

    /// A folder to read from. It need not exist.
    pub fn to_read(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into() }
    }

    /// The path of the folder.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The path of a file in this folder.
    ///
    /// A name may be that of a substate. Characters other than ASCII letters, digits, `.`, `_` and `-` become
    /// `_`. The path therefore stays inside the folder on every system.
    #[must_use]
    pub fn file(&self, name: &str) -> PathBuf {
        self.path.join(plain_name(name))
    }

    /// The path of one file of a series: `STEM_STEP.EXTENSION`. The step has at least eight digits, so that
    /// the names sort by step.
    #[must_use]
    pub fn numbered(&self, stem: &str, step: u64, extension: &str) -> PathBuf {
        self.file(&format!("{stem}_{step:08}.{extension}"))
    }

    /// Flushes the file names of the folder to the disk, so that they survive a power failure. Has no effect
    /// outside Unix.
    ///
    /// # Errors
    /// [`WriteError::File`] with the folder.
    pub fn sync(&self) -> Result<(), WriteError> {
        let synced =
            if cfg!(unix) { File::open(&self.path).and_then(|folder| folder.sync_all()) } else { Ok(()) };
        synced.map_err(|source| WriteError::File { path: self.path.clone(), source })
    }

    /// Creates and checks a folder inside this one. See [`OutputFolder::create`].
    ///
    /// # Errors
    /// Those of [`OutputFolder::create`].
    pub fn subfolder(&self, name: &str) -> Result<Self, WriteError> {
        Self::create(self.file(name))
    }
}

/// A valid file name made from `name`, as in [`OutputFolder::file`].
#[must_use]
pub fn plain_name(name: &str) -> String {
    let kept = |c: char| if c.is_ascii_alphanumeric() || "._-".contains(c) { c } else { '_' };
    let only_dots = name.chars().all(|c| c == '.');
    if only_dots { "_".to_owned() } else { name.chars().map(kept).collect() }
}

fn probe(folder: &Path) -> io::Result<()> {
    let file = temporary_name(&folder.join("probe"))?;
    OpenOptions::new().write(true).create_new(true).open(&file)?.write_all(b"x")?;
    fs::remove_file(&file)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::error::Error;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> =
            fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_replaces_an_earlier_one_and_leaves_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        write_atomically(&path, |w| w.write_all(b"first, and longer")).unwrap();
        write_atomically(&path, |w| w.write_all(b"second")).unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"second");
        assert_eq!(names(folder.path()), ["a.txt"]);
    }

    #[test]
    fn the_name_shows_the_old_content_until_the_new_is_complete() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        write_atomically(&path, |w| w.write_all(b"old")).unwrap();
        write_atomically(&path, |w| {
            w.write_all(b"new")?;
            w.flush()?;
            assert_eq!(fs::read(&path).unwrap(), b"old");
            Ok(())
        })
        .unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
    }

    #[test]
    fn a_failure_keeps_the_old_file_and_names_the_path() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        write_atomically(&path, |w| w.write_all(b"old")).unwrap();
        let error = write_atomically(&path, |w| {
            w.write_all(b"half of the n")?;
            Err(io::Error::other("no more paper"))
        })
        .unwrap_err();
        assert!(error.to_string().contains("a.txt"), "{error}");
        assert_eq!(error.source().unwrap().to_string(), "no more paper");
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(names(folder.path()), ["a.txt"]);
    }

    #[test]
    fn what_a_killed_process_left_is_removed_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let left = temporary_name(&folder.path().join("a.b.csv")).unwrap();
        fs::write(&left, "half").unwrap();
        let kept = [".a.csv.1-2", ".a.csv.1-.part", ".part", "a.csv.1-2.part", ".hidden"];
        for name in kept {
            fs::write(folder.path().join(name), "").unwrap();
        }
        remove_leftovers(folder.path());
        assert!(!left.exists());
        assert_eq!(names(folder.path()).len(), kept.len());
    }

    #[test]
    fn a_file_in_a_missing_folder_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("missing/a.txt");
        let error = write_atomically(&path, |_| Ok(())).unwrap_err();
        assert!(error.to_string().contains("missing/a.txt"), "{error}");
        assert!(write_atomically(Path::new("/"), |_| Ok(())).is_err());
    }

    #[test]
    fn a_folder_is_created_and_left_empty() {
        let folder = tempfile::tempdir().unwrap();
        let out = OutputFolder::create(folder.path().join("a/b")).unwrap();
        assert!(out.path().is_dir());
        assert!(names(out.path()).is_empty());
        let again = OutputFolder::create(out.path()).unwrap();
        assert_eq!(again.path(), out.path());
        assert!(out.subfolder("vtk").unwrap().path().ends_with("a/b/vtk"));
    }

    #[test]
    fn a_file_in_the_folders_place_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("taken");
        fs::write(&path, "").unwrap();
        let error = OutputFolder::create(&path).unwrap_err();
        assert!(matches!(error, WriteError::NotAFolder { .. }));
        assert!(error.to_string().contains("taken"), "{error}");
        let error = OutputFolder::create(path.join("below")).unwrap_err();
        assert!(matches!(error, WriteError::CreateFolder { .. }), "{error:?}");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_folder_that_takes_no_files_is_refused_at_once() {
        // Not even root can make a file here.
        let error = OutputFolder::create("/proc/self").unwrap_err();
        assert!(matches!(error, WriteError::NotWritable { .. }), "{error:?}");
        assert!(error.source().is_some());
    }

    #[test]
    fn names_stay_inside_the_folder() {
        let folder = tempfile::tempdir().unwrap();
        let out = OutputFolder::create(folder.path()).unwrap();
        for name in ["../x", "/etc/x", "a/b", "..", ".", "", "a\\b", "c:d"] {
            assert_eq!(out.file(name).parent(), Some(out.path()), "{name}");
        }
        assert_eq!(out.file("final-1.csv").file_name().unwrap(), "final-1.csv");
        assert_eq!(out.numbered("p", 123_456_789, "vtp").file_name().unwrap(), "p_123456789.vtp");
    }
}
