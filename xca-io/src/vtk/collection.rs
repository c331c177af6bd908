//! The files of a run with their times.

use std::io::Write;
use std::path::{Component, Path, PathBuf};

use super::super::atomic::write_atomically;
use super::VtkError;
use super::appended::escaped;

/// A ParaView collection (`.pvd`): which file shows which time.
///
/// The file is rewritten whole and atomically after each addition, so ParaView can open it while the run goes on, and
/// after a run that was cut short. A run with particles and dense substates makes one collection of each.
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
    /// One line for each file.
    entries: String,
}

impl Collection {
    /// Makes an empty collection, in place of an earlier one.
    ///
    /// # Errors
    /// [`VtkError::Write`] with the path.
    pub fn create(path: &Path) -> Result<Self, VtkError> {
        Self::of(path, &[])
    }

    /// Makes a collection of these times and files, in place of an earlier one.
    ///
    /// # Errors
    /// As [`Collection::add`].
    pub fn of(path: &Path, entries: &[(f64, PathBuf)]) -> Result<Self, VtkError> {
        let mut collection = Self { path: path.to_owned(), entries: String::new() };
        for (time, file) in entries {
            collection.enter(*time, file)?;
        }
        collection.write()?;
        Ok(collection)
    }

    /// Adds `file`, which shows `time`, and rewrites the collection. The file must lie in the collection's folder or
    /// below, so that the folder can be moved; both paths must begin alike.
    ///
    /// # Errors
    /// [`VtkError::OutsideFolder`], [`VtkError::Geometry`] for a time that is not finite, [`VtkError::Write`].
    pub fn add(&mut self, time: f64, file: &Path) -> Result<(), VtkError> {
        self.enter(time, file)?;
        self.write()
    }

    fn enter(&mut self, time: f64, file: &Path) -> Result<(), VtkError> {
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
        self.entries.push_str(&format!("<DataSet timestep=\"{time:?}\" part=\"0\" file=\"{name}\"/>\n"));
        Ok(())
    }

    fn write(&self) -> Result<(), VtkError> {
        write_atomically(&self.path, |file| {
            write!(
                file,
                "<?xml version=\"1.0\"?>\n\
                 <VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n\
                 <Collection>\n{}</Collection>\n</VTKFile>\n",
                self.entries
            )
        })?;
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
        // A collection that is made at once has the same bytes.
        let files = [(0.0, folder.path().join("a&b.vtp")), (1.118e-5, folder.path().join("below/c.vtp"))];
        Collection::of(&path, &files).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), text);
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
    }
}
