//! Cuts of a space into parts.

use std::ops::Range;
use xca_core::engine::{Part, StartError};
use xca_core::{Face, Geometry};

/// A cut of a space into parts along y and along z. The rows are distributed evenly.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cut {
    /// The number of parts along y, at least one.
    pub y: usize,
    /// The number of parts along z, at least one.
    pub z: usize,
}

impl Cut {
    /// The even cut into `parts` parts, none thinner than the reach of the model. It cuts along the longer of
    /// y and z, or along y if they are equal. Without room for this, it cuts along the other axis, or along
    /// both. `None` if there is no such cut.
    pub fn even(geometry: &Geometry, parts: usize) -> Option<Self> {
        let [_, height, depth] = geometry.extents();
        let along_longer = |along: usize| {
            let across = parts / along;
            if height >= depth { Self { y: along, z: across } } else { Self { y: across, z: along } }
        };
        let both = (2..parts).rev().filter(|along| parts.is_multiple_of(*along));
        [parts, 1].into_iter().chain(both).map(along_longer).find(|cut| cut.fits(geometry))
    }

    /// The even cut into `parts` parts. `engine` is the name in the error message.
    ///
    /// # Errors
    /// [`StartError::NoParts`] if there is no such cut.
    pub fn into_parts(geometry: &Geometry, parts: usize, engine: &str) -> Result<Self, StartError> {
        Self::even(geometry, parts).ok_or_else(|| {
            let ([_, y, z], most) = (geometry.extents(), Self::most(geometry));
            let reason = format!(
                "{y} rows along y and {z} along z cannot be cut into {parts} parts; the model reaches so far \
                 that at most {} parts fit along y and {} along z",
                most.y, most.z
            );
            StartError::NoParts { engine: engine.to_owned(), reason }
        })
    }

    /// The largest numbers of parts along y and along z.
    pub fn most(geometry: &Geometry) -> Self {
        let [y, z] = [1, 2]
            .map(|axis| (geometry.extents()[axis] / geometry.neighbourhood().reach()[axis].max(1)).max(1));
        Self { y, z }
    }

    /// Whether each part has at least one row along both axes, and no cell reaches beyond the next part.
    fn fits(self, geometry: &Geometry) -> bool {
        let most = Self::most(geometry);
        (1..=most.y).contains(&self.y) && (1..=most.z).contains(&self.z)
    }

    /// The number of parts.
    pub fn count(self) -> usize {
        self.y * self.z
    }

    /// The part with this number.
    pub fn part(self, geometry: &Geometry, number: usize) -> Part {
        let [_, height, depth] = geometry.extents();
        Part { y: share(height, self.y, number % self.y), z: share(depth, self.z, number / self.y) }
    }

    /// The number of the part that contains the row with these indices y and z.
    pub fn part_of(self, geometry: &Geometry, [y, z]: [usize; 2]) -> usize {
        let [_, height, depth] = geometry.extents();
        owner(depth, self.z, z) * self.y + owner(height, self.y, y)
    }

    /// The number of the part beyond a face of the part with this number, with wrapping around the space.
    pub fn beyond(self, number: usize, face: Face) -> usize {
        let next = |at: usize, count: usize, axis: usize| {
            let [low, high] = Face::ALONG[axis];
            match face {
                face if face == low => (at + count - 1) % count,
                face if face == high => (at + 1) % count,
                _ => at,
            }
        };
        next(number / self.y, self.z, 2) * self.y + next(number % self.y, self.y, 1)
    }
}

/// The rows of one part of an axis.
fn share(rows: usize, parts: usize, number: usize) -> Range<usize> {
    rows * number / parts..rows * (number + 1) / parts
}

/// The part of an axis that contains a row.
fn owner(rows: usize, parts: usize, row: usize) -> usize {
    let guess = row * parts / rows.max(1);
    (guess..parts).find(|number| row < share(rows, parts, *number).end).unwrap_or(guess)
}

#[cfg(test)]
mod tests {
    use super::Cut;
    use xca_core::{Face, Faces, Model, Neighbourhood, Substates};

    #[derive(Substates, Clone)]
    struct Site {
        value: u8,
    }

    fn model(extents: [usize; 3], reach: u8) -> Model {
        let builder = Model::builder("rows").extents(extents).substates::<Site>();
        builder.neighbourhood(Neighbourhood::moore(reach)).build().unwrap()
    }

    #[test]
    fn cuts_by_hand() {
        let cut = |extents, reach, parts| {
            Cut::even(model(extents, reach).geometry(), parts).map(|Cut { y, z }| (y, z))
        };
        assert_eq!(cut([9, 12, 12], 1, 4), Some((4, 1)));
        assert_eq!(cut([9, 11, 12], 1, 4), Some((1, 4)));
        // There is no room along the longer axis alone.
        assert_eq!(cut([9, 12, 9], 3, 6), Some((3, 2)));
        assert_eq!(cut([9, 9, 12], 3, 6), Some((2, 3)));
        assert_eq!(cut([9, 12, 9], 3, 5), None);
        assert_eq!(cut([9, 2, 2], 1, 1), Some((1, 1)));
        assert_eq!(Cut::most(model([9, 12, 10], 3).geometry()), Cut { y: 4, z: 3 });
    }

    /// Each row belongs to one part, which knows it. The sizes of parts differ by at most one row.
    #[test]
    fn each_row_has_one_part() {
        for (height, depth, y, z) in [(7, 5, 3, 2), (13, 1, 5, 1), (4, 9, 4, 4), (6, 6, 1, 6)] {
            let model = model([2, height, depth], 1);
            let (geometry, cut) = (model.geometry(), Cut { y, z });
            let mut owners = vec![None; height * depth];
            for number in 0..cut.count() {
                let part = cut.part(geometry, number);
                assert!(part.y.len().abs_diff(height / y) <= 1 && part.z.len().abs_diff(depth / z) <= 1);
                for row in part.runs(geometry).flatten() {
                    assert_eq!(owners[row].replace(number), None);
                }
            }
            for (row, owner) in owners.into_iter().enumerate() {
                assert_eq!(owner, Some(cut.part_of(geometry, [row % height, row / height])));
            }
        }
    }

    /// The part beyond a face has this part beyond its opposite face. One row farther is the next part.
    #[test]
    fn parts_lie_beyond_each_other() {
        let model = model([2, 7, 9], 1);
        let (geometry, cut) = (model.geometry(), Cut { y: 3, z: 4 });
        for number in 0..12 {
            let part = cut.part(geometry, number);
            let at = |y: usize, z: usize| cut.part_of(geometry, [y % 7, z % 9]);
            let wanted = Faces {
                west: number,
                east: number,
                south: at(part.y.start + 6, part.z.start),
                north: at(part.y.end, part.z.start),
                bottom: at(part.y.start, part.z.start + 8),
                top: at(part.y.start, part.z.end),
            };
            for face in Face::ALL {
                assert_eq!(cut.beyond(number, face), wanted[face]);
                assert_eq!(cut.beyond(wanted[face], face.opposite()), number);
            }
        }
    }
}
