//! What carries messages between the parts of a space.

use xca_core::Face;

/// Carries messages between parts, which are numbered from 0. Part 0 is that of the host.
///
/// Messages from one part to another with the same tag arrive in the order in which they were sent.
pub trait Transport: Send {
    /// The number of the own part.
    fn number(&self) -> usize;

    /// The number of parts.
    fn count(&self) -> usize;

    /// Sends a message to another part, and does not wait until it arrives.
    ///
    /// # Errors
    /// Where the other part has ended, or the own one has ([`Self::end`]).
    fn send(&mut self, to: usize, tag: Tag, bytes: Vec<u8>) -> Result<(), TransportError>;

    /// Waits for the next message with this tag from another part.
    ///
    /// # Errors
    /// Where the other part has ended before it sent one.
    fn receive(&mut self, from: usize, tag: Tag) -> Result<Vec<u8>, TransportError>;

    /// The own part sends nothing any more: whoever waits for it gets an error. It can still receive.
    fn end(&mut self);

    /// The least of the numbers that all parts give.
    ///
    /// # Errors
    /// As [`Self::send`] and [`Self::receive`].
    fn least(&mut self, number: u64) -> Result<u64, TransportError> {
        // Parts form a tree: each has up to two below it. Numbers go up, the least comes down.
        let (own, count) = (self.number(), self.count());
        let below = [2 * own + 1, 2 * own + 2].into_iter().filter(|part| *part < count);
        let mut least = number;
        for part in below.clone() {
            let bytes = self.receive(part, Tag::Least)?;
            least = least.min(number_of(part, &bytes)?);
        }
        if own > 0 {
            let above = (own - 1) / 2;
            self.send(above, Tag::Least, least.to_le_bytes().to_vec())?;
            least = number_of(above, &self.receive(above, Tag::Least)?)?;
        }
        for part in below {
            self.send(part, Tag::Least, least.to_le_bytes().to_vec())?;
        }
        Ok(least)
    }
}

fn number_of(part: usize, bytes: &[u8]) -> Result<u64, TransportError> {
    let bytes = bytes.try_into().map_err(|_| TransportError::Garbled { part })?;
    Ok(u64::from_le_bytes(bytes))
}

/// What a message is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Tag {
    /// What the host wants.
    Command,
    /// What a part answers.
    Reply,
    /// An edge of the sending part, across this face of it.
    Edge(Face),
    /// A number of which the least is wanted.
    Least,
}

/// A message that does not arrive.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TransportError {
    /// The other part has ended, or the own one.
    #[error("part {part} has ended")]
    Ended {
        /// The number of the part.
        part: usize,
    },
    /// A message that no part of this kind sends.
    #[error("a message of part {part} cannot be read; all parts must be of the same build")]
    Garbled {
        /// The number of the part.
        part: usize,
    },
    /// Anything else.
    #[error("part {part} cannot be reached: {reason}")]
    Broken {
        /// The number of the part.
        part: usize,
        /// Why.
        reason: String,
    },
}
