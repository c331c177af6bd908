//! The transport of messages between parts of a space.

use xca_core::Face;

/// Carries messages between parts. Parts are numbered from 0. Part 0 is the host's.
///
/// Messages from one part to another with the same tag arrive in the order of sending.
pub trait Transport: Send {
    /// The number of the own part.
    fn number(&self) -> usize;

    /// The number of parts.
    fn count(&self) -> usize;

    /// Sends a message to another part. Does not wait for its arrival.
    ///
    /// # Errors
    /// If the other part has ended, or the own one ([`Self::end`]).
    fn send(&mut self, to: usize, tag: Tag, bytes: Vec<u8>) -> Result<(), TransportError>;

    /// Waits for the next message with this tag from another part.
    ///
    /// # Errors
    /// If the other part has ended without sending one.
    fn receive(&mut self, from: usize, tag: Tag) -> Result<Vec<u8>, TransportError>;

    /// Ends sending from the own part. Parts that wait for it get an error. It can still receive.
    fn end(&mut self);

    /// The minimum of the numbers of all parts.
    ///
    /// # Errors
    /// Those of [`Self::send`] and [`Self::receive`].
    fn least(&mut self, number: u64) -> Result<u64, TransportError> {
        // The parts form a binary tree. Numbers go up, and the minimum comes down.
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

/// The kind of a message.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Tag {
    /// A command of the host.
    Command,
    /// A reply of a part.
    Reply,
    /// An edge of the sending part, at this face of it.
    Edge(Face),
    /// A number, for the minimum.
    Least,
    /// Rows that go to another part.
    Rows,
}

/// A message that did not arrive.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TransportError {
    /// The other part has ended, or the own one.
    #[error("part {part} has ended")]
    Ended {
        /// The number of the part.
        part: usize,
    },
    /// The message has an unknown format.
    #[error("a message of part {part} cannot be read; all parts must be of the same build")]
    Garbled {
        /// The number of the part.
        part: usize,
    },
    /// Another error.
    #[error("part {part} cannot be reached: {reason}")]
    Broken {
        /// The number of the part.
        part: usize,
        /// The reason.
        reason: String,
    },
}
