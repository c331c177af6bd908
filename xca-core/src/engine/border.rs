//! The connection between parts of a space.

use super::EngineFailure;
use xca_process::Face;

/// The connection of a part of a space to the other parts. Messages arrive in order. The engines define their
/// content.
pub trait Border: Send {
    /// Sends bytes to the part beyond this face. Does not wait for their arrival.
    ///
    /// # Errors
    /// Returns [`EngineFailure::Elsewhere`] if another part has ended, or an error if the connection is
    /// broken.
    fn send(&mut self, face: Face, bytes: Vec<u8>) -> Result<(), EngineFailure>;

    /// Waits for the bytes that the part beyond this face has sent across it.
    ///
    /// # Errors
    /// As [`Self::send`].
    fn receive(&mut self, face: Face) -> Result<Vec<u8>, EngineFailure>;

    /// Tells the parts beyond all faces that this part sends nothing more before all parts call
    /// [`Self::least`]. Those that wait for it get [`EngineFailure::Elsewhere`].
    ///
    /// # Errors
    /// As [`Self::send`].
    fn give_up(&mut self) -> Result<(), EngineFailure>;

    /// The minimum of the numbers of all parts. Messages that were sent before and not received are dropped.
    ///
    /// # Errors
    /// As [`Self::send`].
    fn least(&mut self, number: u64) -> Result<u64, EngineFailure>;
}
