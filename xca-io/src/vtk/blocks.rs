//! Values as VTK compresses them: in blocks, each a zlib stream of its own.
//!
//! Before the streams stand, as `u64`: how many blocks there are, how long each is before compression, how long the last one is if it is
//! shorter (0 if not), and how long each stream is.

use flate2::Compression;
use flate2::read::ZlibDecoder;
use flate2::write::ZlibEncoder;
use std::io::{self, Read, Write};

/// The name of this form in the head of a file.
pub(super) const COMPRESSOR: &str = "vtkZLibDataCompressor";

/// How many bytes are compressed together.
const BLOCK: usize = 1 << 18;

/// Takes values and compresses them.
#[derive(Default)]
pub(super) struct Blocks {
    /// What is not compressed yet: less than a block.
    pending: Vec<u8>,
    lengths: Vec<u64>,
    streams: Vec<u8>,
}

impl Blocks {
    fn compress(&mut self, block: &[u8]) -> io::Result<()> {
        let before = self.streams.len();
        let mut encoder = ZlibEncoder::new(&mut self.streams, Compression::fast());
        encoder.write_all(block)?;
        encoder.finish()?;
        self.lengths.push((self.streams.len() - before) as u64);
        Ok(())
    }

    /// All that was written, as it stands in a file.
    pub(super) fn finish(mut self) -> io::Result<Vec<u8>> {
        let rest = std::mem::take(&mut self.pending);
        if !rest.is_empty() {
            self.compress(&rest)?;
        }
        let numbers = [self.lengths.len() as u64, BLOCK as u64, rest.len() as u64];
        let numbers = numbers.into_iter().chain(self.lengths);
        let mut bytes: Vec<u8> = numbers.flat_map(u64::to_le_bytes).collect();
        bytes.append(&mut self.streams);
        Ok(bytes)
    }
}

impl Write for Blocks {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let (now, _) = bytes.split_at(bytes.len().min(BLOCK - self.pending.len()));
        self.pending.extend_from_slice(now);
        if self.pending.len() == BLOCK {
            let block = std::mem::take(&mut self.pending);
            self.compress(&block)?;
        }
        Ok(now.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Compressed values that cannot be expanded.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Broken {
    /// The bytes end within them.
    Short,
    /// They are not as many as they should be, or were changed.
    Wrong,
}

/// The `length` bytes of values at the beginning of `bytes`, and what follows them.
pub(super) fn expanded(bytes: &[u8], length: usize) -> Result<(Vec<u8>, &[u8]), Broken> {
    let mut rest = bytes;
    let mut number = || -> Result<usize, Broken> {
        let (first, others) = rest.split_first_chunk().ok_or(Broken::Short)?;
        rest = others;
        usize::try_from(u64::from_le_bytes(*first)).map_err(|_| Broken::Wrong)
    };
    let [count, block, last] = [number()?, number()?, number()?];
    let whole = length.checked_div(block).ok_or(Broken::Wrong)?;
    if length % block != last || whole + usize::from(last > 0) != count {
        return Err(Broken::Wrong);
    }
    let lengths: Vec<usize> = (0..count).map(|_| number()).collect::<Result<_, _>>()?;
    let mut values = Vec::new();
    for (index, stream) in lengths.into_iter().enumerate() {
        let (stream, others) = rest.split_at_checked(stream).ok_or(Broken::Short)?;
        rest = others;
        let wanted = if index < whole { block } else { last };
        let before = values.len();
        // One more than is wanted would be one too many.
        let mut decoder = ZlibDecoder::new(stream).take(wanted as u64 + 1);
        decoder.read_to_end(&mut values).map_err(|_| Broken::Wrong)?;
        if values.len() - before != wanted {
            return Err(Broken::Wrong);
        }
    }
    Ok((values, rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn compressed(values: &[u8]) -> Vec<u8> {
        let mut blocks = Blocks::default();
        blocks.write_all(values).unwrap();
        blocks.finish().unwrap()
    }

    fn numbers(bytes: &[u8], count: usize) -> Vec<u64> {
        bytes.as_chunks().0[..count].iter().map(|number| u64::from_le_bytes(*number)).collect()
    }

    /// Bytes that no compressor makes much of, and some that it does.
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
            assert_eq!(expanded(&bytes, length), Ok((values, &b"after"[..])), "{length}");
        }
    }

    #[test]
    fn what_was_cut_or_changed_is_noticed() {
        let values = values(3000);
        let whole = compressed(&values);
        for length in 0..whole.len() {
            assert_eq!(expanded(&whole[..length], 3000), Err(Broken::Short), "{length}");
        }
        for length in [0, 2999, 3001, BLOCK + 3000] {
            assert_eq!(expanded(&whole, length), Err(Broken::Wrong), "{length}");
        }
        for place in 0..whole.len() {
            let mut changed = whole.clone();
            changed[place] ^= 4;
            // Some bits of a stream mean nothing; then the values are the same.
            if let Ok((found, rest)) = expanded(&changed, 3000) {
                assert!(found == values && rest.is_empty(), "{place}");
            }
        }
    }
}
