//! Searches in neighbour lists that an engine keeps over many passes.
//!
//! A list holds for each item all items within some radius when it was made. The radius is larger than that
//! of searches. As long as no two items can have approached by more than the difference, searches in lists
//! and in cells give the same result. Lists refer to items by numbers, which do not change when items move in
//! memory.

use super::distance::length_squared;
use super::walk::{Key, Share, Walk};
use super::{CellFilter, Column, NearLists, Row, RowItems, reach};
use crate::float::Float;
use xca_values::Vector3;

/// The inputs of a search by lists.
struct Lists<'a> {
    items: &'a RowItems<'a>,
    near: &'a NearLists<'a>,
    filter: &'a CellFilter,
    /// Whether all items within the radius are in cells of the neighbourhood, sorted by place.
    plain: bool,
}

impl Row<'_> {
    /// Whether the results of searches within this radius are stored. `bits` are the bits of the radius.
    #[inline(always)]
    pub(super) fn is_walked(&self, bits: u64) -> bool {
        self.walked.get() == Some(bits)
    }

    /// Whether the results of searches within some radius are stored.
    #[inline(always)]
    pub(super) fn has_walked(&self) -> bool {
        self.walked.get().is_some()
    }

    /// The lists for this radius, if there are any. Includes whether all items within it are in cells of the
    /// neighbourhood.
    #[inline(always)]
    fn lists_within<R: Float>(&self, radius: R) -> Option<Lists<'_>> {
        let items = self.items.as_ref()?;
        let near = items.near.filter(|near| radius.to_f64() <= near.radius)?;
        let filter = self.frame.filter?;
        let plain = filter.holds(self.frame.geometry.covered_radius(R::PRECISION), radius.to_f64());
        Some(Lists { items, near, filter, plain })
    }

    /// Finds the near items of one item by the lists. Not if cells must be compared.
    pub(super) fn listed<R: Float, const REACH: u8>(
        &self,
        cell: Column<'_>,
        item: usize,
        radius: R,
        positions: &[Vector3<R>],
        found: &mut Vec<u32>,
    ) -> bool {
        let Some(Lists { near, plain: true, .. }) = self.lists_within(radius) else { return false };
        let number = near.numbers[item] as usize;
        let own = self.items(cell);
        let square = radius * radius;
        for candidate in &near.candidates[near.starts[number] as usize..near.starts[number + 1] as usize] {
            let place = near.places[*candidate as usize];
            let Some(other) = positions.get(place as usize) else { continue };
            let here = own.contains(&(place as usize));
            let wanted = REACH == reach::ALL || here == (REACH == reach::CELL);
            if wanted && length_squared(positions[item] - *other) < square {
                found.push(place);
            }
        }
        found.sort_unstable_by_key(|place| (!own.contains(&(*place as usize)), *place));
        true
    }

    /// Finds the near items of all items of the row, if there are lists for this radius.
    #[inline(never)]
    pub(super) fn walk<R: Float>(&self, radius: R, positions: &[Vector3<R>]) -> bool {
        let Some(Lists { items, near, filter, plain }) = self.lists_within(radius) else { return false };
        let key =
            Key { positions: positions.as_ptr() as usize, own: items.own, radius: radius.to_f64().to_bits() };
        self.walked.set(Some(key.radius));
        let mut walk = self.scratch.walk.borrow_mut();
        if walk.key.as_ref() == Some(&key) {
            return true;
        }
        walk.key = Some(key);
        let walk = &mut *walk;
        if self.frame.toroidal.contains(&true) {
            let draws = self.draws();
            let space = self.space::<R>(&draws);
            walk.fill(items, near, positions, radius, |one, other| {
                length_squared(space.nearest_image(one - other))
            });
        } else {
            walk.fill(items, near, positions, radius, |one, other| length_squared(one - other));
        }
        walk.ordered = !plain;
        if plain {
            walk.sort();
        } else {
            self.order(near, filter, walk);
        }
        walk.starts.clear();
        (walk.is_split, walk.is_joined) = (false, false);
        self.announce(&walk.all.near, positions.as_ptr().cast());
        true
    }

    /// Adds the stored near items of one item.
    #[inline(always)]
    pub(super) fn walked<const REACH: u8>(&self, cell: Column<'_>, item: usize, found: &mut Vec<u32>) {
        let mut walk = self.scratch.walk.borrow_mut();
        walk.count(self.own_items());
        let number = item - self.first_item();
        let (start, end) = (walk.starts[number] as usize, walk.starts[number + 1] as usize);
        if start == end {
            return;
        }
        let near = &walk.all.near[start..end];
        let own = self.items(cell);
        // The items of the own cell are contiguous: in the middle by place, or first.
        let count =
            |wanted: &dyn Fn(usize) -> bool| near.iter().filter(|place| wanted(**place as usize)).count();
        let before = if walk.ordered { 0 } else { count(&|place| place < own.start) };
        let (before, rest) = near.split_at(before);
        let (here, after) = rest.split_at(count(&|place| own.contains(&place)));
        if REACH != reach::NEIGHBOURS {
            found.extend_from_slice(here);
        }
        if REACH != reach::CELL {
            found.extend_from_slice(before);
            found.extend_from_slice(after);
        }
    }

    /// Removes items outside the cells of the neighbourhood. Sorts the others by neighbour index, then label.
    #[cold]
    fn order(&self, near: &NearLists<'_>, filter: &CellFilter, walk: &mut Walk) {
        let geometry = self.frame.geometry;
        let indices = |place: usize| geometry.indices(near.cells[place] as usize).map(|index| index as i32);
        let (extents, toroidal, first) = (self.frame.extents, self.frame.toroidal, self.first_item());
        let Share { near: near_items, owners } = &mut walk.all;
        let mut ordered: Vec<(u32, usize, u32)> = Vec::with_capacity(near_items.len());
        for (&owner, &place) in owners.iter().zip(&*near_items) {
            let (here, there) = (indices(first + owner as usize), indices(place as usize));
            let displacement = std::array::from_fn(|axis| {
                let (step, extent) = (there[axis] - here[axis], extents[axis] as i32);
                match toroidal[axis] {
                    true if 2 * step > extent => step - extent,
                    true if 2 * step < -extent => step + extent,
                    _ => step,
                }
            });
            if let Some(number) = filter.number(displacement) {
                ordered.push((owner, number, place));
            }
        }
        ordered.sort_unstable();
        owners.clear();
        near_items.clear();
        for (owner, _, place) in ordered {
            owners.push(owner);
            near_items.push(place);
        }
    }
}
