//! The units of maps.

use std::fmt;

/// The unit of the corner and the side of a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum MapUnit {
    /// Metres, also if a file does not say.
    Metre,
    /// International feet of 0.3048 m.
    Foot,
    /// US survey feet of 1200 / 3937 m.
    SurveyFoot,
    /// Degrees of longitude and latitude.
    Degree,
    /// A unit that is not one of these.
    Other,
}

impl MapUnit {
    /// The sign on the axes of pictures: `m`, `ft`, `°`, or `units`.
    pub fn sign(self) -> &'static str {
        match self {
            Self::Metre => "m",
            Self::Foot | Self::SurveyFoot => "ft",
            Self::Degree => "°",
            Self::Other => "units",
        }
    }
}

impl fmt::Display for MapUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Metre => "metres",
            Self::Foot => "feet",
            Self::SurveyFoot => "US survey feet",
            Self::Degree => "degrees",
            Self::Other => "another unit than metres",
        })
    }
}
