//! Values as VTK's zlib compressor stores them.

use flate2::Compression;
use flate2::write::ZlibEncoder;
use std::io::{self, Write};

/// How many bytes are compressed at once, so that a reader can decompress on all its cores.
const BLOCK: usize = 1 << 20;

/// Takes values, and keeps them compressed.
///
/// VTK's layout, in 64-bit numbers: how many blocks there are, the bytes of a full one and of the last one if that is not full, before they
/// were compressed; then the compressed bytes of each; then the blocks.
#[derive(Default)]
pub(super) struct Compressed {
    blocks: Vec<u8>,
    lengths: Vec<u64>,
    /// The bytes of a block that is not full.
    pending: Vec<u8>,
}

impl Compressed {
    /// The layout above, after all values were written.
    pub(super) fn finish(mut self) -> io::Result<Vec<u8>> {
        let partial = self.pending.len();
        if partial > 0 {
            self.compress()?;
        }
        let header = [self.lengths.len() as u64, BLOCK as u64, partial as u64];
        let mut bytes = Vec::with_capacity(8 * (header.len() + self.lengths.len()) + self.blocks.len());
        bytes.extend(header.iter().chain(&self.lengths).flat_map(|number| number.to_le_bytes()));
        bytes.append(&mut self.blocks);
        Ok(bytes)
    }

    /// Compresses the bytes that wait. Little is gained by trying harder: most digits of most numbers have no pattern.
    fn compress(&mut self) -> io::Result<()> {
        let before = self.blocks.len();
        let mut encoder = ZlibEncoder::new(&mut self.blocks, Compression::fast());
        encoder.write_all(&self.pending)?;
        encoder.finish()?;
        self.lengths.push((self.blocks.len() - before) as u64);
        self.pending.clear();
        Ok(())
    }
}

impl Write for Compressed {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let taken = bytes.len().min(BLOCK - self.pending.len());
        self.pending.extend_from_slice(&bytes[..taken]);
        if self.pending.len() == BLOCK {
            self.compress()?;
        }
        Ok(taken)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::vtk::reading::decompressed;

    #[test]
    fn blocks_are_full_but_the_last() {
        for (length, blocks, partial) in [
            (0, 0, 0),
            (1, 1, 1),
            (BLOCK - 1, 1, BLOCK - 1),
            (BLOCK, 1, 0),
            (BLOCK + 1, 2, 1),
            (3 * BLOCK, 3, 0),
        ] {
            let values: Vec<u8> = (0..length).map(|index| (index % 251) as u8).collect();
            let mut compressed = Compressed::default();
            for part in values.chunks(300_007) {
                compressed.write_all(part).unwrap();
            }
            let bytes = compressed.finish().unwrap();
            let header: Vec<u64> =
                bytes.as_chunks().0[..3].iter().map(|number| u64::from_le_bytes(*number)).collect();
            assert_eq!(header, [blocks, BLOCK as u64, partial as u64], "{length}");
            assert!(decompressed(&bytes) == values, "{length}");
        }
    }
}
