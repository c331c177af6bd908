//! Neighbourhoods: which cells a cell sees.

use shapes::ShapeNumber;
use std::collections::HashMap;
use std::fmt;

#[doc(hidden)]
pub mod shapes;

/// The cells that a process sees, as displacements from the central cell. The central cell has index 0.
///
/// ```
/// use xca_core::prelude::*;
///
/// let cross = Neighbourhood::von_neumann_2d(1);
/// assert_eq!(cross.size(), 5);
/// let expected = [[0, 0, 0], [0, -1, 0], [-1, 0, 0], [1, 0, 0], [0, 1, 0]];
/// assert_eq!(cross.displacements([0, 0, 0]), expected);
///
/// let knight = Neighbourhood::custom(vec![[0, 0, 0], [1, 2, 0], [-1, -2, 0]])?;
/// assert_eq!(knight.reach(), [1, 2, 0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Ready-made neighbourhoods sort the other cells by z, then y, then x, from the negative to the positive
/// side. The seven of [`Neighbourhood::von_neumann`] are centre, -z, -y, -x, +x, +y, +z.
/// [`crate::directions`] has names for the indices. [`Hexagons::SideUp`] sorts by z, then x, then y, so that
/// an index means the same direction in all columns. A custom list keeps its order.
#[derive(Clone, PartialEq, Eq)]
pub struct Neighbourhood {
    name: String,
    /// For cells in even and in odd rows (or columns): the same list except in hexagonal grids.
    displacements: [Vec<[i32; 3]>; 2],
    parity: Parity,
    /// The index of the opposite direction for each index, the same for all cells.
    opposites: Vec<Option<usize>>,
    shape: ShapeNumber,
}

/// The rows or columns in which displacements differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Parity {
    /// All cells have the same displacements.
    None,
    /// Even and odd rows (y) differ.
    Row,
    /// Even and odd columns (x) differ.
    Column,
}

/// The orientation of the hexagons in a hexagonal grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Hexagons {
    /// A corner points up. Cells form straight rows; odd rows are shifted half a cell towards +x.
    CornerUp,
    /// A side is up. Cells form straight columns; odd columns are shifted half a cell towards +y.
    SideUp,
}

/// An invalid list of displacements.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NeighbourhoodError {
    /// The first displacement is not the central cell.
    #[error("a neighbourhood starts with the central cell: put [0, 0, 0] first")]
    NoCentre,
    /// A displacement is listed twice.
    #[error("the displacement {0:?} stands twice in the neighbourhood")]
    Twice([i32; 3]),
}

impl Neighbourhood {
    /// The cells at most `radius` steps away along the axes: 7 for radius 1.
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

    /// The six touching hexagons of a cell in one layer, and the cell itself.
    ///
    /// ```
    /// use xca_core::prelude::*;
    ///
    /// let hexagons = Neighbourhood::hexagonal(Hexagons::CornerUp);
    /// let east = directions::hexagonal::corner_up::EAST;
    /// assert_eq!(hexagons.displacements([4, 7, 0])[east], [1, 0, 0]);
    /// ```
    ///
    /// An index means the same direction in all rows or columns. With a corner up, the two cells below come
    /// first, then those at the sides, then the two above. With a side up, x and y are exchanged.
    pub fn hexagonal(hexagons: Hexagons) -> Self {
        // In even rows, the neighbours below and above are at x - 1 and x. In odd rows they are at x and x +
        // 1.
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

    /// Any list of displacements. The first is the central cell.
    ///
    /// # Errors
    /// Returns an error if the first displacement is not `[0, 0, 0]`, or one is listed twice.
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

    /// The number of cells, including the central one.
    pub fn size(&self) -> usize {
        self.displacements[0].len()
    }

    /// The displacements along x, y, z, for a cell with these indices.
    pub fn displacements(&self, cell: [usize; 3]) -> &[[i32; 3]] {
        let odd = match self.parity {
            Parity::None => 0,
            Parity::Row => cell[1] % 2,
            Parity::Column => cell[0] % 2,
        };
        &self.displacements[odd]
    }

    /// The index of the neighbour at a displacement from the cell, or `None`. Only hexagonal grids depend on
    /// the cell.
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

    /// The index of the opposite direction: neighbour `index` sees the cell under this index. 0 for 0.
    ///
    /// `None` if a custom neighbourhood lacks the opposite displacement, and for an index beyond the
    /// neighbourhood.
    pub fn opposite(&self, index: usize) -> Option<usize> {
        self.opposites.get(index).copied().flatten()
    }

    /// [`Self::opposite`] for each index.
    #[doc(hidden)]
    pub fn opposites(&self) -> &[Option<usize>] {
        &self.opposites
    }

    /// The shape for kernels.
    #[doc(hidden)]
    pub fn shape(&self) -> ShapeNumber {
        self.shape
    }

    /// The first displacement whose opposite is missing.
    pub fn without_opposite(&self) -> Option<[i32; 3]> {
        let first = self.opposites.iter().position(Option::is_none)?;
        self.displacements[0].get(first).copied()
    }

    /// The rows or columns in which displacements differ.
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

/// The opposite of each index. The list of the neighbour's row or column contains the reversed displacement.
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
        // A displacement that cannot be negated has no opposite.
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
mod tests;
