//! What can go wrong on a device.

/// Something that the device refused or failed to do.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum DeviceError {
    /// The device is gone: switched off, reset by its driver, or too long at work.
    #[error("the device was lost: {0}")]
    Lost(String),
    /// No memory is left.
    #[error("the device has no memory left: {0}")]
    OutOfMemory(String),
    /// More than a buffer can hold, or than code can reach at once.
    #[error(
        "{what} would take {wanted} bytes, and this adapter allows {most}; use fewer cells or items, or the cpu engine"
    )]
    TooLarge {
        /// What it is.
        what: String,
        /// Its bytes.
        wanted: u64,
        /// The limit.
        most: u64,
    },
    /// More pieces of buffers than code can use.
    #[error(
        "{what} would use {wanted} storage buffers, and this adapter allows {most}: a buffer beyond {reach} bytes \
         is bound in pieces; use fewer cells or items, divide the process, or take the cpu engine"
    )]
    TooManyPieces {
        /// What uses them.
        what: String,
        /// How many it would use.
        wanted: usize,
        /// The limit.
        most: usize,
        /// The most bytes of a piece.
        reach: u64,
    },
    /// Loops that the device does not bring to their end.
    #[error(
        "{what} has loops that take more turns than this adapter does: it ends the loops of a cell or an item after about {turns} \
         turns together; spread the work over several steps, or take the cpu engine or another adapter"
    )]
    EndedEarly {
        /// Whose loops.
        what: String,
        /// How many turns it does.
        turns: u32,
    },
    /// Anything else: code that does not compile, a limit that is passed.
    #[error("the device refused {what}: {reason}")]
    Refused {
        /// What it should do.
        what: String,
        /// Why not.
        reason: String,
    },
}
