//! The initial state of the authors' runs: particles drawn at random in the bottom of the box, none in
//! contact.
//!
//! De Rango et al. (section IV) describe it in words: particles "randomly distributed" up to 20 % of the
//! height of the domain "in a way so that there are no collisions". The exact recipe below gives the 2,602
//! particles of their small system and the 315,979 ("about 316,000") of their benchmark, one by one. It has
//! two passes over the cells with z-index k <= 0.2 n_z, both with x outermost and z innermost.
//!
//! 1. **Draw.** A cell has 12 slots, of which each domain face that the cell touches takes one. For each
//!    other slot a number decides whether it is filled (3 in 4 are), and if so three more give the
//!    particle's place, uniform in the cell.
//! 2. **Thin out.** In the order in which they were drawn, particles that touch another one still standing,
//!    or that are within two radii of a domain face, are deleted.
//!
//! The second pass depends on the order: of two touching particles the first goes, and the later one stays
//! unless it touches a third.

mod error;
mod random;

pub use error::PlacementError;
use random::ReentrantRandom;

/// The slots of a cell in the authors' program. (The paper's own estimate, Kepler's bound, is 11.)
const SLOTS: u32 = 12;

/// The part of the domain's height, from the floor, that is filled.
const FILLED_HEIGHT: f64 = 0.2;

/// The probability that a free slot is filled.
const FILLED_SLOTS: f64 = 0.75;

/// A particle at rest in its initial place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placed {
    /// Its persistent label: 1, 2, 3, ... in the order of the cells, x outermost and z innermost.
    pub label: u32,
    /// Its centre, x, y and z, in m; the origin is the domain's lower corner.
    pub position: [f64; 3],
}

/// Places particles as the authors do (De Rango et al., section IV).
///
/// The domain has `cells` cells along x, y and z, each a cube of side `cell_side` (in m). Particles have this
/// `radius` (in m), and no two of the returned ones are within two radii of each other, nor any within two
/// radii of a domain face. (The authors' walls stand one radius inside the domain.) The authors' seed is 1.
///
/// ```
/// # fn main() -> Result<(), cadem::initial::PlacementError> {
/// let particles = cadem::initial::authors_placement([20, 20, 20], 0.002, 0.0005, 1)?;
/// assert_eq!(particles.len(), 2_602);
/// # Ok(())
/// # }
/// ```
///
/// # Errors
///
/// If a number of cells is zero, a length is not positive and finite, a particle is wider than a cell, or
/// there are more cells than labels could count.
pub fn authors_placement(
    cells: [usize; 3],
    cell_side: f64,
    radius: f64,
    seed: u32,
) -> Result<Vec<Placed>, PlacementError> {
    let region = Region::new(cells, cell_side, radius)?;
    let mut drawn = region.draw(seed);
    let mut standing = region.delete_touching(&mut drawn);
    standing.shrink_to_fit();
    Ok(standing)
}

/// The layers of cells that get particles, counted in scan order, and the lengths that decide about contacts.
struct Region {
    /// The cells of the whole domain.
    cells: [usize; 3],
    /// The layers that are filled, from the floor.
    layers: usize,
    /// The side of a cell, in m.
    cell_side: f64,
    /// Two radii, in m: nothing may be as near as this, be it a particle or a face of the domain.
    reach: f64,
}

/// The particles of the first pass, cell after cell in scan order.
struct Drawn {
    positions: Vec<[f64; 3]>,
    /// For each cell, where its particles start in `positions`.
    starts: Vec<usize>,
    /// For each cell, how many of its particles stand. They keep their order and come first.
    standing: Vec<usize>,
}

impl Drawn {
    fn standing_in(&self, cell: usize) -> &[[f64; 3]] {
        let start = self.starts[cell];
        &self.positions[start..start + self.standing[cell]]
    }
}

impl Region {
    fn new(cells: [usize; 3], cell_side: f64, radius: f64) -> Result<Self, PlacementError> {
        if cells.contains(&0) {
            return Err(PlacementError::NoCells { cells });
        }
        for (what, metres) in [("side of a cell", cell_side), ("radius of a particle", radius)] {
            if !(metres.is_finite() && metres > 0.0) {
                return Err(PlacementError::BadLength { what, metres });
            }
        }
        if 2.0 * radius > cell_side {
            return Err(PlacementError::WiderThanACell { radius, cell_side });
        }
        let slots = cells.iter().try_fold(u64::from(SLOTS), |product, &n| product.checked_mul(n as u64));
        if slots.is_none_or(|slots| slots > u64::from(u32::MAX)) {
            return Err(PlacementError::TooManyCells { cells, most: u32::MAX / SLOTS });
        }
        let layers = (0..cells[2]).take_while(|&k| k as f64 <= FILLED_HEIGHT * cells[2] as f64).count();
        Ok(Self { cells, layers, cell_side, reach: 2.0 * radius })
    }

    /// The indices of the filled cells, in scan order.
    fn scan(&self) -> impl Iterator<Item = [usize; 3]> + use<> {
        let ([nx, ny, _], layers) = (self.cells, self.layers);
        (0..nx).flat_map(move |i| (0..ny).flat_map(move |j| (0..layers).map(move |k| [i, j, k])))
    }

    /// The place of a filled cell in scan order.
    fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        (i * self.cells[1] + j) * self.layers + k
    }

    /// The first pass.
    fn draw(&self, seed: u32) -> Drawn {
        let mut random = ReentrantRandom::new(seed);
        let mut drawn = Drawn { positions: Vec::new(), starts: Vec::new(), standing: Vec::new() };
        for cell in self.scan() {
            let start = drawn.positions.len();
            for _ in self.faces_touched(cell)..SLOTS {
                if random.next_unit() < FILLED_SLOTS {
                    drawn.positions.push(cell.map(|c| (c as f64 + random.next_unit()) * self.cell_side));
                }
            }
            drawn.starts.push(start);
            drawn.standing.push(drawn.positions.len() - start);
        }
        drawn
    }

    /// How many faces of the domain a cell touches.
    fn faces_touched(&self, cell: [usize; 3]) -> u32 {
        (0..3).map(|axis| u32::from(cell[axis] == 0) + u32::from(cell[axis] + 1 == self.cells[axis])).sum()
    }

    /// The second pass.
    fn delete_touching(&self, drawn: &mut Drawn) -> Vec<Placed> {
        let mut result = Vec::new();
        for cell in self.scan() {
            let own = self.index(cell);
            let start = drawn.starts[own];
            let end = start + drawn.standing[own];
            let mut kept = start;
            for slot in start..end {
                let position = drawn.positions[slot];
                if self.touches_a_wall(position)
                    || self.touches_one_of(&drawn.positions[slot + 1..end], position)
                    || self.touches_a_neighbour(drawn, cell, position)
                {
                    continue;
                }
                drawn.positions[kept] = position;
                kept += 1;
                result.push(Placed { label: result.len() as u32 + 1, position });
            }
            drawn.standing[own] = kept - start;
        }
        result
    }

    fn touches_a_wall(&self, position: [f64; 3]) -> bool {
        (0..3).any(|axis| {
            let length = self.cells[axis] as f64 * self.cell_side;
            position[axis] <= self.reach || length - position[axis] <= self.reach
        })
    }

    fn touches_one_of(&self, others: &[[f64; 3]], [x, y, z]: [f64; 3]) -> bool {
        others.iter().any(|&[other_x, other_y, other_z]| {
            let (dx, dy, dz) = (x - other_x, y - other_y, z - other_z);
            dx * dx + dy * dy + dz * dz <= self.reach * self.reach
        })
    }

    /// Whether the particle touches one that stands in the (up to 26) cells around its own.
    ///
    /// The authors' neighbourhood is toroidal but their distances are not, so that cells across the domain
    /// never matter. They are left out.
    fn touches_a_neighbour(&self, drawn: &Drawn, cell: [usize; 3], position: [f64; 3]) -> bool {
        let bounds = [self.cells[0], self.cells[1], self.layers];
        let around = |axis: usize| cell[axis].saturating_sub(1)..(cell[axis] + 2).min(bounds[axis]);
        // The later cells first: they are still crowded, so that most searches end there.
        for i in around(0).rev() {
            for j in around(1).rev() {
                for k in around(2).rev() {
                    let other = [i, j, k];
                    if other != cell && self.touches_one_of(drawn.standing_in(self.index(other)), position) {
                        return true;
                    }
                }
            }
        }
        false
    }
}

#[cfg(test)]
mod tests;
