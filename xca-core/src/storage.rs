//! Memory for substates. This module is for engines; models do not need it.

/// The alignment of buffers in bytes: a cache line, and the widest register.
const ALIGNMENT: usize = 64;
const WORD: usize = size_of::<u64>();

/// A processor mistakes a load for a recent store if their addresses differ by a multiple of this, and waits
/// (4K aliasing).
const PAGE: usize = 4096;
/// The distance in cache lines between the places of two buffers in a page. No small multiple of it is close
/// to a whole page.
const LINES_APART: usize = 17;

/// Bytes, the first of which is aligned for every scalar and for wide registers.
#[derive(Debug, Default)]
pub struct Buffer {
    words: Vec<u64>,
    /// The words before the first byte.
    start: usize,
    length: usize,
    /// The place of the first byte in a page. `None`: any place.
    place: Option<usize>,
}

impl Buffer {
    /// A buffer of zeros.
    pub fn zeroed(length: usize) -> Self {
        Self::placed(length, None)
    }

    /// A buffer of zeros. Buffers with different numbers that are used together do not slow each other down.
    pub fn zeroed_apart(length: usize, number: usize) -> Self {
        Self::placed(length, Some(number * LINES_APART * ALIGNMENT % PAGE))
    }

    fn placed(length: usize, place: Option<usize>) -> Self {
        let words = vec![0; words(length, place)];
        Self { start: start(&words, place), words, length, place }
    }

    /// The number of bytes.
    pub fn len(&self) -> usize {
        self.length
    }

    /// Whether there are no bytes.
    pub fn is_empty(&self) -> bool {
        self.length == 0
    }

    /// The allocated size in bytes.
    pub fn capacity(&self) -> usize {
        self.words.capacity() * WORD
    }

    /// Changes the number of bytes. New bytes are zero.
    pub fn resize(&mut self, length: usize) {
        let kept = self.length.min(length);
        let old = self.start;
        self.words.resize(words(length, self.place), 0);
        (self.start, self.length) = (start(&self.words, self.place), length);
        if kept > 0 && old != self.start {
            self.words.copy_within(old..old + kept.div_ceil(WORD), self.start);
        }
        self.bytes_mut()[kept..].fill(0);
    }

    /// The bytes.
    pub fn bytes(&self) -> &[u8] {
        &bytemuck::cast_slice(&self.words[self.start..])[..self.length]
    }

    /// The bytes, for writing.
    pub fn bytes_mut(&mut self) -> &mut [u8] {
        &mut bytemuck::cast_slice_mut(&mut self.words[self.start..])[..self.length]
    }

    /// The address of the first byte. Later calls, also of [`Self::as_mut_ptr`], leave earlier pointers
    /// valid.
    pub fn as_ptr(&self) -> *const u8 {
        self.words.as_ptr().wrapping_add(self.start).cast()
    }

    /// The address of the first byte, for writing. Later calls leave earlier pointers valid.
    pub fn as_mut_ptr(&mut self) -> *mut u8 {
        self.words.as_mut_ptr().wrapping_add(self.start).cast()
    }
}

/// The number of words for `length` bytes at any place.
fn words(length: usize, place: Option<usize>) -> usize {
    if length == 0 { 0 } else { length.div_ceil(WORD) + grid(place) / WORD - 1 }
}

/// The number of words before the first byte.
fn start(words: &[u64], place: Option<usize>) -> usize {
    let apart = place.unwrap_or(0).wrapping_sub(words.as_ptr().addr());
    if words.is_empty() { 0 } else { apart % grid(place) / WORD }
}

/// The distance in bytes between possible addresses of a buffer.
fn grid(place: Option<usize>) -> usize {
    if place.is_some() { PAGE } else { ALIGNMENT }
}

impl Clone for Buffer {
    fn clone(&self) -> Self {
        let mut clone = Self::placed(self.length, self.place);
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
    use super::{ALIGNMENT, Buffer, PAGE};

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

    #[test]
    fn buffers_of_other_numbers_are_elsewhere_in_a_page() {
        let mut places: Vec<usize> = (0..PAGE / ALIGNMENT)
            .map(|number| {
                let mut buffer = Buffer::zeroed_apart(10, number).clone();
                let place = buffer.as_ptr().addr() % PAGE;
                buffer.resize(100_000);
                assert_eq!(buffer.as_ptr().addr() % PAGE, place);
                place
            })
            .collect();
        places.sort_unstable();
        assert!(places.iter().enumerate().all(|(number, place)| *place == number * ALIGNMENT), "{places:?}");
    }
}
