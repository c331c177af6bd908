//! Neighbourhoods: which cells a cell sees.

use shapes::ShapeNumber;
use std::collections::HashMap;
use std::fmt;

pub(crate) mod shapes;

/// The cells that a process sees, as displacements from the central cell, which has index 0.
///
/// In the ready-made neighbourhoods the others follow with z slowest and x fastest, from the negative to the positive side: the seven of
/// [`Neighbourhood::von_neumann`] are centre, -z, -y, -x, +x, +y, +z. Only with [`Hexagons::SideUp`] y is fastest, so that an index means the
/// same direction in all columns. A custom list keeps its order.
#[derive(Clone, PartialEq, Eq)]
pub struct Neighbourhood {
    name: String,
    /// For cells in even and in odd rows (or columns): the same list except in hexagonal grids.
    displacements: [Vec<[i32; 3]>; 2],
    parity: Parity,
    /// For each index that of the opposite direction, the same for all cells.
    opposites: Vec<Option<usize>>,
    shape: ShapeNumber,
}

/// What the displacements depend on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Parity {
    /// Nothing: all cells have the same.
    None,
    /// On whether the row, y, is even or odd.
    Row,
    /// On whether the column, x, is even or odd.
    Column,
}

/// How the hexagons of a hexagonal grid stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Hexagons {
    /// With a corner up: cells stand in straight rows, and odd rows are shifted half a cell towards +x.
    CornerUp,
    /// With a side up: cells stand in straight columns, and odd columns are shifted half a cell towards +y.
    SideUp,
}

/// A list of displacements that is no neighbourhood.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NeighbourhoodError {
    /// Index 0 is the central cell.
    #[error("a neighbourhood starts with the central cell: put [0, 0, 0] first")]
    NoCentre,
    /// The same displacement twice.
    #[error("the displacement {0:?} stands twice in the neighbourhood")]
    Twice([i32; 3]),
}

impl Neighbourhood {
    /// The cells that are at most `radius` steps away along the axes: 7 for radius 1.
    pub fn von_neumann(radius: u8) -> Self {
        Self::ball(format!("von Neumann, radius {radius}"), radius, radius, |[x, y, z]| {
            x.unsigned_abs() + y.unsigned_abs() + z.unsigned_abs() <= radius.into()
        })
    }

    /// The cube of cells at most `radius` away along each axis: 27 for radius 1.
    pub fn moore(radius: u8) -> Self {
        Self::ball(format!("Moore, radius {radius}"), radius, radius, |_| true)
    }

    /// [`Self::von_neumann`] within one layer: 5 for radius 1.
    pub fn von_neumann_2d(radius: u8) -> Self {
        Self::ball(format!("von Neumann 2D, radius {radius}"), radius, 0, |[x, y, _]| {
            x.unsigned_abs() + y.unsigned_abs() <= radius.into()
        })
    }

    /// [`Self::moore`] within one layer: 9 for radius 1.
    pub fn moore_2d(radius: u8) -> Self {
        Self::ball(format!("Moore 2D, radius {radius}"), radius, 0, |_| true)
    }

    /// The six touching hexagons of a cell in one layer, 7 with itself. An index means the same direction in even and odd rows or columns:
    /// with a corner up the two below, those at the sides, the two above; with a side up the same with x and y exchanged.
    pub fn hexagonal(hexagons: Hexagons) -> Self {
        // In even rows the two neighbours below and above stand at x - 1 and x, in odd rows at x and x + 1.
        let rows = |shift: i32| {
            vec![
                [0, 0, 0],
                [shift - 1, -1, 0],
                [shift, -1, 0],
                [-1, 0, 0],
                [1, 0, 0],
                [shift - 1, 1, 0],
                [shift, 1, 0],
            ]
        };
        let turn = |list: Vec<[i32; 3]>| list.into_iter().map(|[x, y, z]| [y, x, z]).collect();
        match hexagons {
            Hexagons::CornerUp => {
                Self::new("hexagonal, corner up".to_owned(), [rows(0), rows(1)], Parity::Row)
            }
            Hexagons::SideUp => {
                Self::new("hexagonal, side up".to_owned(), [turn(rows(0)), turn(rows(1))], Parity::Column)
            }
        }
    }

    /// Any list of displacements; the first is the central cell.
    ///
    /// # Errors
    /// Where the first is not `[0, 0, 0]`, or one stands twice.
    pub fn custom(displacements: Vec<[i32; 3]>) -> Result<Self, NeighbourhoodError> {
        if displacements.first() != Some(&[0, 0, 0]) {
            return Err(NeighbourhoodError::NoCentre);
        }
        for (index, displacement) in displacements.iter().enumerate() {
            if displacements[..index].contains(displacement) {
                return Err(NeighbourhoodError::Twice(*displacement));
            }
        }
        let name = format!("custom, {} cells", displacements.len());
        Ok(Self::new(name, [displacements.clone(), displacements], Parity::None))
    }

    fn ball(name: String, radius: u8, layers: u8, inside: impl Fn([i32; 3]) -> bool) -> Self {
        let (radius, layers) = (i32::from(radius), i32::from(layers));
        let mut displacements = vec![[0, 0, 0]];
        for z in -layers..=layers {
            for y in -radius..=radius {
                for x in -radius..=radius {
                    if [x, y, z] != [0, 0, 0] && inside([x, y, z]) {
                        displacements.push([x, y, z]);
                    }
                }
            }
        }
        Self::new(name, [displacements.clone(), displacements], Parity::None)
    }

    fn new(name: String, displacements: [Vec<[i32; 3]>; 2], parity: Parity) -> Self {
        let opposites = opposites(&displacements, parity);
        let shape = match parity {
            Parity::None => shapes::number_of(&displacements[0]),
            Parity::Row | Parity::Column => shapes::HEXAGONAL,
        };
        Self { name, displacements, parity, opposites, shape }
    }

    /// The number of cells, with the central one.
    pub fn size(&self) -> usize {
        self.displacements[0].len()
    }

    /// The displacements along x, y, z for a cell with these indices.
    pub fn displacements(&self, cell: [usize; 3]) -> &[[i32; 3]] {
        let odd = match self.parity {
            Parity::None => 0,
            Parity::Row => cell[1] % 2,
            Parity::Column => cell[0] % 2,
        };
        &self.displacements[odd]
    }

    /// The index of the neighbour at a displacement from the cell with these indices; `None` where the
    /// neighbourhood does not hold it. Only in hexagonal grids does the cell matter.
    ///
    /// ```
    /// use xca_core::prelude::*;
    ///
    /// let eight = Neighbourhood::moore_2d(1);
    /// assert_eq!(eight.index_of([4, 7, 0], [1, 1, 0]), Some(directions::moore_2d::NORTH_EAST));
    /// assert_eq!(eight.index_of([4, 7, 0], [2, 0, 0]), None);
    /// ```
    pub fn index_of(&self, cell: [usize; 3], displacement: [i32; 3]) -> Option<usize> {
        self.displacements(cell).iter().position(|known| *known == displacement)
    }

    /// The index of the neighbour in the opposite direction: seen from neighbour `index`, the cell itself has
    /// this index. 0 for 0. `None` where a custom neighbourhood lacks the opposite displacement, and for an
    /// index beyond the neighbourhood.
    pub fn opposite(&self, index: usize) -> Option<usize> {
        self.opposites.get(index).copied().flatten()
    }

    /// [`Self::opposite`] for each index.
    pub(crate) fn opposites(&self) -> &[Option<usize>] {
        &self.opposites
    }

    /// The shape that kernels know it by.
    pub(crate) fn shape(&self) -> ShapeNumber {
        self.shape
    }

    /// The first displacement whose opposite is missing.
    pub(crate) fn without_opposite(&self) -> Option<[i32; 3]> {
        let first = self.opposites.iter().position(Option::is_none)?;
        self.displacements[0].get(first).copied()
    }

    /// What the displacements depend on.
    pub fn parity(&self) -> Parity {
        self.parity
    }

    /// The largest displacement along x, y, z.
    pub fn reach(&self) -> [usize; 3] {
        let mut reach = [0; 3];
        for displacement in self.displacements.iter().flatten() {
            for (reach, along) in reach.iter_mut().zip(displacement) {
                *reach = (*reach).max(along.unsigned_abs() as usize);
            }
        }
        reach
    }
}

/// For each index that under which the neighbour sees the cell: its displacement, turned round, is in the
/// list of the neighbour's row or column.
fn opposites(displacements: &[Vec<[i32; 3]>; 2], parity: Parity) -> Vec<Option<usize>> {
    let indices = displacements
        .each_ref()
        .map(|list| list.iter().enumerate().map(|(index, at)| (*at, index)).collect::<HashMap<_, _>>());
    let back = |[x, y, z]: &[i32; 3]| {
        let list = match parity {
            Parity::None => 0,
            Parity::Row => y & 1,
            Parity::Column => x & 1,
        };
        // A displacement that no number can turn round has no opposite.
        let turned = [x.checked_neg()?, y.checked_neg()?, z.checked_neg()?];
        indices[list as usize].get(&turned).copied()
    };
    displacements[0].iter().map(back).collect()
}

impl fmt::Debug for Neighbourhood {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Neighbourhood({self})")
    }
}

impl fmt::Display for Neighbourhood {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name)
    }
}

#[cfg(test)]
mod tests {
    use super::{Hexagons, Neighbourhood, NeighbourhoodError, shapes};

    #[test]
    fn sizes_of_the_ready_made_ones() {
        assert_eq!(Neighbourhood::von_neumann(1).size(), 7);
        assert_eq!(Neighbourhood::moore(1).size(), 27);
        assert_eq!(Neighbourhood::von_neumann_2d(1).size(), 5);
        assert_eq!(Neighbourhood::moore_2d(1).size(), 9);
        // The octahedral number of radius 2, and a cube of five.
        assert_eq!(Neighbourhood::von_neumann(2).size(), 25);
        assert_eq!(Neighbourhood::moore(2).size(), 125);
        assert_eq!(Neighbourhood::moore(2).reach(), [2, 2, 2]);
        assert_eq!(Neighbourhood::moore_2d(2).reach(), [2, 2, 0]);
    }

    #[test]
    fn order_is_centre_then_x_fastest() {
        let seven = Neighbourhood::von_neumann(1);
        let expected = [[0, 0, 0], [0, 0, -1], [0, -1, 0], [-1, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]];
        assert_eq!(seven.displacements([4, 4, 4]), expected);
    }

    /// Centres of touching hexagons are one apart, whatever the parity of the cell.
    #[test]
    fn hexagons_touch() {
        let height = 3_f64.sqrt() / 2.0;
        for hexagons in [Hexagons::CornerUp, Hexagons::SideUp] {
            let neighbourhood = Neighbourhood::hexagonal(hexagons);
            let place = |[x, y]: [i32; 2]| match hexagons {
                Hexagons::CornerUp => {
                    [f64::from(x) + 0.5 * f64::from(y.rem_euclid(2)), height * f64::from(y)]
                }
                Hexagons::SideUp => [height * f64::from(x), f64::from(y) + 0.5 * f64::from(x.rem_euclid(2))],
            };
            for cell in [[4, 4, 0], [5, 4, 0], [4, 5, 0], [5, 5, 0]] {
                let here = [cell[0] as i32, cell[1] as i32];
                let mut seen = Vec::new();
                for [x, y, _] in &neighbourhood.displacements(cell)[1..] {
                    let other = [here[0] + x, here[1] + y];
                    let (a, b) = (place(here), place(other));
                    let distance = (a[0] - b[0]).hypot(a[1] - b[1]);
                    assert!((distance - 1.0).abs() < 1e-12, "{hexagons:?} {cell:?} {other:?}: {distance}");
                    assert!(!seen.contains(&other));
                    seen.push(other);
                }
                assert_eq!(seen.len(), 6);
            }
        }
    }

    /// Names, displacements and opposites belong together: north is +y, east +x, up +z.
    #[test]
    fn directions_are_what_they_are_called() {
        use crate::directions::{hexagonal, moore, moore_2d, von_neumann, von_neumann_2d};
        let check = |neighbourhood: Neighbourhood, cell: [usize; 3], named: &[(usize, [i32; 3])]| {
            assert_eq!(neighbourhood.size(), named.len());
            for (index, displacement) in named {
                assert_eq!(neighbourhood.displacements(cell)[*index], *displacement);
                assert_eq!(neighbourhood.index_of(cell, *displacement), Some(*index));
            }
        };
        let (south, north, west, east) = ([0, -1, 0], [0, 1, 0], [-1, 0, 0], [1, 0, 0]);
        let along = |a: [i32; 3], b: [i32; 3]| [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
        let (south_west, south_east) = (along(south, west), along(south, east));
        let (north_west, north_east) = (along(north, west), along(north, east));
        let (down, up) = ([0, 0, -1], [0, 0, 1]);
        {
            use von_neumann_2d::{CENTRE, EAST, NORTH, SOUTH, WEST};
            let named = [(CENTRE, [0; 3]), (SOUTH, south), (NORTH, north), (WEST, west), (EAST, east)];
            check(Neighbourhood::von_neumann_2d(1), [3, 3, 0], &named);
        }
        {
            use von_neumann::{CENTRE, DOWN, EAST, NORTH, SOUTH, UP, WEST};
            let named = [
                (CENTRE, [0; 3]),
                (SOUTH, south),
                (NORTH, north),
                (WEST, west),
                (EAST, east),
                (DOWN, down),
                (UP, up),
            ];
            check(Neighbourhood::von_neumann(1), [3, 3, 3], &named);
        }
        {
            use moore_2d::{
                CENTRE, EAST, NORTH, NORTH_EAST, NORTH_WEST, SOUTH, SOUTH_EAST, SOUTH_WEST, WEST,
            };
            let named = [
                (CENTRE, [0; 3]),
                (SOUTH, south),
                (NORTH, north),
                (WEST, west),
                (EAST, east),
                (SOUTH_WEST, south_west),
                (SOUTH_EAST, south_east),
                (NORTH_WEST, north_west),
                (NORTH_EAST, north_east),
            ];
            check(Neighbourhood::moore_2d(1), [3, 3, 0], &named);
        }
        let named = [
            (moore::CENTRE, [0; 3]),
            (moore::SOUTH, south),
            (moore::NORTH, north),
            (moore::WEST, west),
            (moore::EAST, east),
            (moore::SOUTH_WEST, south_west),
            (moore::SOUTH_EAST, south_east),
            (moore::NORTH_WEST, north_west),
            (moore::NORTH_EAST, north_east),
            (moore::DOWN, down),
            (moore::DOWN_SOUTH, along(down, south)),
            (moore::DOWN_NORTH, along(down, north)),
            (moore::DOWN_WEST, along(down, west)),
            (moore::DOWN_EAST, along(down, east)),
            (moore::DOWN_SOUTH_WEST, along(down, south_west)),
            (moore::DOWN_SOUTH_EAST, along(down, south_east)),
            (moore::DOWN_NORTH_WEST, along(down, north_west)),
            (moore::DOWN_NORTH_EAST, along(down, north_east)),
            (moore::UP, up),
            (moore::UP_SOUTH, along(up, south)),
            (moore::UP_NORTH, along(up, north)),
            (moore::UP_WEST, along(up, west)),
            (moore::UP_EAST, along(up, east)),
            (moore::UP_SOUTH_WEST, along(up, south_west)),
            (moore::UP_SOUTH_EAST, along(up, south_east)),
            (moore::UP_NORTH_WEST, along(up, north_west)),
            (moore::UP_NORTH_EAST, along(up, north_east)),
        ];
        check(Neighbourhood::moore(1), [3, 3, 3], &named);
        // Odd rows stand half a cell further east, odd columns half a cell further north.
        for odd in [0, 1] {
            use hexagonal::corner_up::{CENTRE, EAST, NORTH_EAST, NORTH_WEST, SOUTH_EAST, SOUTH_WEST, WEST};
            let step = odd as i32;
            let named = [
                (CENTRE, [0; 3]),
                (WEST, west),
                (EAST, east),
                (SOUTH_WEST, [step - 1, -1, 0]),
                (SOUTH_EAST, [step, -1, 0]),
                (NORTH_WEST, [step - 1, 1, 0]),
                (NORTH_EAST, [step, 1, 0]),
            ];
            check(Neighbourhood::hexagonal(Hexagons::CornerUp), [4, odd, 0], &named);
        }
        for odd in [0, 1] {
            use hexagonal::side_up::{CENTRE, NORTH, NORTH_EAST, NORTH_WEST, SOUTH, SOUTH_EAST, SOUTH_WEST};
            let step = odd as i32;
            let named = [
                (CENTRE, [0; 3]),
                (SOUTH, south),
                (NORTH, north),
                (SOUTH_WEST, [-1, step - 1, 0]),
                (NORTH_WEST, [-1, step, 0]),
                (SOUTH_EAST, [1, step - 1, 0]),
                (NORTH_EAST, [1, step, 0]),
            ];
            check(Neighbourhood::hexagonal(Hexagons::SideUp), [odd, 4, 0], &named);
        }
    }

    /// There and, by the opposite index, back again, from cells of every parity.
    #[test]
    fn opposites_lead_back() {
        let all = [
            Neighbourhood::von_neumann(2),
            Neighbourhood::moore(2),
            Neighbourhood::von_neumann_2d(3),
            Neighbourhood::moore_2d(1),
            Neighbourhood::hexagonal(Hexagons::CornerUp),
            Neighbourhood::hexagonal(Hexagons::SideUp),
        ];
        for neighbourhood in all {
            assert_eq!(neighbourhood.opposite(0), Some(0));
            assert_eq!(neighbourhood.opposite(neighbourhood.size()), None);
            assert_eq!(neighbourhood.without_opposite(), None);
            for cell in [[6, 6, 6], [7, 6, 6], [6, 7, 6], [7, 7, 6]] {
                for (index, step) in neighbourhood.displacements(cell).iter().enumerate() {
                    let there = [0, 1, 2].map(|axis| (cell[axis] as i32 + step[axis]) as usize);
                    let back = neighbourhood.opposite(index).unwrap();
                    assert_eq!(neighbourhood.displacements(there)[back], step.map(|along| -along));
                    assert_eq!(neighbourhood.opposite(back), Some(index));
                }
            }
        }
        let list = vec![[0, 0, 0], [1, 0, 0], [2, 1, 0], [-1, 0, 0], [i32::MIN, 0, 0]];
        let custom = Neighbourhood::custom(list).unwrap();
        assert_eq!([1, 2, 3, 4].map(|n| custom.opposite(n)), [Some(3), None, Some(1), None]);
        assert_eq!(custom.without_opposite(), Some([2, 1, 0]));
    }

    /// What kernels know of a shape is what the neighbourhood says.
    #[test]
    fn shapes_are_those_of_their_neighbourhoods() {
        let near = |[x, y, z]: &[i32; 3]| x * x + y * y + z * z <= 2;
        let cube = Neighbourhood::moore(1);
        let nineteen = cube.displacements([0; 3]).iter().copied().filter(near).collect();
        let known = [
            Neighbourhood::von_neumann_2d(1),
            Neighbourhood::von_neumann(1),
            Neighbourhood::moore_2d(1),
            Neighbourhood::custom(nineteen).unwrap(),
            cube,
            Neighbourhood::hexagonal(Hexagons::CornerUp),
            Neighbourhood::hexagonal(Hexagons::SideUp),
        ];
        for (neighbourhood, number) in known.iter().zip([1, 2, 3, 4, 5, 6, 6]) {
            assert_eq!(neighbourhood.shape(), number, "{neighbourhood}");
            let shape = shapes::shape(number);
            assert_eq!(shape.size, neighbourhood.size());
            if number != shapes::HEXAGONAL {
                assert_eq!(shape.displacements[..shape.size], *neighbourhood.displacements([0; 3]));
            }
            for index in 0..shape.size {
                assert_eq!(neighbourhood.opposite(index), Some(shape.opposite(index)));
            }
        }
        let turned = Neighbourhood::custom(vec![[0; 3], [1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]]);
        let others = [Neighbourhood::moore(2), Neighbourhood::moore_2d(0), turned.unwrap()];
        assert!(others.iter().all(|other| other.shape() == shapes::ANY));
    }

    #[test]
    fn custom_lists_are_checked() {
        assert_eq!(Neighbourhood::custom(vec![[1, 0, 0]]), Err(NeighbourhoodError::NoCentre));
        let twice = vec![[0, 0, 0], [1, 0, 0], [1, 0, 0]];
        assert_eq!(Neighbourhood::custom(twice), Err(NeighbourhoodError::Twice([1, 0, 0])));
    }
}
