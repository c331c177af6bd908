//! The largest expansion of a zlib stream, as in PNG and VTK files.

/// The largest factor by which a stream grows when it is expanded: two bits become 258 bytes.
pub const MOST_GROWTH: u64 = 1032;

/// Whether `compressed` bytes of a stream can become `expanded` bytes of values. Check before allocating: the
/// header of a short file may claim any size.
#[must_use]
pub fn can_hold(compressed: u64, expanded: u64) -> bool {
    compressed.saturating_mul(MOST_GROWTH) >= expanded
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::Compression;
    use flate2::write::ZlibEncoder;
    use std::io::Write;

    #[test]
    fn nothing_compresses_better_than_zeros() {
        for length in [0, 1, 1000, 1 << 20, 1 << 24] {
            let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
            encoder.write_all(&vec![0; length]).unwrap();
            let compressed = encoder.finish().unwrap().len() as u64;
            assert!(can_hold(compressed, length as u64), "{length}: {compressed}");
        }
        assert!(!can_hold(69, 11_000_000_000));
        assert!(can_hold(u64::MAX, u64::MAX));
    }
}
