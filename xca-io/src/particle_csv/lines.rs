//! The lines of a text file without blank lines and comments, with their line numbers.

use crate::lines::read_line;
use std::io::{self, BufRead, Read};

/// Passes on the lines of `source` that are neither blank nor comments (`#`), each ending in `
/// `. Remembers their line numbers, because a CSV reader counts only the lines that it receives.
pub(super) struct MeaningfulLines<R> {
    source: R,
    /// The line being passed on, and how much of it has been read.
    line: Vec<u8>,
    passed: usize,
    /// Lines read and lines kept so far.
    read: u64,
    kept: u64,
    /// Where lines were skipped. `(k, skipped)`: from the kept line `k` (counted from 1) on, `skipped` lines
    /// in all were left out.
    gaps: Vec<(u64, u64)>,
}

impl<R: BufRead> MeaningfulLines<R> {
    pub(super) fn new(source: R) -> Self {
        Self { source, line: Vec::new(), passed: 0, read: 0, kept: 0, gaps: Vec::new() }
    }

    /// The line number in the source of the kept line `kept`. Both count from 1.
    pub(super) fn number(&self, kept: u64) -> u64 {
        let after = self.gaps.partition_point(|&(first, _)| first <= kept);
        kept + after.checked_sub(1).map_or(0, |gap| self.gaps[gap].1)
    }

    /// Fetches the next kept line. At the end of the source the line stays empty.
    fn advance(&mut self) -> io::Result<()> {
        self.passed = 0;
        loop {
            read_line(&mut self.source, &mut self.line)?;
            if self.line.is_empty() {
                return Ok(());
            }
            self.read += 1;
            let byte_order_mark = b"\xEF\xBB\xBF";
            if self.read == 1 && self.line.starts_with(byte_order_mark) {
                self.line.drain(..byte_order_mark.len());
            }
            let text = self.line.trim_ascii();
            if !text.is_empty() && !text.starts_with(b"#") {
                break;
            }
        }
        self.line.truncate(self.line.trim_ascii_end().len());
        self.line.push(b'\n');
        self.kept += 1;
        let skipped = self.read - self.kept;
        if skipped != self.gaps.last().map_or(0, |gap| gap.1) {
            self.gaps.push((self.kept, skipped));
        }
        Ok(())
    }
}

impl<R: BufRead> Read for MeaningfulLines<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let mut filled = 0;
        while filled < buffer.len() {
            if self.passed == self.line.len() {
                self.advance()?;
                if self.line.is_empty() {
                    break;
                }
            }
            let rest = &self.line[self.passed..];
            let n = rest.len().min(buffer.len() - filled);
            buffer[filled..filled + n].copy_from_slice(&rest[..n]);
            self.passed += n;
            filled += n;
        }
        Ok(filled)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_passed_on_with_their_numbers_in_pieces_of_any_size() {
        let text = b"\xEF\xBB\xBF\n  # c\none\r\ntwo  \n\n\n # c\nthree\nfour";
        for size in [1, 2, 3, 7, 1000] {
            let mut lines = MeaningfulLines::new(&text[..]);
            let mut out = Vec::new();
            let mut buffer = vec![0; size];
            loop {
                match lines.read(&mut buffer).unwrap() {
                    0 => break,
                    n => out.extend_from_slice(&buffer[..n]),
                }
            }
            assert_eq!(out, b"one\ntwo\nthree\nfour\n");
            assert_eq!([1, 2, 3, 4].map(|k| lines.number(k)), [3, 4, 8, 9]);
        }
    }
}
