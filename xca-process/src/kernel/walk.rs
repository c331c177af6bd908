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
    /// The start in `all` for each own item, then the length of that. Empty until it is needed.
    pub(super) starts: Vec<u32>,
    /// All pairs, by owner, then by place.
    pub(super) all: Share,
    /// Whether they are sorted by neighbour index and not by place.
    pub(super) ordered: bool,
    /// The same pairs, split by whether both items are in one cell. Only if `is_split`.
    pub(super) here: Share,
    pub(super) elsewhere: Share,
    pub(super) is_split: bool,
    /// The same pairs, for each owner those in its cell first. Only if `is_joined`.
    joined: Share,
    pub(super) is_joined: bool,
    /// 1 for each own item with company, otherwise 0. See [`super::company`].
    pub(super) marks: Vec<u8>,
}

/// Some pairs.
#[derive(Debug, Default)]
pub(super) struct Share {
    /// The places of near items.
    pub(super) near: Vec<u32>,
    /// The index of the searching item among the row's own items.
    pub(super) owners: Vec<u32>,
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
            self.all.resize(length + listed.len());
            let own = &own[start..start + run];
            let pairs = Pairs { lists, listed, base, own, positions, radius, limit };
            let (near, owners) = (&mut self.all.near[length..], &mut self.all.owners[length..]);
            length += keep(pairs, start as u32, near, owners, &square);
            start += run;
        }
        self.all.resize(length);
    }

    /// Sorts the near items of each item by place. They are nearly sorted.
    pub(super) fn sort(&mut self) {
        let Share { near, owners } = &mut self.all;
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

    /// Splits the pairs by whether both items are in one cell.
    pub(super) fn split(&mut self, items: &RowItems<'_>) {
        let Self { all: Share { near, owners }, here, elsewhere, is_split, .. } = self;
        let (first, cells) = (items.own.0, items.cells);
        if *is_split {
            return;
        }
        let (last, room) = (cells.len().saturating_sub(1), near.len());
        let [mut here_length, mut elsewhere_length] = [0; 2];
        here.resize(room);
        elsewhere.resize(room);
        // Each pair is written to both. No branch on where it stays, which the processor could not predict.
        let [heres, elsewheres] =
            [&mut *here, elsewhere].map(|share| (&mut share.near[..room], &mut share.owners[..room]));
        for (owner, place) in owners.iter().zip(&*near) {
            // Comparing with the item's own row needs no memory of other rows.
            let index = (*place as usize).wrapping_sub(first);
            let is_here = (index <= last) & (cells[index.min(last)] == cells[*owner as usize]);
            (heres.0[here_length], heres.1[here_length]) = (*place, *owner);
            (elsewheres.0[elsewhere_length], elsewheres.1[elsewhere_length]) = (*place, *owner);
            here_length += usize::from(is_here);
            elsewhere_length += usize::from(!is_here);
        }
        here.resize(here_length);
        elsewhere.resize(elsewhere_length);
        *is_split = true;
    }

    /// All pairs, for each owner those in its cell first, then by place. `items` is the number of own items.
    pub(super) fn join(&mut self, items: &RowItems<'_>) -> &Share {
        if self.ordered {
            return &self.all;
        }
        if !self.is_joined {
            self.split(items);
            self.count(items.cells.len());
            let Self { here, elsewhere, joined, starts, .. } = self;
            let mut next = starts.clone();
            joined.resize(here.near.len() + elsewhere.near.len());
            for Share { near, owners } in [here, elsewhere] {
                for (owner, place) in owners.iter().zip(near) {
                    let slot = &mut next[*owner as usize];
                    (joined.near[*slot as usize], joined.owners[*slot as usize]) = (*place, *owner);
                    *slot += 1;
                }
            }
            self.is_joined = true;
        }
        &self.joined
    }

    /// Stores the start of each item's results.
    pub(super) fn count(&mut self, items: usize) {
        if !self.starts.is_empty() {
            return;
        }
        self.starts.resize(items + 1, 0);
        for owner in &self.all.owners {
            self.starts[*owner as usize + 1] += 1;
        }
        let mut sum = 0;
        for start in &mut self.starts {
            sum += *start;
            *start = sum;
        }
    }
}

impl Share {
    fn resize(&mut self, length: usize) {
        self.near.resize(length, 0);
        self.owners.resize(length, 0);
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
