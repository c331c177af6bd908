//! Compression of values as in VTK: in blocks, each its own zlib stream.
//!
//! A header of `u64` numbers comes before the streams:
//!
//! 1. the number of blocks
//! 2. the uncompressed length of a block
//! 3. the uncompressed length of the last block if it is shorter, otherwise 0
//! 4. the length of each stream

use crate::deflate::can_hold;
use flate2::Compression;
use flate2::read::ZlibDecoder;
use flate2::write::ZlibEncoder;
use std::io::{self, Read, Seek, SeekFrom, Write};

/// The name of this compression in the head of a file.
pub(super) const COMPRESSOR: &str = "vtkZLibDataCompressor";

/// The uncompressed length of a block in bytes.
const BLOCK: usize = 1 << 18;

/// A compressor of values, which writes each block once it is complete.
pub(super) struct Blocks<'a, W> {
    out: &'a mut W,
    /// Bytes that are not compressed yet: less than a block.
    pending: Vec<u8>,
    /// The number of uncompressed bytes that are still to come.
    left: usize,
    /// The header. The lengths of streams are added one by one.
    header: Vec<u64>,
    /// The number of bytes of the header in the file, and of all streams so far.
    room: u64,
    written: u64,
}

impl<'a, W: Write + Seek> Blocks<'a, W> {
    /// Begins with `length` bytes of values at the present place of a file, and leaves room for the header.
    pub(super) fn new(out: &'a mut W, length: usize) -> io::Result<Self> {
        let count = length.div_ceil(BLOCK);
        let header = [count, BLOCK, length % BLOCK].map(|number| number as u64).to_vec();
        let room = (header.len() + count) * size_of::<u64>();
        io::copy(&mut io::repeat(0).take(room as u64), out)?;
        Ok(Self { out, pending: Vec::new(), left: length, header, room: room as u64, written: 0 })
    }

    fn compress(&mut self) -> io::Result<()> {
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
        encoder.write_all(&self.pending)?;
        let stream = encoder.finish()?;
        self.pending.clear();
        self.out.write_all(&stream)?;
        self.header.push(stream.len() as u64);
        self.written += stream.len() as u64;
        Ok(())
    }

    /// Completes the header. Returns the number of bytes that all take in the file.
    pub(super) fn finish(mut self) -> io::Result<u64> {
        if self.left > 0 {
            return Err(wrong_length());
        }
        if !self.pending.is_empty() {
            self.compress()?;
        }
        let header: Vec<u8> = self.header.iter().flat_map(|number| number.to_le_bytes()).collect();
        let all = self.room + self.written;
        let back = |bytes: u64| i64::try_from(bytes).map_err(io::Error::other);
        self.out.seek(SeekFrom::Current(-back(all)?))?;
        self.out.write_all(&header)?;
        self.out.seek(SeekFrom::Current(back(self.written)?))?;
        Ok(all)
    }
}

fn wrong_length() -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, "a source of values did not give as many as it said")
}

impl<W: Write + Seek> Write for Blocks<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let (now, _) = bytes.split_at(bytes.len().min(BLOCK - self.pending.len()));
        self.left = self.left.checked_sub(now.len()).ok_or_else(wrong_length)?;
        self.pending.extend_from_slice(now);
        if self.pending.len() == BLOCK {
            self.compress()?;
        }
        Ok(now.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// The longest stream of a block in bytes. Incompressible data grows by a few bytes.
const LONGEST_STREAM: usize = BLOCK + BLOCK / 64 + 64;

/// Compressed values that cannot be expanded.
#[derive(Debug)]
pub(super) enum Broken {
    /// The file ends within the values.
    Short,
    /// The number of bytes is wrong, or the data was changed.
    Wrong,
    /// The system returned an error.
    Read(io::Error),
}

/// Consecutive bytes of a file.
pub(super) struct Source<R> {
    file: R,
    /// The number of bytes left.
    left: u64,
}

impl<R: Read> Source<R> {
    /// The next `left` bytes of a file.
    pub(super) fn new(file: R, left: u64) -> Self {
        Self { file, left }
    }

    /// The number of bytes left.
    pub(super) fn left(&self) -> u64 {
        self.left
    }

    /// Fills a buffer with the next bytes.
    pub(super) fn fill(&mut self, buffer: &mut [u8]) -> Result<(), Broken> {
        self.left = self.left.checked_sub(buffer.len() as u64).ok_or(Broken::Short)?;
        self.file.read_exact(buffer).map_err(|error| match error.kind() {
            io::ErrorKind::UnexpectedEof => Broken::Short,
            _ => Broken::Read(error),
        })
    }

    fn number(&mut self) -> Result<u64, Broken> {
        let mut bytes = [0; 8];
        self.fill(&mut bytes)?;
        Ok(u64::from_le_bytes(bytes))
    }

    /// Reads the lengths of the streams for `length` bytes of values.
    fn lengths(&mut self, length: usize) -> Result<Vec<usize>, Broken> {
        let [count, block, last] = [self.number()?, self.number()?, self.number()?];
        let wanted = [length.div_ceil(BLOCK), BLOCK, length % BLOCK].map(|number| number as u64);
        if [count, block, last] != wanted {
            return Err(Broken::Wrong);
        }
        if count > self.left / 8 {
            return Err(Broken::Short);
        }
        let mut lengths = Vec::new();
        for index in 0..length.div_ceil(BLOCK) {
            let expanded = (length - index * BLOCK).min(BLOCK) as u64;
            let stream = self.number()?;
            if stream > LONGEST_STREAM as u64 || !can_hold(stream, expanded) {
                return Err(Broken::Wrong);
            }
            lengths.push(stream as usize);
        }
        if lengths.iter().map(|stream| *stream as u64).sum::<u64>() > self.left {
            return Err(Broken::Short);
        }
        Ok(lengths)
    }

    /// Expands the next values, which are `length` bytes. Memory holds at most these bytes and one block.
    pub(super) fn expanded(&mut self, length: usize) -> Result<Vec<u8>, Broken> {
        let lengths = self.lengths(length)?;
        let mut values = Vec::with_capacity(length);
        let mut stream = Vec::new();
        for compressed in lengths {
            stream.resize(compressed, 0);
            self.fill(&mut stream)?;
            let wanted = (length - values.len()).min(BLOCK);
            let before = values.len();
            let mut decoder = ZlibDecoder::new(stream.as_slice());
            let read = decoder.by_ref().take(wanted as u64).read_to_end(&mut values);
            read.map_err(|_| Broken::Wrong)?;
            // Reading one more byte checks the checksum at the end of the stream. A byte more would be an
            // error.
            let is_over = matches!(decoder.read(&mut [0]), Ok(0));
            if values.len() - before != wanted || !is_over {
                return Err(Broken::Wrong);
            }
        }
        Ok(values)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn compressed(values: &[u8]) -> Vec<u8> {
        let mut file = io::Cursor::new(Vec::new());
        // What stands before the values stays.
        file.write_all(b"head").unwrap();
        let mut blocks = Blocks::new(&mut file, values.len()).unwrap();
        blocks.write_all(values).unwrap();
        let length = blocks.finish().unwrap();
        let end = file.position();
        let file = file.into_inner();
        assert_eq!((end, &file[..4], file.len() as u64), (4 + length, &b"head"[..], 4 + length));
        file[4..].to_vec()
    }

    #[test]
    fn a_source_that_gives_other_numbers_of_values_is_refused() {
        for (said, given) in
            [(BLOCK + 3, BLOCK + 2), (BLOCK + 3, BLOCK + 4), (0, 1), (1, 0), (BLOCK, BLOCK + 1)]
        {
            let mut file = io::Cursor::new(Vec::new());
            let mut blocks = Blocks::new(&mut file, said).unwrap();
            let written = blocks.write_all(&vec![1; given]);
            let written = written.and_then(|()| blocks.finish().map(drop));
            assert_eq!(written.unwrap_err().kind(), io::ErrorKind::InvalidData, "{said} {given}");
        }
    }

    fn numbers(bytes: &[u8], count: usize) -> Vec<u64> {
        bytes.as_chunks().0[..count].iter().map(|number| u64::from_le_bytes(*number)).collect()
    }

    /// Returns the expanded values and the bytes after them.
    fn expanded(bytes: &[u8], length: usize) -> Result<(Vec<u8>, Vec<u8>), Broken> {
        let mut source = Source::new(bytes, bytes.len() as u64);
        let values = source.expanded(length)?;
        let mut rest = vec![0; source.left() as usize];
        source.fill(&mut rest)?;
        Ok((values, rest))
    }

    /// Bytes that compress badly, followed by bytes that compress well.
    fn values(length: usize) -> Vec<u8> {
        (0..length as u64)
            .map(|i| if i < 1000 { 0 } else { ((i * i).wrapping_mul(2_654_435_761_987) >> 23) as u8 })
            .collect()
    }

    #[test]
    fn the_lengths_are_those_of_the_format() {
        let block = BLOCK as u64;
        assert_eq!(numbers(&compressed(&[]), 3), [0, block, 0]);
        assert_eq!(compressed(&[]).len(), 24);
        for (length, wanted) in [
            (1, [1, block, 1]),
            (BLOCK, [1, block, 0]),
            (BLOCK + 7, [2, block, 7]),
            (2 * BLOCK, [2, block, 0]),
        ] {
            let bytes = compressed(&values(length));
            assert_eq!(numbers(&bytes, 3), wanted, "{length}");
            let count = wanted[0] as usize;
            let lengths = numbers(&bytes, 3 + count).split_off(3);
            assert_eq!(24 + 8 * count as u64 + lengths.iter().sum::<u64>(), bytes.len() as u64);
        }
    }

    #[test]
    fn values_come_back() {
        for length in [0, 1, 5000, BLOCK - 1, BLOCK, BLOCK + 1, 3 * BLOCK + 17] {
            let values = values(length);
            let bytes = [compressed(&values), b"after".to_vec()].concat();
            assert_eq!(expanded(&bytes, length).unwrap(), (values, b"after".to_vec()), "{length}");
        }
    }

    #[test]
    fn what_was_cut_or_changed_is_noticed() {
        let values = values(3000);
        let whole = compressed(&values);
        for length in 0..whole.len() {
            assert!(matches!(expanded(&whole[..length], 3000), Err(Broken::Short)), "{length}");
        }
        for length in [0, 2999, 3001, BLOCK + 3000] {
            assert!(matches!(expanded(&whole, length), Err(Broken::Wrong)), "{length}");
        }
        for place in 0..whole.len() {
            let mut changed = whole.clone();
            changed[place] ^= 4;
            // Some bits of a stream have no meaning. Then the values are the same.
            if let Ok((found, rest)) = expanded(&changed, 3000) {
                assert!(found == values && rest.is_empty(), "{place}");
            }
        }
    }

    #[test]
    fn what_a_stream_cannot_hold_is_refused_before_there_is_room_for_it() {
        let short = compressed(&[7; 100]);
        for length in [1 << 20, 1 << 40, usize::MAX / 2] {
            assert!(matches!(expanded(&short, length), Err(Broken::Wrong)), "{length}");
            // The same, with a matching header and streams of length 0.
            let count = length.div_ceil(BLOCK) as u64;
            let header = [count, BLOCK as u64, (length % BLOCK) as u64].map(u64::to_le_bytes).concat();
            let streams = vec![0; 8 * count.min(1000) as usize];
            let bytes = [header, streams].concat();
            let mut source = Source::new(bytes.as_slice(), bytes.len() as u64);
            assert!(source.lengths(length).is_err(), "{length}");
        }
    }
}
