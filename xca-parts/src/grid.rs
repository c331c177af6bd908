//! The numbers of parts along the axes.

use std::fmt::{Display, Formatter};
use std::str::FromStr;
use xca_core::engine::StartError;
use xca_core::model::{Group, GroupKind};
use xca_core::{Geometry, Model};

/// The numbers of parts along y and along z. As text, `2x3` is two parts along y and three along z.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Grid {
    /// The number of parts along y, at least one.
    pub y: usize,
    /// The number of parts along z, at least one.
    pub z: usize,
}

/// A text that is not a [`Grid`].
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{text}` is not a grid of parts; write two whole numbers from 1, such as 2x3")]
pub struct GridError {
    text: String,
}

impl Grid {
    /// One part, the whole space.
    pub const WHOLE: Self = Self { y: 1, z: 1 };

    /// A grid of `parts` parts, none of which has to be thinner than the reach of the model. It cuts along
    /// the longer of y and z. If they are equal, it cuts models of cells along z, because parts of whole
    /// layers can do several steps together, and models with items along y, because these fall along z.
    /// Without room for this, it cuts along the other axis, or along both. `None` if there is no such grid.
    pub fn with_parts(model: &Model, parts: usize) -> Option<Self> {
        let is_of_items = |group: &Group| matches!(group.kind(), GroupKind::Population { .. });
        Self::of_space(model.geometry(), parts, model.groups().iter().any(is_of_items))
    }

    fn of_space(geometry: &Geometry, parts: usize, has_items: bool) -> Option<Self> {
        let [_, height, depth] = geometry.extents();
        let along_longer = |along: usize| {
            let across = parts / along;
            if height > depth || (height == depth && has_items) {
                Self { y: along, z: across }
            } else {
                Self { y: across, z: along }
            }
        };
        let both = (2..parts).rev().filter(|along| parts.is_multiple_of(*along));
        [parts, 1].into_iter().chain(both).map(along_longer).find(|grid| grid.fits(geometry))
    }

    /// Like [`Self::with_parts`]. `engine` is the name in the error message.
    ///
    /// # Errors
    /// [`StartError::NoParts`] if there is no such grid.
    pub fn into_parts(model: &Model, parts: usize, engine: &str) -> Result<Self, StartError> {
        let no_room = || no_room(model.geometry(), &format!("{parts} parts"), engine);
        Self::with_parts(model, parts).ok_or_else(no_room)
    }

    /// Checks that a space has room for the parts. `engine` is the name in the error message.
    ///
    /// # Errors
    /// [`StartError::NoParts`] if it has not, or a number of parts is 0.
    pub fn check(self, geometry: &Geometry, engine: &str) -> Result<(), StartError> {
        if self.count() == 0 {
            let reason = "a cut has at least one part along y and one along z".to_owned();
            return Err(StartError::NoParts { engine: engine.to_owned(), reason });
        }
        let parts = || format!("{} parts along y and {} along z", self.y, self.z);
        if self.fits(geometry) { Ok(()) } else { Err(no_room(geometry, &parts(), engine)) }
    }

    /// The largest numbers of parts along y and along z.
    pub fn most(geometry: &Geometry) -> Self {
        let [y, z] = [1, 2].map(|axis| (geometry.extents()[axis] / thinnest(geometry, axis)).max(1));
        Self { y, z }
    }

    /// Whether each part has at least one row along both axes, and no cell reaches beyond the next part.
    fn fits(self, geometry: &Geometry) -> bool {
        let most = Self::most(geometry);
        (1..=most.y).contains(&self.y) && (1..=most.z).contains(&self.z)
    }

    /// The number of parts.
    pub fn count(self) -> usize {
        self.y.saturating_mul(self.z)
    }
}

impl Display for Grid {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "{}x{}", self.y, self.z)
    }
}

impl FromStr for Grid {
    type Err = GridError;

    fn from_str(text: &str) -> Result<Self, GridError> {
        let number = |text: &str| text.parse().ok().filter(|number| *number > 0);
        let numbers = text.split_once('x').and_then(|(y, z)| Some((number(y)?, number(z)?)));
        let (y, z) = numbers.ok_or_else(|| GridError { text: text.to_owned() })?;
        Ok(Self { y, z })
    }
}

/// The least number of rows of a part along an axis: no cell may see beyond the next part.
pub(crate) fn thinnest(geometry: &Geometry, axis: usize) -> usize {
    geometry.neighbourhood().reach()[axis].max(1)
}

fn no_room(geometry: &Geometry, parts: &str, engine: &str) -> StartError {
    let ([_, y, z], most) = (geometry.extents(), Grid::most(geometry));
    let reason = format!(
        "{y} rows along y and {z} along z cannot be cut into {parts}; the model reaches so far that at most {} parts fit \
         along y and {} along z",
        most.y, most.z
    );
    StartError::NoParts { engine: engine.to_owned(), reason }
}

#[cfg(test)]
mod tests {
    use super::Grid;
    use xca_core::{Boundary, Faces, Geometry, Neighbourhood};

    #[test]
    fn grids_by_hand() {
        let space = |extents, reach| {
            Geometry::new(extents, 1.0, Faces::all(Boundary::Flat), Neighbourhood::moore(reach))
        };
        let of_space = |extents, reach, parts, has_items| {
            Grid::of_space(&space(extents, reach), parts, has_items).map(|grid| grid.to_string())
        };
        assert_eq!(of_space([9, 12, 12], 1, 4, true).as_deref(), Some("4x1"));
        assert_eq!(of_space([9, 12, 12], 1, 4, false).as_deref(), Some("1x4"));
        let grid = |extents, reach, parts| {
            let [one, other] = [true, false].map(|has_items| of_space(extents, reach, parts, has_items));
            assert_eq!(one, other);
            one
        };
        assert_eq!(grid([9, 11, 12], 1, 4).as_deref(), Some("1x4"));
        // There is no room along the longer axis alone.
        assert_eq!(grid([9, 12, 9], 3, 6).as_deref(), Some("3x2"));
        assert_eq!(grid([9, 9, 12], 3, 6).as_deref(), Some("2x3"));
        assert_eq!(grid([9, 12, 9], 3, 5), None);
        assert_eq!(grid([9, 2, 2], 1, 1).as_deref(), Some("1x1"));
        assert_eq!(Grid::most(&space([9, 12, 10], 3)), Grid { y: 4, z: 3 });
    }

    #[test]
    fn grids_are_read_as_they_are_written() {
        for (text, grid) in [("2x3", Grid { y: 2, z: 3 }), ("1x12", Grid { y: 1, z: 12 })] {
            assert_eq!((text.parse(), grid.to_string()), (Ok(grid), text.to_owned()));
        }
        for text in ["", "2", "x", "2x", "0x2", "2x0", "2x3x4", "-1x2", "y2"] {
            assert!(text.parse::<Grid>().is_err_and(|error| error.to_string().contains("such as 2x3")));
        }
    }
}
