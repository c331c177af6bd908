//! Lists of what is near each item, kept over many passes.
//!
//! They hold what was within a search's radius and a skin when they were made. While no two items have come
//! closer by more than the skin, a search in them finds what a search in the cells finds, to the last item
//! ([`Lists::radius`]). So they change time, and no result.

use crate::listing::Listed;
use crate::motion::Motion;
use crate::population::Population;
use xca_core::Geometry;
use xca_core::kernel::{NO_PLACE, NearLists};

/// For each item those that were near when the lists were made.
pub(crate) struct Lists {
    /// How near, in metres.
    made_within: f64,
    /// For each number of an item its place.
    pub(crate) places: Vec<u32>,
    pub(crate) starts: Vec<u32>,
    pub(crate) candidates: Vec<u32>,
    pub(crate) owners: Vec<u32>,
    /// How far all items have moved together, about, since then.
    pub(crate) drift: [f64; 3],
}

/// What a search may rely on.
pub(crate) struct Room {
    /// How far apart items may be that lists can have, in metres.
    pub(crate) widest: f64,
    /// What rounding can do to a distance, in metres.
    pub(crate) rounding: f64,
}

impl Room {
    /// `widest` is what the cells allow.
    pub(crate) fn new(widest: f64, geometry: &Geometry, motion: &Motion) -> Self {
        let extent = geometry.extents().into_iter().max().unwrap_or(0);
        let farthest = extent as f64 * geometry.side() + motion.slack;
        // References are kept in f32, positions perhaps too; eight roundings are more than there are.
        let rounding = 1e-6 * geometry.side() + 8.0 * f64::from(f32::EPSILON) * farthest;
        Self { widest, rounding }
    }
}

impl Lists {
    /// Within which radius, in metres, a search can use the lists.
    pub(crate) fn radius(&self, motion: &Motion, room: &Room) -> f64 {
        self.made_within - motion.approach() - room.rounding
    }

    /// As kernels see them.
    pub(crate) fn view<'a>(&'a self, population: &'a Population, radius: f64) -> NearLists<'a> {
        NearLists {
            numbers: &population.items.numbers,
            places: &self.places,
            starts: &self.starts,
            candidates: &self.candidates,
            owners: &self.owners,
            cells: &population.items.cells,
            radius,
        }
    }

    /// The bytes that they take.
    pub(crate) fn memory(&self) -> usize {
        (self.places.capacity() + self.starts.capacity() + 2 * self.candidates.capacity()) * size_of::<u32>()
    }

    /// Lets the items of a row be found where they are now.
    pub(crate) fn moved(&mut self, numbers: &[u32], first: u32) {
        for (place, number) in (first..).zip(numbers) {
            self.places[*number as usize] = place;
        }
    }

    /// An item has left the space.
    pub(crate) fn left(&mut self, number: u32) {
        self.places[number as usize] = NO_PLACE;
    }
}

impl Population {
    /// Does without lists.
    pub(crate) fn forget_lists(&mut self) {
        self.lists = None;
        self.items.numbers = Vec::new();
        self.items.references = Vec::new();
    }

    /// Keeps what has been listed, for all rows in order; not where there is too much to be counted.
    pub(crate) fn keep_lists(&mut self, listed: &[Listed], made_within: f64) -> bool {
        let places = self.items.labels.len();
        let total: usize = listed.iter().map(|listed| listed.list.len()).sum();
        if u32::try_from(total).is_err() {
            self.forget_lists();
            return false;
        }
        // The numbers are the places that items have now; where none is, the list is empty.
        let mut starts = Vec::with_capacity(places + 1);
        let mut candidates = Vec::with_capacity(total);
        let mut owners = Vec::with_capacity(total);
        let mut end = 0;
        let mut occupied = self.places().flatten();
        for Listed { list, ends } in listed {
            let before = candidates.len() as u32;
            // In this order: a place is taken only where there is an end for it.
            for (length, place) in ends.iter().zip(occupied.by_ref()) {
                starts.resize(place + 1, end);
                end = before + length;
                owners.resize(end as usize, place as u32);
            }
            candidates.extend_from_slice(list);
        }
        drop(occupied);
        starts.resize(places + 1, end);
        self.items.numbers = (0..places as u32).collect();
        self.items.references = self.references();
        self.lists = Some(Lists {
            made_within,
            places: (0..places as u32).collect(),
            starts,
            candidates,
            owners,
            drift: [0.0; 3],
        });
        true
    }
}
