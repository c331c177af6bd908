//! The space of a frame.

/// The space of the particles: a box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Space {
    /// Its lower corner.
    pub origin: [f64; 3],
    /// Its sides along x, y and z.
    pub sides: [f64; 3],
    /// The axes along which it is periodic.
    pub periodic: [bool; 3],
}
