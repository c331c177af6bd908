//! What a picture shows of a state: numbers alone, wherever they come from.

use xca_picture::Scalar;

/// The share of items that may be beyond the scale: a few fast ones must not make all others look alike.
const FAST: f64 = 0.02;

/// The values of one state that a view draws.
#[derive(Debug, Clone, PartialEq)]
pub enum Seen {
    /// Of a layer, or of all cells; with the heights of the ground, where the layer is drawn over one, and
    /// with a mask of the cells without ground, whose values and heights are NaN.
    Cells { is_float: bool, values: Vec<f64>, heights: Option<Vec<f64>>, hidden: Option<Vec<bool>> },
    /// The items by label; there are no values where nothing colours them.
    Items { positions: Vec<[f64; 3]>, values: Vec<f64> },
}

impl Seen {
    /// The scale of this state alone: the least and the largest finite value, of items without the fastest.
    pub fn range(&self) -> Option<[f64; 2]> {
        match self {
            Self::Cells { values, .. } => {
                let finite = values.iter().copied().filter(|value| value.is_finite());
                finite.map(|value| [value; 2]).reduce(|range, one| wider(range, Some(one)))
            }
            Self::Items { values, .. } => Scalar::new("", values).without_largest(FAST).range,
        }
    }
}

/// A range that holds two.
pub(super) fn wider([low, high]: [f64; 2], other: Option<[f64; 2]>) -> [f64; 2] {
    other.map_or([low, high], |[least, most]| [low.min(least), high.max(most)])
}
