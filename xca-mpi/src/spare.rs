//! The bytes of sent messages, for received ones. New memory is expensive: the system clears it.

/// The most messages that are kept: as many as a part has neighbours.
const MOST: usize = 8;

/// The sizes of messages that are kept, in bytes. Edges are among them, whole states are not.
const KEPT: std::ops::Range<usize> = 1 << 12..1 << 24;

/// The bytes of sent messages.
#[derive(Debug, Default)]
pub(crate) struct Spare {
    messages: Vec<Vec<u8>>,
}

impl Spare {
    /// Keeps the bytes of a message.
    pub(crate) fn keep(&mut self, bytes: Vec<u8>) {
        if KEPT.contains(&bytes.len()) && self.messages.len() < MOST {
            self.messages.push(bytes);
        }
    }

    /// Some bytes of this number, from a message of about that size if there is one.
    pub(crate) fn take(&mut self, length: usize) -> Vec<u8> {
        let fits = |bytes: &Vec<u8>| (length..=2 * length).contains(&bytes.len());
        let place = self.messages.iter().position(fits);
        let mut bytes = place.map_or_else(Vec::new, |place| self.messages.swap_remove(place));
        bytes.resize(length, 0);
        bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_of_about_the_same_size_are_used_again() {
        let mut spare = Spare::default();
        for length in [5000, 100, 1 << 24, 8000] {
            spare.keep(vec![1; length]);
        }
        assert_eq!(spare.messages.len(), 2);
        assert_eq!(spare.take(3999), vec![1; 3999]);
        assert_eq!(spare.take(3999), vec![0; 3999]);
        assert_eq!(spare.take(8000), vec![1; 8000]);
        assert_eq!(spare.take(0), []);
        (0..100).for_each(|_| spare.keep(vec![0; 5000]));
        assert_eq!(spare.messages.len(), MOST);
    }
}
