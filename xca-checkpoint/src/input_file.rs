//! The files that a set-up has read, and whether they are still the same.

use serde::{Deserialize, Serialize, Serializer};
use std::io::Read;
use std::path::{Path, PathBuf};
use xca_io::regular_file;

/// A file that a set-up has read.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct InputFile {
    /// As the set-up names it.
    #[serde(serialize_with = "displayed")]
    pub path: PathBuf,
    /// The CRC-32 of its bytes; none of a file that cannot be read.
    pub crc32: Option<u32>,
}

impl InputFile {
    /// The file with the checksum that it has now.
    pub fn new(path: impl Into<PathBuf>) -> Self {
        let path = path.into();
        Self { crc32: checksum(&path), path }
    }
}

/// A path that is no UTF-8 is not worth failing for.
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
        // The check value of CRC-32, and the sum of 200,000 bytes as Python's zlib has it.
        std::fs::write(&path, "123456789").unwrap();
        assert_eq!(InputFile::new(&path).crc32, Some(0xcbf4_3926));
        std::fs::write(&path, vec![7; 200_000]).unwrap();
        assert_eq!(InputFile::new(&path).crc32, Some(0x98bd9e80));
        let file = InputFile::new(&path);
        let text = serde_json::to_string(&file).unwrap();
        assert_eq!(serde_json::from_str::<InputFile>(&text).unwrap(), file);
    }
}
