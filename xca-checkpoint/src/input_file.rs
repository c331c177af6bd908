//! The input files of a set-up, and whether they have changed.

use serde::{Deserialize, Serialize, Serializer};
use std::io::Read;
use std::path::{Path, PathBuf};
use xca_io::regular_file;

/// An input file of a set-up.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct InputFile {
    /// The path as the set-up names it.
    #[serde(serialize_with = "displayed")]
    pub path: PathBuf,
    /// The CRC-32 of its bytes. `None` if the file cannot be read.
    pub crc32: Option<u32>,
}

impl InputFile {
    /// The file with its current checksum.
    pub fn new(path: impl Into<PathBuf>) -> Self {
        let path = path.into();
        Self { crc32: checksum(&path), path }
    }
}

/// A path that is not UTF-8 is written with replacement characters.
fn displayed<S: Serializer>(path: &Path, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(&path.display())
}

fn checksum(path: &Path) -> Option<u32> {
    let mut file = regular_file::open(path).ok()?;
    let mut sum = crc32fast::Hasher::new();
    let mut bytes = vec![0; 1 << 16];
    loop {
        match file.read(&mut bytes).ok()? {
            0 => return Some(sum.finalize()),
            count => sum.update(&bytes[..count]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_checksum_is_that_of_all_bytes() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("grid");
        assert_eq!(InputFile::new(&path).crc32, None);
        // The check value of CRC-32, and the checksum of 200,000 bytes by Python's zlib.
        std::fs::write(&path, "123456789").unwrap();
        assert_eq!(InputFile::new(&path).crc32, Some(0xcbf4_3926));
        std::fs::write(&path, vec![7; 200_000]).unwrap();
        assert_eq!(InputFile::new(&path).crc32, Some(0x98bd9e80));
        let file = InputFile::new(&path);
        let text = serde_json::to_string(&file).unwrap();
        assert_eq!(serde_json::from_str::<InputFile>(&text).unwrap(), file);
    }
}
