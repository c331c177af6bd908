//! Collections: the files of a run with their times.

use std::fs::{self, OpenOptions};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Component, Path, PathBuf};

use super::super::atomic::{WriteError, write_atomically};
use super::VtkError;
use super::appended::escaped;

/// A ParaView collection (`.pvd`): a list of files with their times.
///
/// The file is complete after each addition. ParaView can therefore open it during a run, and after a run was
/// killed. An addition is one write: it replaces the closing tags by the new entry and the closing tags. A
/// failure of the machine can lose the last entry or the closing tags. [`Collection::of`] rebuilds the file.
///
/// A run with particles and dense substates makes a collection of each.
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let temporary = tempfile::tempdir()?;
/// # let out = temporary.path();
/// use xca_io::vtk::{Collection, write_particles};
///
/// let mut collection = Collection::create(&out.join("particles.pvd"))?;
/// for step in 0..3_u32 {
///     let time = f64::from(step) * 0.5;
///     let file = out.join(format!("particles_{step:08}.vtp"));
///     write_particles(&file, time, [[0.0, 0.0, time]][..].into(), &[])?;
///     collection.add(time, &file)?;
/// }
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Collection {
    path: PathBuf,
    /// The content without the closing tags: one line for each file.
    text: String,
}

/// The beginning of a collection.
pub(super) const BEGIN: &str = "<?xml version=\"1.0\"?>\n\
                     <VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n\
                     <Collection>\n";

/// The closing tags.
pub(super) const END: &str = "</Collection>\n</VTKFile>\n";

impl Collection {
    /// Creates an empty collection. Overwrites an earlier one.
    ///
    /// # Errors
    /// [`VtkError::Write`] with the path.
    pub fn create(path: &Path) -> Result<Self, VtkError> {
        Self::of(path, &[])
    }

    /// Creates a collection of these times and files. Overwrites an earlier one.
    ///
    /// # Errors
    /// Those of [`Collection::add`].
    pub fn of(path: &Path, entries: &[(f64, PathBuf)]) -> Result<Self, VtkError> {
        let mut collection = Self { path: path.to_owned(), text: BEGIN.to_owned() };
        for (time, file) in entries {
            let entry = collection.entry(*time, file)?;
            collection.text.push_str(&entry);
        }
        collection.write()?;
        Ok(collection)
    }

    /// Adds `file` at the time `time`. The file must lie in the collection's folder or below, so that the
    /// folder can be moved. Both paths must begin alike.
    ///
    /// # Errors
    /// [`VtkError::OutsideFolder`], [`VtkError::Geometry`] for a time that is not finite,
    /// [`VtkError::Write`].
    pub fn add(&mut self, time: f64, file: &Path) -> Result<(), VtkError> {
        let entry = self.entry(time, file)?;
        if self.is_as_written() {
            let failed = |source| WriteError::File { path: self.path.clone(), source };
            self.append(&entry).map_err(failed)?;
            self.text.push_str(&entry);
            return Ok(());
        }
        self.text.push_str(&entry);
        self.write()
    }

    /// Whether the file still exists with its last length.
    fn is_as_written(&self) -> bool {
        let length = (self.text.len() + END.len()) as u64;
        fs::symlink_metadata(&self.path).is_ok_and(|found| found.is_file() && found.len() == length)
    }

    /// Overwrites the closing tags with an entry and the closing tags.
    fn append(&self, entry: &str) -> io::Result<()> {
        let end = self.text.len() as u64;
        let mut file = OpenOptions::new().write(true).open(&self.path)?;
        file.seek(SeekFrom::Start(end))?;
        let written = file.write_all(format!("{entry}{END}").as_bytes());
        if written.is_err() {
            // A full disk still has room for the old content. Report the first error.
            let _ = file.set_len(end).and_then(|()| file.seek(SeekFrom::Start(end)));
            let _ = file.write_all(END.as_bytes());
        }
        written
    }

    fn entry(&self, time: f64, file: &Path) -> Result<String, VtkError> {
        if !time.is_finite() {
            return Err(VtkError::Geometry { path: self.path.clone(), what: "the time", value: time });
        }
        let outside = || VtkError::OutsideFolder { path: self.path.clone(), file: file.to_owned() };
        let folder = self.path.parent().unwrap_or(Path::new(""));
        let relative = file.strip_prefix(folder).map_err(|_| outside())?;
        let mut parts = Vec::new();
        for component in relative.components() {
            match component {
                Component::Normal(part) => parts.push(part.to_str().ok_or_else(outside)?),
                Component::CurDir => {}
                _ => return Err(outside()),
            }
        }
        let name = escaped(&parts.join("/"));
        Ok(format!("<DataSet timestep=\"{time:?}\" part=\"0\" file=\"{name}\"/>\n"))
    }

    fn write(&self) -> Result<(), VtkError> {
        write_atomically(&self.path, |file| write!(file, "{}{END}", self.text))?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn the_collection_is_complete_after_each_addition() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.pvd");
        let mut collection = Collection::create(&path).unwrap();
        assert_eq!(
            fs::read_to_string(&path).unwrap(),
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n\
             <Collection>\n</Collection>\n</VTKFile>\n"
        );
        collection.add(0.0, &folder.path().join("a&b.vtp")).unwrap();
        collection.add(1.118e-5, &folder.path().join("below/c.vtp")).unwrap();
        let text = fs::read_to_string(&path).unwrap();
        let entries: Vec<&str> = text.lines().filter(|line| line.starts_with("<DataSet")).collect();
        assert_eq!(
            entries,
            [
                r#"<DataSet timestep="0.0" part="0" file="a&amp;b.vtp"/>"#,
                r#"<DataSet timestep="1.118e-5" part="0" file="below/c.vtp"/>"#
            ]
        );
        // Writing a collection at once gives the same bytes.
        let files = [(0.0, folder.path().join("a&b.vtp")), (1.118e-5, folder.path().join("below/c.vtp"))];
        Collection::of(&path, &files).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), text);
    }

    /// A file that was cut, removed or replaced is written anew, and not through a link.
    #[test]
    fn what_others_did_to_the_file_is_mended() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.pvd");
        let file = |number: usize| folder.path().join(format!("{number}.vtp"));
        let mut collection = Collection::create(&path).unwrap();
        let other = folder.path().join("other");
        for number in 0..4 {
            match number {
                1 => fs::write(&path, "<?xml").unwrap(),
                2 => fs::remove_file(&path).unwrap(),
                #[cfg(unix)]
                3 => {
                    fs::copy(&path, &other).unwrap();
                    fs::remove_file(&path).unwrap();
                    std::os::unix::fs::symlink(&other, &path).unwrap();
                }
                _ => {}
            }
            collection.add(number as f64, &file(number)).unwrap();
            let entries: Vec<_> = (0..=number).map(|number| (number as f64, file(number))).collect();
            let whole = folder.path().join("whole.pvd");
            Collection::of(&whole, &entries).unwrap();
            assert_eq!(fs::read_to_string(&path).unwrap(), fs::read_to_string(&whole).unwrap());
        }
        assert!(fs::symlink_metadata(&path).unwrap().is_file());
    }

    #[test]
    fn only_files_below_the_collection_are_taken() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.pvd");
        let mut collection = Collection::create(&path).unwrap();
        let error = collection.add(0.0, Path::new("/elsewhere/a.vtp")).unwrap_err();
        assert!(error.to_string().contains("/elsewhere/a.vtp"), "{error}");
        assert!(collection.add(0.0, &folder.path().join("below/../../a.vtp")).is_err());
        assert!(collection.add(f64::INFINITY, &folder.path().join("a.vtp")).is_err());
        assert!(!fs::read_to_string(&path).unwrap().contains("DataSet"));
        collection.add(1.0, &folder.path().join("a.vtp")).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap().matches("DataSet").count(), 1);
    }
}
