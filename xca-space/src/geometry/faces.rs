//! The six faces of the space, and values for them.

use std::fmt;
use std::ops::{Index, IndexMut};

/// A face of the space. As on a map, x grows to the east and y to the north; z grows upwards.
///
/// ```
/// use xca_core::prelude::*;
///
/// assert_eq!(Face::North.opposite(), Face::South);
/// assert_eq!(Face::Top.axis(), 2);
/// assert_eq!(Face::East.to_string(), "east");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Face {
    /// Before the first cell along x.
    West,
    /// Behind the last cell along x.
    East,
    /// Before the first cell along y.
    South,
    /// Behind the last cell along y.
    North,
    /// Below the first layer of cells along z.
    Bottom,
    /// Above the last layer of cells along z.
    Top,
}

impl Face {
    /// All faces, along x, y, z: for each axis the face at the first cell, then the face at the last.
    pub const ALL: [Self; 6] = [Self::West, Self::East, Self::South, Self::North, Self::Bottom, Self::Top];

    /// The two faces across each of the axes x, y, z.
    pub const ALONG: [[Self; 2]; 3] =
        [[Self::West, Self::East], [Self::South, Self::North], [Self::Bottom, Self::Top]];

    /// The axis across which the face lies: 0 is x, 1 is y, 2 is z.
    pub const fn axis(self) -> usize {
        self as usize / 2
    }

    /// The face at the other end of the axis.
    pub const fn opposite(self) -> Self {
        Self::ALL[self as usize ^ 1]
    }
}

impl fmt::Display for Face {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::West => "west",
            Self::East => "east",
            Self::South => "south",
            Self::North => "north",
            Self::Bottom => "bottom",
            Self::Top => "top",
        })
    }
}

/// One value for each face of the space. Index it by [`Face`], or use its fields.
///
/// ```
/// use xca_core::prelude::*;
///
/// let mut boundaries = Faces::from([Boundary::Toroidal, Boundary::Flat, Boundary::Flat]);
/// boundaries[Face::Top] = Boundary::Reflecting;
/// assert_eq!(boundaries.west, Boundary::Toroidal);
/// assert_eq!(boundaries, Faces { top: Boundary::Reflecting, ..boundaries });
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, serde::Serialize, serde::Deserialize)]
#[expect(missing_docs, reason = "the fields are those of `Face`")]
pub struct Faces<T> {
    pub west: T,
    pub east: T,
    pub south: T,
    pub north: T,
    pub bottom: T,
    pub top: T,
}

impl<T> Faces<T> {
    /// Calls a function for each face.
    pub fn from_fn(mut value: impl FnMut(Face) -> T) -> Self {
        Self {
            west: value(Face::West),
            east: value(Face::East),
            south: value(Face::South),
            north: value(Face::North),
            bottom: value(Face::Bottom),
            top: value(Face::Top),
        }
    }

    /// The same value for all faces.
    pub fn all(value: T) -> Self
    where
        T: Clone,
    {
        Self::from_fn(|_| value.clone())
    }

    /// Applies a function to the value of each face.
    pub fn map<U>(&self, mut value: impl FnMut(&T) -> U) -> Faces<U> {
        Faces::from_fn(|face| value(&self[face]))
    }
}

/// One value for both faces of each of the axes x, y, z.
impl<T: Clone> From<[T; 3]> for Faces<T> {
    fn from(along: [T; 3]) -> Self {
        Self::from_fn(|face| along[face.axis()].clone())
    }
}

impl<T> Index<Face> for Faces<T> {
    type Output = T;

    fn index(&self, face: Face) -> &T {
        match face {
            Face::West => &self.west,
            Face::East => &self.east,
            Face::South => &self.south,
            Face::North => &self.north,
            Face::Bottom => &self.bottom,
            Face::Top => &self.top,
        }
    }
}

impl<T> IndexMut<Face> for Faces<T> {
    fn index_mut(&mut self, face: Face) -> &mut T {
        match face {
            Face::West => &mut self.west,
            Face::East => &mut self.east,
            Face::South => &mut self.south,
            Face::North => &mut self.north,
            Face::Bottom => &mut self.bottom,
            Face::Top => &mut self.top,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Face, Faces};

    #[test]
    fn faces_and_axes_agree() {
        for (axis, [low, high]) in Face::ALONG.into_iter().enumerate() {
            assert_eq!((low.axis(), high.axis()), (axis, axis));
            assert_eq!((low.opposite(), high.opposite()), (high, low));
        }
        let mut names = Faces::from_fn(|face| face.to_string());
        assert_eq!(Face::ALL.map(|face| names[face].clone()), Face::ALL.map(|face| face.to_string()));
        names[Face::Top].push('!');
        assert_eq!((names.top.as_str(), names.bottom.as_str()), ("top!", "bottom"));
        assert_eq!(Faces::from([1, 2, 3]), Faces { west: 1, east: 1, south: 2, north: 2, bottom: 3, top: 3 });
    }
}
