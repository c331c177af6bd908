//! Renewal of the neighbour lists of a population.

use crate::ghosts::rows_at_borders;
use crate::layout::Layout;
use crate::listing::make;

use crate::lists::{Lists, Room, STRANGER, refill};
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
    population.make_lists(layout, geometry, within, room.rounding)?;
    let candidates = population.lists.as_ref().map_or(0, |lists| lists.entries.candidates.len());
    population.upkeep.made(within, start.elapsed(), items, candidates);
    Some(within - room.rounding)
}

impl Population {
    /// Removes the lists.
    fn forget_lists(&mut self) {
        self.lists = None;
        self.items.numbers = Vec::new();
        self.items.references = Vec::new();
    }

    /// Makes lists, in which the current places become the numbers. None if there are too many entries.
    fn make_lists(&mut self, layout: &Layout, geometry: &Geometry, within: f64, rounding: f64) -> Option<()> {
        let Lists { entries, mut places, mut bounds, .. } = self.lists.take().unwrap_or_default();
        self.store_references();
        let Some(entries) = make(self, layout, geometry, (within, rounding), entries) else {
            self.forget_lists();
            return None;
        };
        let mut number = 0..;
        let own_places = self.own_places();
        refill(&mut places, own_places, || number.next().unwrap_or(STRANGER));
        self.items.numbers.clone_from(&places);
        self.items.numbers.resize(self.items.labels.len(), STRANGER);
        refill(&mut bounds, entries.candidates.len(), AtomicU32::default);
        let in_cells = rows_at_borders(layout);
        self.lists = Some(Lists {
            made_within: within,
            entries,
            places,
            bounds,
            in_cells,
            rounding,
            ..Lists::default()
        });
        Some(())
    }
}
