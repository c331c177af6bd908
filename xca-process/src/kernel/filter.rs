//! The cells that a search can skip.

use super::wide::Wide;
use xca_space::{Geometry, Parity};
use xca_values::Precision;

/// Finds the cells of a neighbourhood that can hold items within a radius of a position, and contiguous
/// ranges of their items.
///
/// Every item is at most `slack` metres outside its cell. If the box of a cell is farther from the position
/// than radius plus slack, the cell holds no near item. With a radius of half a cell side this leaves 8 of 27
/// cells. Their items are in 4 contiguous ranges, one for each row.
#[derive(Debug, Clone)]
pub struct CellFilter {
    pub(super) displacements: Vec<[i32; 3]>,
    pub(super) reach: [i32; 3],
    /// The offsets of a step along y and along z, if the neighbourhood is a complete box.
    pub(super) steps: Option<[isize; 2]>,
    /// Whether an axis is toroidal.
    torus: bool,
    /// The addition to every radius, in metres: the slack, and the margin for rounding.
    beyond: f64,
    /// The comparison of several items at a time, if the processor supports it.
    pub(super) wide: Option<Wide>,
}

/// The lowest and highest displacements along each axis of the cells that a sphere can touch.
#[derive(Clone, Copy)]
pub(super) struct Touched {
    pub(super) low: [i32; 3],
    pub(super) high: [i32; 3],
}

impl CellFilter {
    /// A filter for items at most `slack` metres outside their cells. `None` if cells differ in their
    /// neighbourhood, or if `slack` is not finite or too large for a torus.
    ///
    /// `steps` are the offsets from a cell to the next one along y and along z. An engine with this filter
    /// must store the items of each row of the space contiguously, in the order of its cells.
    pub fn new(geometry: &Geometry, precision: Precision, steps: [isize; 2], slack: f64) -> Option<Self> {
        let neighbourhood = geometry.neighbourhood();
        // On a torus, an item far outside its cell may be near to items on the far side. A sphere around the
        // item does not reach these.
        let far_side = geometry.toroidal().contains(&true) && slack > SLACK_ROUND_TORUS * geometry.side();
        if !slack.is_finite() || far_side || neighbourhood.parity() != Parity::None {
            return None;
        }
        let reach = neighbourhood.reach();
        let size = reach.iter().map(|reach| 2 * reach + 1).product::<usize>();
        let displacements = neighbourhood.displacements([0; 3]).to_vec();
        // The centre comes first, then the others as in a complete box.
        let ordered = displacements[1..].is_sorted_by_key(|[x, y, z]| [*z, *y, *x]);
        let steps = (displacements.len() == size && ordered).then_some(steps);
        Some(Self {
            displacements,
            reach: reach.map(|reach| reach as i32),
            steps,
            torus: geometry.toroidal().contains(&true),
            beyond: slack + margin(geometry, precision),
            wide: Wide::detect(),
        })
    }

    /// The largest distance in metres between items such that each is in a cell of the other's neighbourhood.
    /// `covered` is the largest radius of a search. `None` if the cells must be compared.
    pub fn room(&self, covered: f64) -> Option<f64> {
        self.steps.map(|_| covered - 2.0 * self.beyond)
    }

    /// Whether all items within this radius are in cells of the neighbourhood, and sorting by place gives the
    /// order of a search.
    #[inline(always)]
    pub(super) fn holds(&self, covered: f64, radius: f64) -> bool {
        !self.torus && radius <= covered - 2.0 * self.beyond
    }

    /// The neighbour index of a displacement.
    pub(super) fn number(&self, displacement: [i32; 3]) -> Option<usize> {
        self.displacements.iter().position(|one| *one == displacement)
    }

    /// The cells that a sphere can touch. Its centre is a position in the cell with these indices.
    #[inline(always)]
    pub(super) fn touched(&self, cell: [u32; 3], side: f64, position: [f64; 3], radius: f64) -> Touched {
        let radius = radius.abs() + self.beyond;
        let mut touched = Touched { low: [0; 3], high: [0; 3] };
        for axis in 0..3 {
            let first = f64::from(cell[axis]) * side;
            let (below, above) =
                (first - (position[axis] - radius), (position[axis] + radius) - (first + side));
            for step in 0..self.reach[axis] {
                let distance = f64::from(step) * side;
                touched.low[axis] -= i32::from(below > distance);
                touched.high[axis] += i32::from(above >= distance);
            }
        }
        touched
    }
}

/// The largest slack with which a torus still allows skipping cells, in sides of a cell.
const SLACK_ROUND_TORUS: f64 = 1e-4;

/// The distance in metres that a cell needs beyond radius and slack, so that rounding cannot bring its items
/// near.
///
/// Consider a cell that is not touched along an axis. Between the position and every item of the cell lie at
/// least radius and margin. The item counts as near if `fl(d^2) < fl(r^2)`, where `d` is the computed vector.
/// Products and sums of non-negative numbers are rounded monotonically. The item is therefore not near if the
/// component of `d` along the axis is at least `r`. That component is:
/// - Without a torus, the rounded difference of two positions. It is at least `r` if the true one is, because
///   `r` is a number of the precision. `f64` also rounds the faces of cells, here and where the slack is
///   measured. This error is some units in the last place of the axis' length. It is below 1e-5 of a cell for
///   any number of cells that an index can count.
/// - On a torus of length L, possibly that difference and a period `n * side`. Each of the three is rounded,
///   and so are `side` and their sum. Each error is at most half an epsilon of L, and a slack more: in all
///   below 3 epsilon L. The item may also be compared the other way round. With 2 reach + 1 cells along the
///   axis, that way is no shorter than radius and margin, minus two slacks.
///
/// A thousandth of a cell is therefore enough for the faces and for two slacks of [`SLACK_ROUND_TORUS`]. For
/// the torus, 4 epsilon L are enough.
fn margin(geometry: &Geometry, precision: Precision) -> f64 {
    let epsilon = match precision {
        Precision::F32 => f64::from(f32::EPSILON),
        Precision::F64 => f64::EPSILON,
    };
    let axes = geometry.toroidal().into_iter().zip(geometry.extents());
    let cells = axes.filter(|(toroidal, _)| *toroidal).map(|(_, extent)| extent).max();
    (1e-3 + 4.0 * epsilon * cells.unwrap_or(0) as f64) * geometry.side()
}

impl Touched {
    pub(super) fn contains(&self, displacement: [i32; 3]) -> bool {
        (0..3).all(|axis| (self.low[axis]..=self.high[axis]).contains(&displacement[axis]))
    }
}
