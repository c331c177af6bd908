//! The search for other items.
//!
//! The result is defined by the present positions alone: the items of the reached cells that are nearer than the radius, in the order
//! neighbour index, then label. An engine may therefore leave out cells that are too far away ([`CellFilter`]).

use super::Row;
use crate::neighbourhood::{Neighbourhood, Parity};
use crate::value::Float;
use crate::vector::Vector3;
use std::cell::RefCell;
use std::ops::Range;

/// Where a search looks; the constants are those of the macros.
pub mod reach {
    /// The own cell.
    pub const CELL: u8 = 0;
    /// The neighbours.
    pub const NEIGHBOURS: u8 = 1;
    /// Both.
    pub const ALL: u8 = 2;
}

/// Lists that searches fill, kept from row to row.
#[derive(Debug, Default)]
pub struct Scratch {
    free: RefCell<Vec<Vec<u32>>>,
}

/// A list borrowed from a [`Scratch`].
#[derive(Debug)]
pub struct Found<'a> {
    /// The numbers of the items.
    pub items: Vec<u32>,
    scratch: &'a Scratch,
}

impl Drop for Found<'_> {
    fn drop(&mut self) {
        self.scratch.free.borrow_mut().push(std::mem::take(&mut self.items));
    }
}

/// Says which cells of a neighbourhood can hold items within a radius of a position.
///
/// Where every item is at most `slack` metres outside its cell, a cell whose box is further from the position than radius and slack
/// holds none. For a radius of half a cell side that leaves 8 of 27 cells on average.
#[derive(Debug, Clone)]
pub struct CellFilter {
    /// For each axis and displacement, from the most negative on, the neighbours with that displacement, one bit each.
    displaced: [Vec<u64>; 3],
    reach: [usize; 3],
    slack: f64,
}

impl CellFilter {
    /// For a neighbourhood of at most 64 cells that is the same for all cells.
    pub fn new(neighbourhood: &Neighbourhood) -> Option<Self> {
        if neighbourhood.size() > 64 || neighbourhood.parity() != Parity::None {
            return None;
        }
        let reach = neighbourhood.reach();
        let mut displaced = reach.map(|reach| vec![0; 2 * reach + 1]);
        for (number, displacement) in neighbourhood.displacements([0; 3]).iter().enumerate() {
            for axis in 0..3 {
                let place = (displacement[axis] + reach[axis] as i32) as usize;
                displaced[axis][place] |= 1 << number;
            }
        }
        Some(Self { displaced, reach, slack: 0.0 })
    }

    /// With items at most so far outside their cells, in metres; nothing where that is no number.
    #[must_use]
    pub fn with_slack(mut self, slack: f64) -> Option<Self> {
        self.slack = slack;
        slack.is_finite().then_some(self)
    }

    /// The neighbours, one bit each, that a sphere around a position in the cell with these indices can touch.
    #[inline(always)]
    fn touched(&self, cell: [u32; 3], side: f64, position: [f64; 3], radius: f64) -> u64 {
        // Rounding can put an item that lies on a face into the cell on either side of it, and the comparison of distances
        // rounds as well; a thousandth of a cell is more than both, in f32 up to some thousand cells along an axis.
        let radius = radius.abs() + self.slack + 1e-3 * side;
        let mut touched = u64::MAX;
        for axis in 0..3 {
            let reach = self.reach[axis];
            let low = f64::from(cell[axis]) * side;
            let (below, above) = (position[axis] - radius, position[axis] + radius);
            let mut along = self.displaced[axis][reach];
            for step in 0..reach {
                let distance = step as f64 * side;
                if below < low - distance {
                    along |= self.displaced[axis][reach - 1 - step];
                }
                if above >= low + side + distance {
                    along |= self.displaced[axis][reach + 1 + step];
                }
            }
            touched &= along;
        }
        touched
    }
}

impl<'a> Row<'a> {
    /// A list for the results of searches.
    pub fn found(&self) -> Found<'a> {
        let items = self.scratch.free.borrow_mut().pop().unwrap_or_default();
        Found { items, scratch: self.scratch }
    }

    /// Fills the list with the items of the reached cells of the neighbourhood, without the item itself.
    #[inline]
    pub fn others<const REACH: u8>(&self, x: usize, item: usize, found: &mut Vec<u32>) {
        found.clear();
        self.ranges::<REACH>(x, None, |range| {
            found.extend(range.filter(|&other| other != item).map(|other| other as u32));
        });
    }

    /// Fills the list with those items of the reached cells whose position is nearer to `position` than `radius`, without the
    /// item itself.
    #[inline]
    pub fn others_within<R: Float, const REACH: u8>(
        &self,
        x: usize,
        item: usize,
        position: Vector3<R>,
        radius: R,
        positions: &[Vector3<R>],
        found: &mut Vec<u32>,
    ) {
        found.clear();
        let touched = match self.frame.filter {
            Some(filter) if REACH != reach::CELL => {
                let [first, y, z] = self.origin;
                let place = [position.x, position.y, position.z].map(Float::to_f64);
                Some(filter.touched([first + x as u32, y, z], self.frame.side, place, radius.to_f64()))
            }
            _ => None,
        };
        let reach = radius * radius;
        if self.frame.toroidal.contains(&true) {
            self.ranges::<REACH>(x, touched, |range| {
                keep(range, item, positions, found, |other| {
                    length_squared(self.nearest_image(position - other)) < reach
                });
            });
        } else {
            self.ranges::<REACH>(x, touched, |range| {
                keep(range, item, positions, found, |other| length_squared(position - other) < reach);
            });
        }
    }

    /// Hands over the ranges of items in the reached cells (of those touched, where that is known) in order of the neighbour index, joined
    /// where one continues the other.
    #[inline(always)]
    fn ranges<const REACH: u8>(&self, x: usize, touched: Option<u64>, mut each: impl FnMut(Range<usize>)) {
        let mut joined = 0..0;
        let mut add = |number: usize| {
            let range = self.items_at(x, self.frame.offsets[number]);
            if range.is_empty() {
                return;
            }
            if joined.end == range.start && !joined.is_empty() {
                joined.end = range.end;
                return;
            }
            let before = std::mem::replace(&mut joined, range);
            if !before.is_empty() {
                each(before);
            }
        };
        let size = self.frame.offsets.len();
        match (REACH, touched) {
            (reach::CELL, _) => add(0),
            (_, Some(mut touched)) => {
                if REACH == reach::NEIGHBOURS {
                    touched &= !1;
                }
                while touched != 0 {
                    let number = touched.trailing_zeros() as usize;
                    touched &= touched - 1;
                    if number < size {
                        add(number);
                    }
                }
            }
            (reach::NEIGHBOURS, None) => (1..size).for_each(add),
            (_, None) => (0..size).for_each(add),
        }
        if !joined.is_empty() {
            each(joined);
        }
    }

    /// The separation by the shorter way round each toroidal axis.
    #[inline]
    fn nearest_image<R: Float>(&self, separation: Vector3<R>) -> Vector3<R> {
        let along = |value: R, axis: usize| {
            if !self.frame.toroidal[axis] {
                return value;
            }
            let period = R::from_f64(f64::from(self.frame.extents[axis])) * R::from_f64(self.frame.side);
            let half = R::from_f64(0.5) * period;
            if value > half {
                value - period
            } else if value < R::default() - half {
                value + period
            } else {
                value
            }
        };
        Vector3::new(along(separation.x, 0), along(separation.y, 1), along(separation.z, 2))
    }
}

#[inline(always)]
fn length_squared<R: Float>(vector: Vector3<R>) -> R {
    vector.x * vector.x + vector.y * vector.y + vector.z * vector.z
}

/// Adds the items of a range whose positions are near, without the item itself.
///
/// Whether an item is near is a toss of a coin for the processor, so there is no branch on it: each number is written, and the
/// list grows only where it is kept.
#[inline(always)]
fn keep<R: Float>(
    range: Range<usize>,
    item: usize,
    positions: &[Vector3<R>],
    found: &mut Vec<u32>,
    near: impl Fn(Vector3<R>) -> bool,
) {
    found.reserve(range.len());
    let first = range.start;
    let mut length = found.len();
    let places = found.as_mut_ptr();
    for (index, other) in positions[range].iter().enumerate() {
        let number = first + index;
        // SAFETY: `length` grows at most by one a turn, from the length before, and there is room for as many as turns.
        unsafe { places.add(length).write(number as u32) };
        length += usize::from(near(*other) & (number != item));
    }
    // SAFETY: as above; all places below `length` have been written.
    unsafe { found.set_len(length) };
}
