//! The distance of items from their cells, and their relative motion in a pass or since neighbour lists were
//! made.

use xca_core::kernel::STAY;

/// Measures of some items. A measure is NaN if a position is NaN.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Motion {
    /// The largest distance in metres, along an axis, of an item from its cell.
    pub(crate) slack: f64,
    /// The square of the largest difference in metres between a displacement and the common one, which is an
    /// estimate known beforehand.
    pub(crate) square: f64,
    /// The smallest and largest displacements along each axis, minus the common one.
    pub(crate) low: [f64; 3],
    pub(crate) high: [f64; 3],
}

impl Motion {
    pub(crate) const NONE: Self =
        Self { slack: 0.0, square: 0.0, low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] };

    /// An upper limit, in metres, of how much two items have approached each other. There are two limits: the
    /// sphere around the common motion, and the box of all displacements. The sphere is smaller for motion in
    /// all directions, the box while the common motion is unknown.
    pub(crate) fn approach(&self) -> f64 {
        let widths = [0, 1, 2].map(|axis| self.high[axis] - self.low[axis]);
        let box_ = widths.iter().map(|width| width * width).sum::<f64>().sqrt();
        let sphere = 2.0 * self.square.sqrt();
        // Keeps NaN.
        if box_ < sphere { box_ } else { sphere }
    }

    /// The middle of the displacements, minus the common one. `None` if nothing has moved, or if it is not
    /// finite.
    pub(crate) fn middle(&self) -> Option<[f64; 3]> {
        let middle = [0, 1, 2].map(|axis| 0.5 * (self.low[axis] + self.high[axis]));
        middle.iter().all(|middle| middle.is_finite()).then_some(middle)
    }

    /// The measures of both sets of items.
    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            slack: largest(self.slack, other.slack),
            square: largest(self.square, other.square),
            low: std::array::from_fn(|axis| self.low[axis].min(other.low[axis])),
            high: std::array::from_fn(|axis| self.high[axis].max(other.high[axis])),
        }
    }
}

/// The larger number, or NaN if one is NaN.
pub(crate) fn largest(a: f64, b: f64) -> f64 {
    if b <= a || a.is_nan() { a } else { b }
}

/// The distance of a position from a cell.
pub(crate) fn outside(position: [f64; 3], cell: [usize; 3], side: f64) -> f64 {
    (0..3).fold(0.0, |most, axis| {
        let low = cell[axis] as f64 * side;
        largest(largest(most, low - position[axis]), position[axis] - (low + side))
    })
}

/// Whether an item with this answer of a migration leaves its cell.
#[inline(always)]
pub(crate) fn moves(cell: u32, answer: u32) -> bool {
    (answer != STAY) & (answer != cell)
}

#[cfg(test)]
mod tests {
    use super::largest;

    #[test]
    fn nan_stays() {
        assert_eq!(largest(1.0, 2.0), 2.0);
        assert_eq!(largest(2.0, 1.0), 2.0);
        assert!(largest(1.0, f64::NAN).is_nan());
        assert!(largest(f64::NAN, 1.0).is_nan());
    }
}
