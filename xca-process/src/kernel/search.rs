//! The search for other items.
//!
//! The result depends only on the current positions. It is the items of the searched cells at a distance
//! below the radius, sorted by neighbour index, then label. An engine may therefore skip cells that are too
//! far away ([`CellFilter`]).

use super::near::Walk;
use super::wide::{self, Wide};
use super::{Column, Memory, MemoryOf, Row, WRONG_RADIUS, announce, announce_bytes};
use crate::float::Float;
use crate::geometry::Geometry;
use crate::neighbourhood::Parity;
use std::cell::RefCell;
use std::ops::Range;
use xca_values::Precision;
use xca_values::Vector3;

/// The cells to search, as constants for the macros.
pub mod reach {
    /// The own cell.
    pub const CELL: u8 = 0;
    /// The neighbours.
    pub const NEIGHBOURS: u8 = 1;
    /// Both.
    pub const ALL: u8 = 2;
}

/// Buffers for the results of searches, kept from row to row.
#[derive(Debug, Default)]
pub struct Scratch {
    free: RefCell<Vec<Vec<u32>>>,
    pub(super) walk: RefCell<Walk>,
}

/// A buffer borrowed from a [`Scratch`].
#[derive(Debug)]
pub struct Found<'a> {
    /// The places of the items.
    pub items: Vec<u32>,
    scratch: &'a Scratch,
}

impl Drop for Found<'_> {
    fn drop(&mut self) {
        self.scratch.free.borrow_mut().push(std::mem::take(&mut self.items));
    }
}

/// Finds the cells of a neighbourhood that can hold items within a radius of a position, and contiguous
/// ranges of their items.
///
/// Every item is at most `slack` metres outside its cell. If the box of a cell is farther from the position
/// than radius plus slack, the cell holds no near item. With a radius of half a cell side this leaves 8 of 27
/// cells. Their items are in 4 contiguous ranges, one for each row.
#[derive(Debug, Clone)]
pub struct CellFilter {
    displacements: Vec<[i32; 3]>,
    reach: [i32; 3],
    /// The offsets of a step along y and along z, if the neighbourhood is a complete box.
    steps: Option<[isize; 2]>,
    /// Whether an axis is toroidal.
    torus: bool,
    /// The addition to every radius, in metres: the slack, and the margin for rounding.
    beyond: f64,
    /// The comparison of several items at a time, if the processor supports it.
    wide: Option<Wide>,
}

/// The lowest and highest displacements along each axis of the cells that a sphere can touch.
#[derive(Clone, Copy)]
struct Touched {
    low: [i32; 3],
    high: [i32; 3],
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
    fn touched(&self, cell: [u32; 3], side: f64, position: [f64; 3], radius: f64) -> Touched {
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
    fn contains(&self, displacement: [i32; 3]) -> bool {
        (0..3).all(|axis| (self.low[axis]..=self.high[axis]).contains(&displacement[axis]))
    }
}

impl<'a> Row<'a> {
    /// A buffer for the results of searches.
    pub fn found(&self) -> Found<'a> {
        let items = self.scratch.free.borrow_mut().pop().unwrap_or_default();
        Found { items, scratch: self.scratch }
    }

    /// Fills the buffer with the items of the searched cells, without the item itself.
    #[inline]
    pub fn others<const REACH: u8>(&self, cell: Column<'_>, item: usize, found: &mut Vec<u32>) {
        found.clear();
        self.ranges::<REACH>(cell, None, |range| {
            found.extend(range.filter(|&other| other != item).map(|other| other as u32));
        });
    }

    /// Fills the buffer with those items of the searched cells that are nearer to `position` than `radius`,
    /// without the item itself.
    #[inline]
    pub fn others_within<R: Float, const REACH: u8>(
        &self,
        cell: Column<'_>,
        item: usize,
        position: Vector3<R>,
        radius: R,
        positions: &[Vector3<R>],
        found: &mut Vec<u32>,
    ) {
        found.clear();
        let bits = radius.to_f64().to_bits();
        if self.is_walked(bits) {
            return self.walked::<REACH>(cell, item, found);
        }
        if !self.allows::<R, REACH>(cell.number(), item, radius) {
            return;
        }
        self.widest.set(self.widest.get().max(radius.to_f64()));
        if self.has_walked() {
            // Not the radius of the row: items may each have their own.
            if self.listed::<R, REACH>(cell, item, radius, positions, found) {
                return;
            }
        } else if self.walk(radius, positions) {
            return self.walked::<REACH>(cell, item, found);
        }
        self.unlisted_within::<R, REACH>(cell, item, position, radius, positions, found);
    }

    /// The largest radius of a search so far.
    pub fn widest_search(&self) -> f64 {
        self.widest.get()
    }

    /// The same search in the cells.
    #[inline(always)]
    fn unlisted_within<R: Float, const REACH: u8>(
        &self,
        cell: Column<'_>,
        item: usize,
        position: Vector3<R>,
        radius: R,
        positions: &[Vector3<R>],
        found: &mut Vec<u32>,
    ) {
        let reach = radius * radius;
        let touched = match self.frame.filter {
            Some(filter) if REACH != reach::CELL => {
                let [first, y, z] = self.origin;
                let Vector3 { x: across, y: along, z: up } = position.map(Float::to_f64);
                let place = [across, along, up];
                let indices = [first + cell.number() as u32, y, z];
                Some((filter, filter.touched(indices, self.frame.side, place, radius.to_f64())))
            }
            _ => None,
        };
        if self.frame.toroidal.contains(&true) {
            self.ranges::<REACH>(cell, touched, |range| {
                keep(range, item, positions, found, |other| {
                    length_squared(self.space::<R>(&self.draws()).nearest_image(position - other)) < reach
                });
            });
        } else if let (Some((CellFilter { wide: Some(wide), .. }, _)), Precision::F64) =
            (touched, R::PRECISION)
        {
            let (positions, place) = (bytemuck::cast_slice(positions), position.map(Float::to_f64));
            let sphere = wide::Sphere { centre: place, square: reach.to_f64() };
            self.ranges::<REACH>(cell, touched, |range| wide.keep(range, item, positions, sphere, found));
        } else {
            self.ranges::<REACH>(cell, touched, |range| {
                keep(range, item, positions, found, |other| length_squared(position - other) < reach);
            });
        }
    }

    /// Checks the radius of a search. A radius that is negative, NaN, or larger than the neighbourhood covers
    /// is a fault. The result does not depend on the positions of items.
    #[inline(always)]
    fn allows<R: Float, const REACH: u8>(&self, x: usize, item: usize, radius: R) -> bool {
        let covered = R::from_f64(self.frame.geometry.covered_radius(R::PRECISION));
        let allowed = radius >= R::from_f64(0.0) && (REACH == reach::CELL || radius <= covered);
        if !allowed {
            self.report(x, Some(self.label(item)), WRONG_RADIUS, radius);
        }
        allowed
    }

    /// Passes on the ranges of items in the searched cells, sorted by neighbour index. Skips cells that the
    /// sphere does not touch, if that is known. Joins contiguous ranges.
    #[inline(always)]
    fn ranges<const REACH: u8>(
        &self,
        cell: Column<'_>,
        touched: Option<(&CellFilter, Touched)>,
        mut each: impl FnMut(Range<usize>),
    ) {
        if REACH != reach::NEIGHBOURS {
            each(self.items(cell));
        }
        if REACH == reach::CELL {
            return;
        }
        let Some((filter, touched)) = touched else {
            return self.joined(cell, |_| true, each);
        };
        let margin = filter.reach[0] as usize;
        let place = self.origin[0] as usize + cell.number();
        match filter.steps {
            Some(steps) if place >= margin && place + margin < self.frame.extents[0] as usize => {
                self.strips(cell, steps, touched, each);
            }
            _ => self.joined(cell, |number| touched.contains(filter.displacements[number]), each),
        }
    }

    /// The neighbours in a complete box, away from the halo along x. The touched cells of a row are
    /// contiguous.
    #[inline(always)]
    fn strips(
        &self,
        cell: Column<'_>,
        [line, layer]: [isize; 2],
        touched: Touched,
        mut each: impl FnMut(Range<usize>),
    ) {
        let (low, high) = (touched.low[0] as isize, touched.high[0] as isize);
        // SAFETY: what is touched lies in the box of the neighbourhood, whose cells are these steps apart.
        let items_at = |distance| unsafe { self.items_at(cell, distance) };
        for z in touched.low[2]..=touched.high[2] {
            for y in touched.low[1]..=touched.high[1] {
                let row = z as isize * layer + y as isize * line;
                if row != 0 {
                    each(items_at(row + low).start..items_at(row + high).end);
                } else {
                    // Split at the own cell, which is not its own neighbour.
                    let own = self.items(cell);
                    each(items_at(low).start..own.start);
                    each(own.end..items_at(high).end);
                }
            }
        }
    }

    /// Prefetches the positions that the next row's searches read first: those after the last row of the
    /// neighbourhood. The processor's own prefetcher cannot predict the jumps of searches.
    pub(super) fn fetch<R: Float>(&self, filter: &CellFilter, positions: &[Vector3<R>]) {
        let Some(&last) = self.frame.offsets.last() else { return };
        let end = self.length.saturating_sub(1 + filter.reach[0] as usize);
        // SAFETY: an offset of the neighbourhood.
        let [first, end] = [0, end].map(|number| unsafe { self.items_at(self.column(number), last) });
        // One row ahead, so that there is time to load them.
        let next = end.end..(2 * end.end).saturating_sub(first.start);
        let Some(row) = positions.get(next) else { return };
        announce_bytes(row.as_ptr().cast(), size_of_val(row));
    }

    /// Prefetches what the process reads from these items, which are far apart in memory.
    pub(super) fn announce(&self, places: &[u32]) {
        for entry in self.entries {
            let Memory { element, length, of: MemoryOf::Items { all: true, count } } = entry.memory else {
                continue;
            };
            for place in places.iter().map(|place| *place as usize).filter(|place| *place < count) {
                announce(entry.read.wrapping_add(place * element * length));
            }
        }
    }

    /// The wanted neighbours, one by one.
    #[inline]
    fn joined(&self, cell: Column<'_>, wanted: impl Fn(usize) -> bool, mut each: impl FnMut(Range<usize>)) {
        let mut joined = 0..0;
        for (number, offset) in self.frame.offsets.iter().enumerate().skip(1) {
            // SAFETY: an offset of the neighbourhood.
            let range = unsafe { self.items_at(cell, *offset) };
            if range.is_empty() || !wanted(number) {
                continue;
            }
            if joined.end == range.start && !joined.is_empty() {
                joined.end = range.end;
            } else {
                let before = std::mem::replace(&mut joined, range);
                each(before);
            }
        }
        each(joined);
    }
}

#[inline(always)]
pub(super) fn length_squared<R: Float>(vector: Vector3<R>) -> R {
    vector.x * vector.x + vector.y * vector.y + vector.z * vector.z
}

/// Adds the items of a range whose positions are near, without the item itself.
///
/// The processor cannot predict whether an item is near, so the loop has no branch on it. Each number is
/// written, and the list grows only if it is kept.
#[inline(always)]
pub(super) fn keep<R: Float>(
    range: Range<usize>,
    item: usize,
    positions: &[Vector3<R>],
    found: &mut Vec<u32>,
    near: impl Fn(Vector3<R>) -> bool,
) {
    // An empty range may lie anywhere.
    if range.is_empty() {
        return;
    }
    found.reserve(range.len());
    let first = range.start;
    let mut length = found.len();
    let places = found.as_mut_ptr();
    for (index, other) in positions[range].iter().enumerate() {
        let number = first + index;
        // SAFETY: `length` grows at most by one a turn, from the length before, and there is room for as many
        // as turns.
        unsafe { places.add(length).write(number as u32) };
        length += usize::from(near(*other) & (number != item));
    }
    // SAFETY: as above; all places below `length` have been written.
    unsafe { found.set_len(length) };
}
