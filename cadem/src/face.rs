//! The six faces of the space.

use serde::{Deserialize, Serialize};
use std::fmt;

/// A face of the domain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Face {
    /// x = 0.
    XLow,
    /// The largest x.
    XHigh,
    /// y = 0.
    YLow,
    /// The largest y.
    YHigh,
    /// z = 0: the floor.
    ZLow,
    /// The largest z: the lid.
    ZHigh,
}

impl Face {
    /// All faces, by number.
    pub const ALL: [Self; 6] = [Self::XLow, Self::XHigh, Self::YLow, Self::YHigh, Self::ZLow, Self::ZHigh];

    /// The number in the substate [`crate::Dem::face`].
    pub const fn number(self) -> u8 {
        self as u8
    }

    /// The axis across the face: 0, 1 or 2 for x, y, z.
    pub const fn axis(self) -> usize {
        self as usize / 2
    }

    /// Whether it is the face at the larger coordinate.
    pub const fn is_high(self) -> bool {
        self as usize % 2 == 1
    }

    /// The two axes along the face, in ascending order.
    pub const fn along(self) -> [usize; 2] {
        match self.axis() {
            0 => [1, 2],
            1 => [0, 2],
            _ => [0, 1],
        }
    }

    /// The name, as in a configuration.
    pub const fn name(self) -> &'static str {
        match self {
            Self::XLow => "x-low",
            Self::XHigh => "x-high",
            Self::YLow => "y-low",
            Self::YHigh => "y-high",
            Self::ZLow => "z-low",
            Self::ZHigh => "z-high",
        }
    }
}

impl fmt::Display for Face {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
