//! The reader of collections.

use super::super::collection::{BEGIN, END};
use super::element::attribute;
use super::{ReadVtkError, foreign};
use crate::lines::read_line;
use crate::regular_file;
use std::io::BufReader;
use std::path::{Component, Path, PathBuf};

/// A file that a collection lists.
#[derive(Debug, Clone, PartialEq)]
pub struct ListedFile {
    /// The simulated time of the file.
    pub time: f64,
    /// The path of the file, including the folder of the collection.
    pub path: PathBuf,
}

/// Reads the list of files of a collection (`.pvd`), in its order.
///
/// # Errors
/// [`ReadVtkError`] if [`super::super::Collection`] has not written the file, or if it lists a file outside
/// its folder.
pub fn read_collection(path: &Path) -> Result<Vec<ListedFile>, ReadVtkError> {
    let failed = |source| ReadVtkError::Read { path: path.to_owned(), source };
    let mut source = BufReader::new(regular_file::open(path).map_err(failed)?);
    let (mut line, mut found) = (Vec::new(), 0);
    let mut next = || -> Result<String, ReadVtkError> {
        read_line(&mut source, &mut line).map_err(failed)?;
        found += line.len();
        if line.is_empty() {
            return Err(ReadVtkError::Truncated { path: path.to_owned(), found });
        }
        String::from_utf8(line.clone()).map_err(|_| foreign(path, "it is not text"))
    };
    for wanted in BEGIN.split_inclusive('\n') {
        let line = next()?;
        if line != wanted {
            return Err(foreign(path, "its first lines differ"));
        }
    }
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut files = Vec::new();
    let mut end = END.split_inclusive('\n');
    let mut wanted = end.next();
    while let Some(tag) = wanted {
        let line = next()?;
        if line == tag {
            wanted = end.next();
        } else {
            let listed = listed(folder, &line).filter(|_| tag == END_OF_LIST);
            files.push(listed.ok_or_else(|| foreign(path, "one of its entries is invalid"))?);
        }
    }
    read_line(&mut source, &mut line).map_err(failed)?;
    if line.is_empty() { Ok(files) } else { Err(foreign(path, "it continues where it should end")) }
}

/// The first closing tag.
const END_OF_LIST: &str = "</Collection>\n";

/// The file of an entry. `None` if the line is not an entry.
fn listed(folder: &Path, line: &str) -> Option<ListedFile> {
    let entry = line.strip_suffix("/>\n").filter(|entry| entry.starts_with("<DataSet "))?;
    let time: f64 = attribute(entry, "timestep")?.parse().ok().filter(|time: &f64| time.is_finite())?;
    let name = PathBuf::from(attribute(entry, "file")?);
    let is_below = name.components().all(|part| matches!(part, Component::Normal(_)));
    (is_below && name.file_name().is_some()).then(|| ListedFile { time, path: folder.join(name) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vtk::Collection;
    use std::fs;

    #[test]
    fn what_is_listed_is_read_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.pvd");
        let mut collection = Collection::create(&path).unwrap();
        assert_eq!(read_collection(&path).unwrap(), []);
        let files = [(0.0, "a&b \"1\".vtp"), (1.118e-5, "below/c.vtp"), (-2.5, "ä.vti")];
        let files = files.map(|(time, name)| ListedFile { time, path: folder.path().join(name) });
        for ListedFile { time, path } in &files {
            collection.add(*time, path).unwrap();
        }
        assert_eq!(read_collection(&path).unwrap(), files);
    }

    #[test]
    fn other_files_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.pvd");
        let mut collection = Collection::create(&path).unwrap();
        collection.add(0.5, &folder.path().join("a.vtp")).unwrap();
        let whole = fs::read_to_string(&path).unwrap();
        let error = |text: &str| {
            fs::write(&path, text).unwrap();
            read_collection(&path).unwrap_err().to_string()
        };
        for (from, to, wanted) in [
            ("version=\"0.1\"", "version=\"0.2\"", "its first lines"),
            ("\"0.5\"", "\"half\"", "one of its entries"),
            ("\"0.5\"", "\"inf\"", "one of its entries"),
            ("file=\"a.vtp\"", "file=\"../a.vtp\"", "one of its entries"),
            ("file=\"a.vtp\"", "file=\"/etc/passwd\"", "one of its entries"),
            ("file=\"a.vtp\"", "file=\"\"", "one of its entries"),
            ("file=\"a.vtp\"", "name=\"a.vtp\"", "one of its entries"),
            (
                "</Collection>\n",
                "</Collection>\n<DataSet timestep=\"1\" file=\"b\"/>\n",
                "one of its entries",
            ),
            ("</VTKFile>\n", "</VTKFile>\n\n", "it continues"),
        ] {
            assert_eq!(whole.matches(from).count(), 1, "{from}");
            let said = error(&whole.replace(from, to));
            assert!(said.contains(wanted), "{to}: {said}");
        }
        for end in whole.match_indices('\n') {
            if end.0 + 1 < whole.len() {
                let said = error(&whole[..=end.0]);
                assert!(said.contains("is truncated"), "{said}");
            }
        }
        assert!(error(&format!("{}{}", whole, "\n").repeat(2)).contains("it continues"));
        let long = format!("{BEGIN}<DataSet timestep=\"0\" file=\"{}\"/>\n{END}", "a".repeat(1 << 25));
        fs::write(&path, long).unwrap();
        let error = read_collection(&path).unwrap_err();
        let ReadVtkError::Read { source, .. } = error else { panic!("{error}") };
        assert!(source.to_string().contains("longer than 16 MiB"), "{source}");
    }
}
