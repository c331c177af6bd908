//! Files with compressed or summed parts, taken to pieces and put together again.

use crate::Mutator;
use flate2::Compression;
use flate2::read::ZlibDecoder;
use flate2::write::ZlibEncoder;
use std::io::{Read, Write};

/// A valid file in its parts.
pub trait Container {
    /// The file, damaged in its parts or as a whole.
    fn damaged(&self, mutator: &mut Mutator) -> Vec<u8>;
}

/// A file without parts: a text.
impl Container for Vec<u8> {
    fn damaged(&self, mutator: &mut Mutator) -> Vec<u8> {
        let mut bytes = self.clone();
        mutator.mutate(&mut bytes);
        bytes
    }
}

/// Where `wanted` begins in `bytes`.
fn find(bytes: &[u8], wanted: &[u8]) -> Option<usize> {
    bytes.windows(wanted.len()).position(|window| window == wanted)
}

/// A file with a checksum behind a description and data, each of a length that the first line tells.
#[derive(Debug, Clone)]
pub struct Checkpoint {
    description: Vec<u8>,
    data: Vec<u8>,
}

impl Checkpoint {
    /// The parts of a valid checkpoint; none where it is not one.
    pub fn new(bytes: &[u8]) -> Option<Self> {
        let (line, rest) = bytes.split_at_checked(find(bytes, b"\n")? + 1)?;
        let length = std::str::from_utf8(line).ok()?.split(' ').nth(2)?.parse().ok()?;
        let (description, rest) = rest.split_at_checked(length)?;
        let data = rest.get(..rest.len().checked_sub(4)?)?;
        Some(Self { description: description.to_vec(), data: data.to_vec() })
    }

    /// The file, with the checksum of its parts.
    fn whole(&self) -> Vec<u8> {
        let line = format!("xca-checkpoint 1 {} {}\n", self.description.len(), self.data.len());
        let mut bytes = [line.as_bytes(), &self.description, &self.data].concat();
        bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
        bytes
    }
}

impl Container for Checkpoint {
    fn damaged(&self, mutator: &mut Mutator) -> Vec<u8> {
        let mut parts = self.clone();
        match mutator.below(8) {
            0 => return self.whole().damaged(mutator),
            1 => mutator.mutate(&mut parts.data),
            2 | 3 => mutator.overwrite(&mut parts.data),
            _ => mutator.mutate(&mut parts.description),
        }
        parts.whole()
    }
}

/// A VTK file: lines of XML, and arrays of values that are compressed.
#[derive(Debug, Clone)]
pub struct Vtk {
    head: Vec<u8>,
    arrays: Vec<Vec<u8>>,
}

const DATA: &[u8] = b"<AppendedData encoding=\"raw\">\n_";
const END: &[u8] = b"\n</AppendedData>\n</VTKFile>\n";
const OFFSET: &str = " offset=\"";

impl Vtk {
    /// The parts of a valid file; none where it is not one.
    pub fn new(bytes: &[u8]) -> Option<Self> {
        let (head, rest) = bytes.split_at_checked(find(bytes, DATA)?)?;
        let mut rest = rest.strip_prefix(DATA)?.strip_suffix(END)?;
        let mut arrays = Vec::new();
        while !rest.is_empty() {
            let number = |place: usize| -> Option<usize> {
                let bytes = rest.get(8 * place..8 * place + 8)?;
                usize::try_from(u64::from_le_bytes(bytes.try_into().ok()?)).ok()
            };
            let count = number(0)?;
            let lengths = (0..count).map(|block| number(3 + block)).collect::<Option<Vec<_>>>()?;
            rest = rest.get(8 * (3 + count)..)?;
            let mut array = Vec::new();
            for length in lengths {
                let (stream, others) = rest.split_at_checked(length)?;
                ZlibDecoder::new(stream).read_to_end(&mut array).ok()?;
                rest = others;
            }
            arrays.push(array);
        }
        Some(Self { head: head.to_vec(), arrays })
    }

    /// The file. `skew` may change the numbers before the streams of an array.
    fn whole(&self, mut skew: impl FnMut(&mut [u64])) -> Vec<u8> {
        const BLOCK: usize = 1 << 18;
        let mut data = Vec::new();
        let mut offsets = Vec::new();
        for array in &self.arrays {
            offsets.push(data.len());
            let blocks: Vec<Vec<u8>> = array.chunks(BLOCK).map(compressed).collect();
            let before = [blocks.len(), BLOCK, array.len() % BLOCK].into_iter();
            let mut numbers: Vec<u64> =
                before.chain(blocks.iter().map(Vec::len)).map(|number| number as u64).collect();
            skew(&mut numbers);
            data.extend(numbers.into_iter().flat_map(u64::to_le_bytes));
            data.extend(blocks.concat());
        }
        [&with_offsets(&self.head, &offsets), DATA, &data, END].concat()
    }
}

fn compressed(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
    // Writing to memory cannot fail.
    let _ = encoder.write_all(bytes);
    encoder.finish().unwrap_or_default()
}

/// The lines of XML with the places at which arrays begin now.
fn with_offsets(head: &[u8], offsets: &[usize]) -> Vec<u8> {
    let mut rest = head;
    let mut out = Vec::new();
    let mut offsets = offsets.iter();
    while let Some(at) = find(rest, OFFSET.as_bytes()) {
        let (before, after) = rest.split_at(at + OFFSET.len());
        out.extend(before);
        let digits = after.iter().take_while(|byte| byte.is_ascii_digit()).count();
        match offsets.next() {
            Some(offset) => out.extend(offset.to_string().into_bytes()),
            None => out.extend(&after[..digits]),
        }
        rest = &after[digits..];
    }
    out.extend(rest);
    out
}

impl Container for Vtk {
    fn damaged(&self, mutator: &mut Mutator) -> Vec<u8> {
        let mut parts = self.clone();
        match mutator.below(8) {
            0 => return self.whole(|_| {}).damaged(mutator),
            1 => {
                let array = mutator.below(parts.arrays.len());
                mutator.mutate(&mut parts.arrays[array]);
            }
            2 | 3 => {
                let array = mutator.below(parts.arrays.len());
                mutator.overwrite(&mut parts.arrays[array]);
            }
            4 => {
                return self.whole(|numbers| {
                    if mutator.below(3) == 0 {
                        let place = mutator.below(numbers.len());
                        numbers[place] = mutator.edge();
                    }
                });
            }
            _ => mutator.mutate(&mut parts.head),
        }
        parts.whole(|_| {})
    }
}

/// A PNG picture: chunks, each with a name and a checksum.
#[derive(Debug, Clone)]
pub struct Png {
    chunks: Vec<Vec<u8>>,
}

const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";

impl Png {
    /// The chunks of a valid picture; none where it is not one.
    pub fn new(bytes: &[u8]) -> Option<Self> {
        let mut rest = bytes.strip_prefix(SIGNATURE)?;
        let mut chunks = Vec::new();
        while let Some((length, others)) = rest.split_first_chunk() {
            let (chunk, others) = others.split_at_checked(u32::from_be_bytes(*length) as usize + 4)?;
            chunks.push(chunk.to_vec());
            rest = others.get(4..)?;
        }
        Some(Self { chunks })
    }

    fn whole(&self) -> Vec<u8> {
        let chunk = |chunk: &Vec<u8>| {
            let length = (chunk.len().saturating_sub(4) as u32).to_be_bytes();
            [&length, chunk.as_slice(), &crc32fast::hash(chunk).to_be_bytes()].concat()
        };
        [SIGNATURE, &self.chunks.iter().flat_map(chunk).collect::<Vec<_>>()].concat()
    }
}

impl Container for Png {
    fn damaged(&self, mutator: &mut Mutator) -> Vec<u8> {
        let mut parts = self.clone();
        match mutator.below(5) {
            0 => return self.whole().damaged(mutator),
            1 => {
                // Width or height, behind the name of the first chunk.
                let (at, number) = (4 + 4 * mutator.below(2), mutator.edge() as u32);
                parts.chunks[0].splice(at..at + 4, number.to_be_bytes());
            }
            2 => {
                let (one, other) = (mutator.below(parts.chunks.len()), mutator.below(parts.chunks.len()));
                parts.chunks.swap(one, other);
            }
            _ => {
                let chunk = mutator.below(parts.chunks.len());
                mutator.mutate(&mut parts.chunks[chunk]);
            }
        }
        parts.whole()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_taken_to_pieces_is_the_same_when_it_is_put_together() {
        let text = b"<A offset=\"5\"/><B offset=\"7\"/>\n".to_vec();
        let vtk = Vtk { head: text, arrays: vec![vec![7; 300_000], Vec::new()] };
        let whole = vtk.whole(|_| {});
        let again = Vtk::new(&whole).map(|parts| parts.whole(|_| {}));
        assert_eq!(again.as_ref(), Some(&whole));
        let checkpoint = Checkpoint { description: b"{}".to_vec(), data: vec![1, 2] };
        let whole = checkpoint.whole();
        assert_eq!(Checkpoint::new(&whole).map(|parts| parts.whole()), Some(whole));
        let png = Png { chunks: vec![b"IHDR1234".to_vec(), b"IEND".to_vec()] };
        assert_eq!(Png::new(&png.whole()).map(|parts| parts.whole()), Some(png.whole()));
    }
}
