//! The near items of all items of a row, found in neighbour lists.

use super::work::announce;
use super::{NearLists, RowItems};
use crate::float::Float;
use std::ops::Range;
use std::sync::atomic::Ordering;
use xca_values::Vector3;

/// The results of all searches of a row, for reuse by other processes of the pass.
#[derive(Debug, Default)]
pub(super) struct Walk {
    pub(super) key: Option<Key>,
    /// The start in `near` for each own item, then the length of `near`. Empty until it is needed.
    pub(super) starts: Vec<u32>,
    /// The places of near items.
    pub(super) near: Vec<u32>,
    /// The index of the searching item among the row's own items.
    pub(super) owners: Vec<u32>,
    /// Whether the near items are sorted by neighbour index, not by place.
    pub(super) ordered: bool,
    /// 1 for each own item with company, otherwise 0. See [`super::company`].
    pub(super) marks: Vec<u8>,
}

/// The number of pairs whose order is checked at a time.
const CHECKED: usize = 32;

/// The properties that determine the result of a search.
#[derive(Debug, PartialEq)]
pub(super) struct Key {
    pub(super) positions: usize,
    pub(super) own: (usize, usize),
    pub(super) radius: u64,
}

impl Walk {
    /// Finds the near items of each own item. Items with consecutive numbers have consecutive lists. One loop
    /// goes through these, without a branch on the owner or on the result.
    #[inline(always)]
    pub(super) fn fill<R: Float>(
        &mut self,
        items: &RowItems<'_>,
        lists: &NearLists<'_>,
        positions: &[Vector3<R>],
        radius: R,
        square: impl Fn(Vector3<R>, Vector3<R>) -> R,
    ) {
        let (first, end) = items.own;
        let numbers = &lists.numbers[first..end];
        let own = &positions[first..end];
        let limit = lists.limit(radius.to_f64());
        let (mut length, mut start) = (0, 0);
        while start < numbers.len() {
            let base = numbers[start];
            let run =
                numbers[start..].iter().zip(base..).take_while(|(number, next)| *number == next).count();
            let listed = lists.starts[base as usize] as usize..lists.starts[base as usize + run] as usize;
            self.near.resize(length + listed.len(), 0);
            self.owners.resize(length + listed.len(), 0);
            let own = &own[start..start + run];
            let pairs = Pairs { lists, listed, base, own, positions, radius, limit };
            let (near, owners) = (&mut self.near[length..], &mut self.owners[length..]);
            length += keep(pairs, start as u32, near, owners, &square);
            start += run;
        }
        self.near.truncate(length);
        self.owners.truncate(length);
    }

    /// Sorts the near items of each item by place. They are nearly sorted.
    pub(super) fn sort(&mut self) {
        let Self { near, owners, .. } = self;
        for first in (1..near.len()).step_by(CHECKED) {
            let end = near.len().min(first + CHECKED);
            // Without a branch, so that the compiler compares many at once.
            let pairs = near[first - 1..end].windows(2).zip(owners[first - 1..end].windows(2));
            let is_sorted = pairs.fold(true, |sorted, (near, owners)| {
                sorted & ((near[0] <= near[1]) | (owners[0] != owners[1]))
            });
            if is_sorted {
                continue;
            }
            for index in first..end {
                let owner = owners[index];
                if owners[index - 1] == owner && near[index - 1] > near[index] {
                    let start = owners.partition_point(|other| *other < owner);
                    let end = owners.partition_point(|other| *other <= owner);
                    near[start..end].sort_unstable();
                }
            }
        }
    }

    /// Stores the start of each item's results.
    pub(super) fn count(&mut self, items: usize) {
        if !self.starts.is_empty() {
            return;
        }
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
    lists: &'a NearLists<'a>,
    /// The range of candidates.
    listed: Range<usize>,
    /// The number of the first item.
    base: u32,
    /// The positions of the items.
    own: &'a [Vector3<R>],
    positions: &'a [Vector3<R>],
    radius: R,
    /// Candidates with a larger bound are not near.
    limit: f32,
}

/// Keeps the near pairs and returns their number. Compares only those that are due by their bounds. The
/// output is an argument of its own, so that it does not overlap the input.
#[inline(never)]
fn keep<R: Float>(
    Pairs { lists, listed, base, own, positions, radius, limit }: Pairs<'_, R>,
    first: u32,
    near: &mut [u32],
    near_owners: &mut [u32],
    square: &impl Fn(Vector3<R>, Vector3<R>) -> R,
) -> usize {
    let mut due = 0;
    for (number, bound) in lists.bounds[listed.clone()].iter().enumerate() {
        near[due] = number as u32;
        let is_far = f32::from_bits(bound.load(Ordering::Relaxed)) > limit;
        // NaN is due.
        due += usize::from(!is_far);
    }
    let candidates = &lists.candidates[listed.clone()];
    let owners = &lists.owners[listed.clone()];
    // Look up all places first, so that the processor waits for many of them together.
    for (number, place) in near[..due].iter().zip(&mut near_owners[..due]) {
        *place = lists.places[candidates[*number as usize] as usize];
        announce(positions.as_ptr().wrapping_add(*place as usize).cast());
    }
    let mut count = 0;
    for index in 0..due {
        let (number, place) = (near[index] as usize, near_owners[index]);
        let owner = owners[number] - base;
        // An item that has left the space has no place.
        let Some(other) = positions.get(place as usize) else { continue };
        let apart = square(own[owner as usize], *other);
        lists.bound(listed.start + number, apart.to_f64());
        near[count] = place;
        near_owners[count] = first + owner;
        count += usize::from(apart < radius * radius);
    }
    count
}
