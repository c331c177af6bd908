//! Why a placement is impossible.

/// Why no particles can be placed.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlacementError {
    /// The domain has no cells along some axis.
    #[error("the domain has no cells: it has {} x {} x {}", cells[0], cells[1], cells[2])]
    NoCells {
        /// The cells along x, y and z.
        cells: [usize; 3],
    },
    /// A length is zero, negative, infinite or not a number.
    #[error("the {what} must be positive and finite, not {metres} m")]
    BadLength {
        /// Which length.
        what: &'static str,
        /// Its value, in m.
        metres: f64,
    },
    /// Particles in contact could be more than one cell apart.
    #[error("a particle of radius {radius} m is wider than a cell of side {cell_side} m")]
    WiderThanACell {
        /// The radius, in m.
        radius: f64,
        /// The side of a cell, in m.
        cell_side: f64,
    },
    /// Labels of 32 bits could run out.
    #[error("{} x {} x {} cells are too many: there can be {most}", cells[0], cells[1], cells[2])]
    TooManyCells {
        /// The cells along x, y and z.
        cells: [usize; 3],
        /// The largest number of cells.
        most: u32,
    },
}
