//! What a driver does wrongly and is done in another way.

/// The operations that the driver does not round correctly, and that are made correct by other operations: of
/// floats of 32 bits, then of 64 bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub(crate) struct Corrections {
    pub(crate) divisions: [bool; 2],
    pub(crate) roots: [bool; 2],
    /// Floats made whole: `trunc`, `floor` and `ceil`.
    pub(crate) roundings: [bool; 2],
}

impl Corrections {
    /// Of all operations that can be corrected.
    pub(crate) const ALL: Self = Self { divisions: [true; 2], roots: [true; 2], roundings: [true; 2] };
}
