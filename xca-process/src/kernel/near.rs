//! Searches in neighbour lists that an engine keeps over many passes.
//!
//! A list holds for each item all items within some radius when it was made. The radius is larger than that
//! of searches. As long as no two items can have approached by more than the difference, searches in lists
//! and in cells give the same result. Lists refer to items by numbers, which do not change when items move in
//! memory.

use super::search::{CellFilter, reach};
use super::{Column, Row, RowItems, announce};
use crate::float::Float;
use xca_values::Vector3;

/// The place in [`NearLists::places`] of an item that has left the space.
pub const NO_PLACE: u32 = u32::MAX;

/// The neighbour list of each item.
#[derive(Debug, Clone, Copy)]
pub struct NearLists<'a> {
    /// The number of the item at each place.
    pub numbers: &'a [u32],
    /// The place of the item with each number, or [`NO_PLACE`].
    pub places: &'a [u32],
    /// The start of the list in `candidates` for each number, then the length of `candidates`.
    pub starts: &'a [u32],
    /// The numbers in all lists.
    pub candidates: &'a [u32],
    /// The owner of the list of each candidate, as a number.
    pub owners: &'a [u32],
    /// The linear index of the cell of the item at each place.
    pub cells: &'a [u32],
    /// A search within this radius, in metres, gives the same result in the lists as in the cells.
    pub radius: f64,
}

/// The results of all searches of a row, for reuse by other processes of the pass.
#[derive(Debug, Default)]
pub(super) struct Walk {
    key: Option<Key>,
    /// The start in `near` for each own item, then the length of `near`.
    starts: Vec<u32>,
    /// The places of near items.
    near: Vec<u32>,
    /// The index of the searching item among the row's own items.
    owners: Vec<u32>,
    /// Whether the near items are sorted by neighbour index, not by place.
    ordered: bool,
}

/// The properties that determine the result of a search.
#[derive(Debug, PartialEq)]
struct Key {
    positions: usize,
    own: (usize, usize),
    radius: u64,
}

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
            if wanted && super::search::length_squared(positions[item] - *other) < square {
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
        let square = radius * radius;
        self.fetch(filter, positions);
        if self.frame.toroidal.contains(&true) {
            let draws = self.draws();
            let space = self.space::<R>(&draws);
            walk.fill(items, near, positions, |one, other| {
                super::search::length_squared(space.nearest_image(one - other)) < square
            });
        } else {
            walk.fill(items, near, positions, |one, other| {
                super::search::length_squared(one - other) < square
            });
        }
        walk.ordered = !plain;
        if plain {
            walk.sort();
        } else {
            self.order(near, filter, walk);
        }
        walk.count(items.own.1 - items.own.0);
        self.announce(&walk.near);
        true
    }

    /// Adds the stored near items of one item.
    #[inline(always)]
    pub(super) fn walked<const REACH: u8>(&self, cell: Column<'_>, item: usize, found: &mut Vec<u32>) {
        let walk = self.scratch.walk.borrow();
        let number = item - self.first_item();
        let (start, end) = (walk.starts[number] as usize, walk.starts[number + 1] as usize);
        if start == end {
            return;
        }
        let near = &walk.near[start..end];
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
        let mut ordered: Vec<(u32, usize, u32)> = Vec::with_capacity(walk.near.len());
        for (&owner, &place) in walk.owners.iter().zip(&walk.near) {
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
        walk.owners.clear();
        walk.near.clear();
        for (owner, _, place) in ordered {
            walk.owners.push(owner);
            walk.near.push(place);
        }
    }
}

impl Walk {
    /// Finds the near items of each own item. Items with consecutive numbers have consecutive lists. One loop
    /// goes through these, without a branch on the owner or on the result.
    #[inline(always)]
    fn fill<R: Float>(
        &mut self,
        items: &RowItems<'_>,
        lists: &NearLists<'_>,
        positions: &[Vector3<R>],
        is_near: impl Fn(Vector3<R>, Vector3<R>) -> bool,
    ) {
        let (first, end) = items.own;
        let numbers = &lists.numbers[first..end];
        let own = &positions[first..end];
        let (mut length, mut start) = (0, 0);
        while start < numbers.len() {
            let base = numbers[start];
            let run =
                numbers[start..].iter().zip(base..).take_while(|(number, next)| *number == next).count();
            let (from, to) =
                (lists.starts[base as usize] as usize, lists.starts[base as usize + run] as usize);
            self.near.resize(length + to - from, 0);
            self.owners.resize(length + to - from, 0);
            let pairs = Pairs {
                candidates: &lists.candidates[from..to],
                owners: &lists.owners[from..to],
                base,
                own: &own[start..start + run],
                places: lists.places,
                positions,
            };
            let (near, owners) = (&mut self.near[length..], &mut self.owners[length..]);
            length += keep(pairs, start as u32, near, owners, &is_near);
            start += run;
        }
        self.near.truncate(length);
        self.owners.truncate(length);
    }

    /// Sorts the near items of each item by place. They are nearly sorted.
    fn sort(&mut self) {
        let mut start = 0;
        while start < self.owners.len() {
            let owner = self.owners[start];
            let count = self.owners[start..].iter().take_while(|other| **other == owner).count();
            let near = &mut self.near[start..start + count];
            if !near.is_sorted() {
                near.sort_unstable();
            }
            start += count;
        }
    }

    /// Stores the start of each item's results.
    fn count(&mut self, items: usize) {
        self.starts.clear();
        self.starts.resize(items + 1, 0);
        for owner in &self.owners {
            self.starts[*owner as usize + 1] += 1;
        }
        let mut sum = 0;
        for start in &mut self.starts {
            sum += *start;
            *start = sum;
        }
    }
}

/// The lists of consecutive items of a row.
struct Pairs<'a, R> {
    candidates: &'a [u32],
    owners: &'a [u32],
    /// The number of the first item.
    base: u32,
    /// The positions of the items.
    own: &'a [Vector3<R>],
    places: &'a [u32],
    positions: &'a [Vector3<R>],
}

/// Keeps the near pairs and returns their number. The output is an argument of its own, so that it does not
/// overlap the input.
#[inline(never)]
fn keep<R: Float>(
    Pairs { candidates, owners, base, own, places, positions }: Pairs<'_, R>,
    first: u32,
    near: &mut [u32],
    near_owners: &mut [u32],
    is_near: &impl Fn(Vector3<R>, Vector3<R>) -> bool,
) -> usize {
    // Look up all places first, so that the processor waits for many of them together.
    for (place, candidate) in near.iter_mut().zip(candidates) {
        *place = places[*candidate as usize];
        announce(positions.as_ptr().wrapping_add(*place as usize).cast());
    }
    let mut count = 0;
    for (number, owner) in owners.iter().enumerate() {
        let place = near[number];
        let owner = owner - base;
        // An item that has left the space has no place.
        let Some(other) = positions.get(place as usize) else { continue };
        near[count] = place;
        near_owners[count] = first + owner;
        count += usize::from(is_near(own[owner as usize], *other));
    }
    count
}
