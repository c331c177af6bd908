//! Memory for substates. This module is for engines; models do not need it.

/// The bytes to which buffers are aligned: a line of a processor's cache, and its widest register.
const ALIGNMENT: usize = 64;
const WORD: usize = size_of::<u64>();

/// Bytes whose first one is aligned for every scalar and for wide registers.
#[derive(Debug, Default)]
pub struct Buffer {
    words: Vec<u64>,
    /// The words before the first byte.
    start: usize,
    length: usize,
}

impl Buffer {
    /// So many zero bytes.
    pub fn zeroed(length: usize) -> Self {
        let words = vec![0; words(length)];
        Self { start: start(&words), words, length }
    }

    /// The number of bytes.
    pub fn len(&self) -> usize {
        self.length
    }

    /// Whether there are no bytes.
    pub fn is_empty(&self) -> bool {
        self.length == 0
    }

    /// The bytes that it takes.
    pub fn capacity(&self) -> usize {
        self.words.capacity() * WORD
    }

    /// Changes the number of bytes; new ones are zero.
    pub fn resize(&mut self, length: usize) {
        let kept = self.length.min(length);
        let old = self.start;
        self.words.resize(words(length), 0);
        (self.start, self.length) = (start(&self.words), length);
        if kept > 0 {
            self.words.copy_within(old..old + kept.div_ceil(WORD), self.start);
        }
        self.bytes_mut()[kept..].fill(0);
    }

    /// The bytes.
    pub fn bytes(&self) -> &[u8] {
        &bytemuck::cast_slice(&self.words[self.start..])[..self.length]
    }

    /// The bytes, to be written.
    pub fn bytes_mut(&mut self) -> &mut [u8] {
        &mut bytemuck::cast_slice_mut(&mut self.words[self.start..])[..self.length]
    }

    /// Where the bytes start. Asking again, or for [`Self::as_mut_ptr`], leaves earlier pointers valid.
    pub fn as_ptr(&self) -> *const u8 {
        self.words.as_ptr().wrapping_add(self.start).cast()
    }

    /// Where the bytes start, to be written. Asking again leaves earlier pointers valid.
    pub fn as_mut_ptr(&mut self) -> *mut u8 {
        self.words.as_mut_ptr().wrapping_add(self.start).cast()
    }
}

/// The words that hold so many bytes from an aligned one on, wherever that is.
fn words(length: usize) -> usize {
    if length == 0 { 0 } else { length.div_ceil(WORD) + ALIGNMENT / WORD - 1 }
}

/// The words before the first aligned one.
fn start(words: &[u64]) -> usize {
    if words.is_empty() { 0 } else { (words.as_ptr().addr().wrapping_neg() % ALIGNMENT) / WORD }
}

impl Clone for Buffer {
    fn clone(&self) -> Self {
        let mut clone = Self::zeroed(self.length);
        clone.bytes_mut().copy_from_slice(self.bytes());
        clone
    }
}

impl PartialEq for Buffer {
    fn eq(&self, other: &Self) -> bool {
        self.bytes() == other.bytes()
    }
}

#[cfg(test)]
mod tests {
    use super::{ALIGNMENT, Buffer};

    #[test]
    fn bytes_stay_and_are_aligned() {
        let mut buffer = Buffer::zeroed(0);
        let mut wanted: Vec<u8> = Vec::new();
        for length in [1, 3, 70, 64, 5, 6, 4000, 0, 12, 100_000, 99_999, 7] {
            buffer.resize(length);
            wanted.resize(length, 0);
            assert_eq!(buffer.bytes(), wanted);
            assert!(length == 0 || buffer.as_ptr().addr().is_multiple_of(ALIGNMENT));
            let clone = buffer.clone();
            assert_eq!(clone, buffer);
            assert!(length == 0 || clone.as_ptr().addr().is_multiple_of(ALIGNMENT));
            let numbers = (0..length).map(|number| (number % 251 + 1) as u8);
            for (number, byte) in numbers.enumerate() {
                (buffer.bytes_mut()[number], wanted[number]) = (byte, byte);
            }
        }
        assert_ne!(Buffer::zeroed(7), buffer);
    }
}
