//! Renewal of the neighbour lists of a population.

use crate::ghosts::rows_at_borders;
use crate::layout::Layout;
use crate::listing::{Listed, make};
use crate::lists::{Lists, Room, STRANGER};
use crate::population::Population;
use std::sync::atomic::AtomicU32;
use std::time::Instant;
use xca_core::Geometry;

/// Keeps the lists of a population usable for the next pass, or removes them. Returns the largest radius for
/// which searches can use them.
pub(crate) fn keep_lists(
    population: &mut Population,
    layout: &Layout,
    geometry: &Geometry,
    room: &Room,
) -> Option<f64> {
    let widest = population.upkeep.widest();
    if widest <= 0.0 {
        return None;
    }
    if let Some(lists) = &mut population.lists {
        lists.rounding = room.rounding;
        if lists.radius(room) >= widest {
            return Some(lists.radius(room));
        }
    }
    if population.lists.is_some() {
        let motion = population.measure(layout, geometry);
        if let Some(lists) = &mut population.lists {
            lists.measured(&motion);
            if lists.radius(room) >= widest {
                return Some(lists.radius(room));
            }
        }
        population.upkeep.learn();
    }
    let items = population.count();
    let Some(within) = population.upkeep.next_radius(items, room) else {
        population.forget_lists();
        return None;
    };
    let start = Instant::now();
    population.lists = None;
    let listed = make(population, layout, geometry, within + room.rounding);
    let kept = population.store_lists(layout, &listed, within, room.rounding);
    let candidates = population.lists.as_ref().map_or(0, |lists| lists.candidates.len());
    population.upkeep.made(within, start.elapsed(), items, candidates);
    kept.then_some(within - room.rounding)
}

impl Population {
    /// Removes the lists.
    fn forget_lists(&mut self) {
        self.lists = None;
        self.items.numbers = Vec::new();
        self.items.references = Vec::new();
    }

    /// Stores lists of all rows in order. Returns `false` if there are too many entries.
    fn store_lists(&mut self, layout: &Layout, listed: &[Listed], made_within: f64, rounding: f64) -> bool {
        let places = self.own_places();
        let total: usize = listed.iter().map(|listed| listed.list.len()).sum();
        if u32::try_from(total).is_err() {
            self.forget_lists();
            return false;
        }
        // The current places become the numbers. A place without an item has an empty list.
        let mut starts = Vec::with_capacity(places + 1);
        let mut candidates = Vec::with_capacity(total);
        let mut owners = Vec::with_capacity(total);
        let mut end = 0;
        let mut occupied = self.places().flatten();
        for Listed { list, ends } in listed {
            let before = candidates.len() as u32;
            // The order matters: `zip` takes a place only if there is an end for it.
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
        self.items.numbers.resize(self.items.labels.len(), STRANGER);
        self.items.references = self.references();
        self.lists = Some(Lists {
            made_within,
            places: (0..places as u32).collect(),
            starts,
            candidates,
            owners,
            in_cells: rows_at_borders(layout),
            drift: [0.0; 3],
            pace: [0.0; 3],
            bounds: std::iter::repeat_with(AtomicU32::default).take(total).collect(),
            travelled: 0.0,
            rounding,
            approach: 0.0,
        });
        true
    }
}
