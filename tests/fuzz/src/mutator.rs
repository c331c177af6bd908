//! Mutations of bytes and texts.

use fastrand::Rng;
use std::ops::Range;

/// Numbers at the edge of what a reader may expect.
const NUMBERS: [&str; 16] = [
    "0",
    "-0",
    "1",
    "-1",
    "255",
    "256",
    "65536",
    "4294967295",
    "4294967296",
    "18446744073709551615",
    "18446744073709551616",
    "9007199254740993",
    "nan",
    "-inf",
    "1e309",
    "5e-324",
];

/// Bytes that mean something to some format.
const BYTES: &[u8] = b"\0\n\r\t \"',;:=#<>[]{}()\\/-+.eE0179\x7f\x80\xc3\xff";

/// No mutation makes a file longer than this, in bytes.
const LONGEST: usize = 1 << 16;

/// A source of mutations. The same seed gives the same ones.
#[derive(Debug)]
pub struct Mutator {
    random: Rng,
    words: &'static [&'static str],
}

impl Mutator {
    /// A mutator that knows these words of a format.
    pub fn new(seed: u64, words: &'static [&'static str]) -> Self {
        Self { random: Rng::with_seed(seed), words }
    }

    /// A number below `end`; 0 if that is 0.
    pub fn below(&mut self, end: usize) -> usize {
        self.random.usize(..end.max(1))
    }

    /// A number of 64 bits from the edges of what a header may say.
    pub fn edge(&mut self) -> u64 {
        let low = self.random.u64(..4);
        match self.below(6) {
            0 => low,
            1 => u64::MAX - low,
            2 => (1 << self.random.u32(..64)) - low.min(1),
            3 => u64::from(u32::MAX) + low,
            4 => i64::MAX as u64 - low,
            _ => self.random.u64(..100_000),
        }
    }

    /// Damages bytes in one to four ways.
    pub fn mutate(&mut self, bytes: &mut Vec<u8>) {
        for _ in 0..=self.below(4) {
            self.mutate_once(bytes);
            bytes.truncate(LONGEST);
        }
    }

    /// Puts other values in place of some bytes, as many as there were.
    pub fn overwrite(&mut self, bytes: &mut [u8]) {
        for _ in 0..=self.below(4) {
            let (at, value) = (self.below(bytes.len()), self.edge().to_le_bytes());
            let length = 1 + self.below(value.len());
            bytes[at..].iter_mut().zip(&value[..length]).for_each(|(byte, other)| *byte = *other);
        }
    }

    fn mutate_once(&mut self, bytes: &mut Vec<u8>) {
        match self.below(12) {
            0 => self.flip(bytes),
            1 => bytes.truncate(self.below(bytes.len() + 1)),
            2 => {
                let span = self.span(bytes.len(), 40);
                bytes.drain(span);
            }
            3 => self.repeat(bytes),
            4 => {
                let at = self.below(bytes.len() + 1);
                bytes.insert(at, BYTES[self.random.usize(..BYTES.len())]);
            }
            5 => self.swap_lines(bytes),
            6 | 7 => self.replace_word(bytes),
            8 => self.insert_word(bytes),
            _ => self.replace_number(bytes),
        }
    }

    fn flip(&mut self, bytes: &mut [u8]) {
        let at = self.below(bytes.len());
        if let Some(byte) = bytes.get_mut(at) {
            *byte ^= 1 << self.random.u32(..8);
        }
    }

    /// A range of at most `longest` places among `length`.
    fn span(&mut self, length: usize, longest: usize) -> Range<usize> {
        let start = self.below(length + 1);
        start..(start + self.below(longest + 1)).min(length)
    }

    /// Doubles a span, or repeats it a great many times.
    fn repeat(&mut self, bytes: &mut Vec<u8>) {
        let span = self.span(bytes.len(), 60);
        let times = if self.below(8) == 0 { 1 + self.below(3000) } else { 1 };
        let copies = bytes[span.clone()].repeat(times.min(LONGEST / (span.len() + 1)));
        bytes.splice(span.end..span.end, copies);
    }

    fn swap_lines(&mut self, bytes: &mut Vec<u8>) {
        let mut lines: Vec<&[u8]> = bytes.split_inclusive(|byte| *byte == b'\n').collect();
        let (one, other) = (self.below(lines.len()), self.below(lines.len()));
        if !lines.is_empty() {
            lines.swap(one, other);
        }
        *bytes = lines.concat();
    }

    fn replace_number(&mut self, bytes: &mut Vec<u8>) {
        let numbers = spans(bytes, |byte| byte.is_ascii_digit() || b"+-.eE".contains(&byte));
        let numbers: Vec<Range<usize>> =
            numbers.into_iter().filter(|span| bytes[span.clone()].iter().any(u8::is_ascii_digit)).collect();
        if numbers.is_empty() {
            return;
        }
        let span = numbers[self.below(numbers.len())].clone();
        let number = match self.below(4) {
            0 => self.edge().to_string(),
            _ => NUMBERS[self.random.usize(..NUMBERS.len())].to_owned(),
        };
        bytes.splice(span, number.into_bytes());
    }

    fn word(&mut self) -> &'static str {
        self.words.get(self.random.usize(..self.words.len().max(1))).copied().unwrap_or("x")
    }

    fn replace_word(&mut self, bytes: &mut Vec<u8>) {
        let words = spans(bytes, |byte| byte.is_ascii_alphanumeric() || b"_-".contains(&byte));
        if !words.is_empty() {
            let span = words[self.below(words.len())].clone();
            bytes.splice(span, self.word().bytes());
        }
    }

    fn insert_word(&mut self, bytes: &mut Vec<u8>) {
        let at = self.below(bytes.len() + 1);
        bytes.splice(at..at, self.word().bytes());
    }
}

/// The longest spans of bytes of a kind.
fn spans(bytes: &[u8], is_of_kind: impl Fn(u8) -> bool) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut start = 0;
    for chunk in bytes.chunk_by(|one, other| is_of_kind(*one) == is_of_kind(*other)) {
        let end = start + chunk.len();
        if is_of_kind(chunk[0]) {
            found.push(start..end);
        }
        start = end;
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_seed_gives_the_same_mutations() {
        let damaged = |seed| {
            let mut bytes = b"label,x\n1,0.5\n2,0.25\n".to_vec();
            let mut mutator = Mutator::new(seed, &["label"]);
            (0..10).for_each(|_| mutator.mutate(&mut bytes));
            bytes
        };
        assert_eq!(damaged(1), damaged(1));
        assert_ne!(damaged(1), damaged(2));
    }

    #[test]
    fn what_is_overwritten_stays_as_long() {
        let mut mutator = Mutator::new(3, &[]);
        let mut bytes = vec![77; 100];
        mutator.overwrite(&mut bytes);
        assert!(bytes.len() == 100 && bytes != vec![77; 100], "{bytes:?}");
        mutator.overwrite(&mut []);
    }

    #[test]
    fn numbers_and_words_are_replaced_whole() {
        let mut mutator = Mutator::new(3, &["nrows"]);
        let mut text = b"ncols 12".to_vec();
        mutator.replace_number(&mut text);
        assert!(text.starts_with(b"ncols ") && text != b"ncols 12", "{text:?}");
        assert_eq!(spans(b"a 12 -3.5e7", |byte| byte.is_ascii_digit()), [2..4, 6..7, 8..9, 10..11]);
        let mut text = b"ncols".to_vec();
        mutator.replace_word(&mut text);
        assert_eq!(text, b"nrows");
    }
}
