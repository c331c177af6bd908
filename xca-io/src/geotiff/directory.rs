//! Checks the first directory of a TIFF before decoding. The decoder allocates as many values as a tag
//! claims.

use std::io::{self, Read, Seek, SeekFrom};

/// Sizes in bytes: a tag, the offset of a directory, and the number of its tags.
struct Layout {
    tag: usize,
    offset: usize,
    count: usize,
}

const CLASSIC: Layout = Layout { tag: 12, offset: 4, count: 2 };
const BIG: Layout = Layout { tag: 20, offset: 8, count: 8 };

/// Whether a file of `bytes` bytes can hold all values that its tags claim. Returns `true` for a file that is
/// not a TIFF, which the decoder reports.
pub(super) fn fits(file: &mut (impl Read + Seek), bytes: u64) -> io::Result<bool> {
    let result = match find(file)? {
        Some(directory) => directory.fits(file, bytes)?,
        None => true,
    };
    file.seek(SeekFrom::Start(0))?;
    Ok(result)
}

struct Directory {
    is_little: bool,
    layout: Layout,
    tags: u64,
}

/// Goes to the first tag.
fn find(file: &mut (impl Read + Seek)) -> io::Result<Option<Directory>> {
    let mut header = Vec::new();
    file.take(16).read_to_end(&mut header)?;
    let is_little = header.starts_with(b"II");
    let layout = match number(header.get(2..4).unwrap_or_default(), is_little) {
        42 => CLASSIC,
        43 => BIG,
        _ => return Ok(None),
    };
    let place = layout.offset..2 * layout.offset;
    let start = number(header.get(place).unwrap_or_default(), is_little);
    file.seek(SeekFrom::Start(start))?;
    let mut count = Vec::new();
    file.take(layout.count as u64).read_to_end(&mut count)?;
    let tags = number(&count, is_little);
    Ok(Some(Directory { is_little, layout, tags }))
}

impl Directory {
    fn fits(&self, file: &mut impl Read, bytes: u64) -> io::Result<bool> {
        let mut tag = vec![0; self.layout.tag];
        for _ in 0..self.tags {
            match file.read_exact(&mut tag) {
                Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => break,
                result => result?,
            }
            let values = number(&tag[4..4 + self.layout.offset], self.is_little);
            if values > bytes {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

/// Reads an unsigned integer of up to 8 bytes.
fn number(bytes: &[u8], is_little: bool) -> u64 {
    let add = |sum: u64, byte: &u8| sum << 8 | u64::from(*byte);
    if is_little { bytes.iter().rev().fold(0, add) } else { bytes.iter().fold(0, add) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Cursor;

    /// A header and a directory with one tag that claims `values` values.
    fn file(is_little: bool, is_big: bool, values: u32) -> Vec<u8> {
        let number = |value: u64, bytes: usize| -> Vec<u8> {
            let all = value.to_be_bytes();
            let mut bytes = all[8 - bytes..].to_vec();
            if is_little {
                bytes.reverse();
            }
            bytes
        };
        let begin: &[u8] = if is_little { b"II" } else { b"MM" };
        let parts = if is_big {
            vec![number(43, 2), number(8, 2), number(0, 2), number(16, 8), number(1, 8)]
        } else {
            vec![number(42, 2), number(8, 4), number(1, 2)]
        };
        let width = if is_big { 8 } else { 4 };
        let tag = [number(279, 2), number(4, 2), number(values.into(), width), number(0, width)].concat();
        [begin.to_vec(), parts.concat(), tag].concat()
    }

    #[test]
    fn a_tag_has_no_more_values_than_the_file_has_bytes() {
        for is_little in [true, false] {
            for is_big in [true, false] {
                let fits = |values: u32| {
                    let file = file(is_little, is_big, values);
                    let bytes = file.len() as u64;
                    fits(&mut Cursor::new(file), bytes).unwrap()
                };
                assert!(fits(1) && fits(20), "{is_little} {is_big}");
                assert!(!fits(60) && !fits(5_000_000), "{is_little} {is_big}");
            }
        }
        for other in [&b""[..], b"II*", b"no TIFF at all", b"MM\0*\xff\xff\xff\xff"] {
            assert!(fits(&mut Cursor::new(other), other.len() as u64).unwrap());
        }
    }
}
