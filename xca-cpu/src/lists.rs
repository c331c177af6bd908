//! Neighbour lists of items, kept over many passes.
//!
//! A list holds all items within a search radius plus a skin at the time of its construction. As long as no
//! two items have approached by more than the skin, searches in lists and in cells give the same result
//! ([`Lists::radius`]). Lists change the time of a search, but no result.
//!
//! In a part of a space, lists hold the part's own items alone. Ghosts are strangers, and so are items that
//! have arrived from other parts since. A row that sees a stranger is searched in cells, all others in lists.

use crate::arrays::Arrays;
use crate::layout::Layout;
use crate::motion::Motion;
use std::sync::atomic::AtomicU32;
use xca_core::Geometry;
use xca_core::kernel::{NO_PLACE, NearLists};

/// The number of an item that is in no list.
pub(crate) const STRANGER: u32 = u32::MAX;

/// The items that were near each item when the lists were made.
#[derive(Default)]
pub(crate) struct Lists {
    /// The radius at that time, in metres.
    pub(crate) made_within: f64,
    /// The place of the item with each number.
    pub(crate) places: Vec<u32>,
    pub(crate) entries: Entries,
    /// Whether each row is searched in cells.
    pub(crate) in_cells: Vec<bool>,
    /// The approximate common motion of all items since then.
    pub(crate) drift: [f64; 3],
    /// The approximate common motion in a pass.
    pub(crate) pace: [f64; 3],
    /// See [`NearLists`], as the two following.
    pub(crate) bounds: Vec<AtomicU32>,
    pub(crate) travelled: f64,
    pub(crate) rounding: f64,
    /// An upper limit, in metres, of how much two items have approached each other since then.
    pub(crate) approach: f64,
}

/// The lists of all items, by place.
#[derive(Default)]
pub(crate) struct Entries {
    /// The start of each list in `candidates`, then the length of that. A place without an item has an empty
    /// list.
    pub(crate) starts: Vec<u32>,
    pub(crate) candidates: Vec<u32>,
    /// The place that has the list of each candidate.
    pub(crate) owners: Vec<u32>,
}

/// The limits for neighbour lists.
pub(crate) struct Room {
    /// The largest radius that lists can have, in metres.
    pub(crate) widest: f64,
    /// The largest effect of rounding on a distance, in metres.
    pub(crate) rounding: f64,
}

impl Room {
    /// `widest` is the largest radius that the cells allow.
    pub(crate) fn new(widest: f64, geometry: &Geometry, motion: &Motion) -> Self {
        let extent = geometry.extents().into_iter().max().unwrap_or(0);
        let farthest = extent as f64 * geometry.side() + motion.slack;
        // References are stored in f32, and positions possibly too. Eight roundings are an upper limit.
        let rounding = 1e-6 * geometry.side() + 8.0 * f64::from(f32::EPSILON) * farthest;
        Self { widest, rounding }
    }
}

impl Lists {
    /// The largest radius, in metres, for which a search can use the lists.
    pub(crate) fn radius(&self, room: &Room) -> f64 {
        self.made_within - self.approach - room.rounding
    }

    /// The lists, for kernels.
    pub(crate) fn view<'a>(&'a self, items: &'a Arrays, radius: f64) -> NearLists<'a> {
        NearLists {
            numbers: &items.numbers,
            places: &self.places,
            starts: &self.entries.starts,
            candidates: &self.entries.candidates,
            owners: &self.entries.owners,
            cells: &items.cells,
            radius,
            bounds: &self.bounds,
            travelled: self.travelled,
            rounding: self.rounding,
        }
    }

    /// Follows the displacements of a pass.
    pub(crate) fn moved_in_pass(&mut self, motion: &Motion) {
        self.travelled += motion.approach();
        self.approach += motion.approach();
        if let Some(middle) = motion.middle() {
            for ((pace, drift), middle) in self.pace.iter_mut().zip(&mut self.drift).zip(middle) {
                *pace += middle;
                *drift += *pace;
            }
        }
    }

    /// Knows the displacements since the lists were made.
    pub(crate) fn measured(&mut self, motion: &Motion) {
        self.approach = motion.approach();
        if let Some(middle) = motion.middle() {
            self.drift.iter_mut().zip(middle).for_each(|(drift, middle)| *drift += middle);
        }
    }

    /// Whether the lists have all items that a row sees.
    pub(crate) fn are_whole(&self, row: usize) -> bool {
        !self.in_cells[row]
    }

    /// The size in bytes.
    pub(crate) fn memory(&self) -> usize {
        let Entries { starts, candidates, owners } = &self.entries;
        let numbers = [&self.places, starts, candidates, owners].map(Vec::capacity).iter().sum::<usize>();
        (numbers + self.bounds.capacity()) * size_of::<u32>() + self.in_cells.capacity()
    }

    /// Updates the places of the items of a row.
    pub(crate) fn moved(&mut self, numbers: &[u32], first: u32) {
        for (place, number) in (first..).zip(numbers) {
            self.put(*number, place);
        }
    }

    /// Records that an item has left the space, or the part of it.
    pub(crate) fn left(&mut self, number: u32) {
        self.put(number, NO_PLACE);
    }

    fn put(&mut self, number: u32, place: u32) {
        // A stranger has no entry.
        if let Some(entry) = self.places.get_mut(number as usize) {
            *entry = place;
        }
    }

    /// Records a stranger in a row.
    pub(crate) fn met_stranger(&mut self, layout: &Layout, row: usize) {
        layout.rows_around(row).for_each(|row| self.in_cells[row] = true);
    }
}

/// Gives a vector new values. Its memory is used again, because large pieces that come and go leave holes
/// that no one can use. It gets a quarter more than it needs.
pub(crate) fn refill<T>(values: &mut Vec<T>, length: usize, value: impl FnMut() -> T) {
    values.clear();
    if values.capacity() < length {
        *values = Vec::new();
        values.reserve_exact(length + length / 4);
    }
    values.resize_with(length, value);
}
