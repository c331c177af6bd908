//! The search for other items.
//!
//! The result depends only on the current positions. It is the items of the searched cells at a distance
//! below the radius, sorted by neighbour index, then label. An engine may therefore skip cells that are too
//! far away ([`CellFilter`]).
#![allow(unsafe_code)]

use super::distance::{keep, length_squared};
use super::filter::Touched;
use super::work::announce;
use super::{CellFilter, Column, Found, Memory, MemoryOf, Row, WRONG_RADIUS, reach, wide};
use crate::float::Float;
use std::ops::Range;
use xca_values::Precision;
use xca_values::Vector3;

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
        let allowed = self.is_allowed::<R, REACH>(radius);
        if !allowed {
            self.report(x, Some(self.label(item)), WRONG_RADIUS, radius);
        }
        allowed
    }

    /// Whether a search may have this radius.
    #[inline(always)]
    pub(super) fn is_allowed<R: Float, const REACH: u8>(&self, radius: R) -> bool {
        let covered = R::from_f64(self.frame.geometry.covered_radius(R::PRECISION));
        radius >= R::from_f64(0.0) && (REACH == reach::CELL || radius <= covered)
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

    /// Prefetches what the process reads from these items, which are far apart in memory. What stands at
    /// `known` has just been read.
    pub(super) fn announce(&self, places: &[u32], known: *const u8) {
        for entry in self.entries {
            let Memory { element, length, of: MemoryOf::Items { all: true, count } } = entry.memory else {
                continue;
            };
            // Values of one byte share few cache lines.
            if element * length == 1 || entry.read == known {
                continue;
            }
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
