//! The pairs of near items of a row, in batches. A kernel computes the pairs of a batch lane by lane.

use super::walk::Share;
use super::{BATCH, Found, KernelValue, Row, reach};
use crate::float::Float;
use std::ops::{AddAssign, SubAssign};
use xca_values::Vector3;

/// The number of pairs that a kernel computes together.
pub const GROUP: usize = 16;

/// The pairs of a row, in the order in which its items find them.
#[derive(Debug)]
pub struct Pairs<'a> {
    /// The index of the searching item among the row's own items. Filled up to a whole group.
    owners: Found<'a>,
    /// The places of the found items. Filled up to a whole group.
    others: Found<'a>,
    count: usize,
}

/// Some pairs. The last one stands in all lanes from `count` on, so that computing these lanes is like
/// computing that pair again.
#[derive(Debug, Clone, Copy)]
pub struct Batch<'p> {
    owners: &'p [u32],
    others: &'p [u32],
    count: usize,
}

impl<'a> Row<'a> {
    /// The pairs of the row's own items and those items of the searched cells that are nearer than `radius`.
    /// Only of items for which `acts` holds, and with others for which `counts` holds.
    #[inline(never)]
    pub fn pairs<R: Float, const REACH: u8>(
        &self,
        radius: R,
        positions: &[Vector3<R>],
        acts: impl Fn(usize) -> bool,
        counts: impl Fn(usize, usize) -> bool,
    ) -> Pairs<'a> {
        let mut pairs = Pairs { owners: self.found(), others: self.found(), count: 0 };
        if self.is_allowed::<R, REACH>(radius) && self.walk(radius, positions) {
            self.widest.set(self.widest.get().max(radius.to_f64()));
            self.add_walked::<REACH>(&mut pairs, |number, other| acts(number) && counts(number, other));
        } else {
            self.add_searched::<R, REACH>(&mut pairs, radius, positions, acts, counts);
        }
        pairs.fill_up();
        pairs
    }

    /// Adds the pairs of the walk.
    #[inline(always)]
    fn add_walked<const REACH: u8>(&self, pairs: &mut Pairs<'_>, counts: impl Fn(usize, usize) -> bool) {
        let mut walk = self.scratch.walk.borrow_mut();
        let Some(items) = &self.items else { return };
        if REACH != reach::ALL {
            walk.split(items);
        }
        let (owners, others) = (&mut pairs.owners.items, &mut pairs.others.items);
        let Share { near, owners: near_owners } = match REACH {
            reach::CELL => &walk.here,
            reach::NEIGHBOURS => &walk.elsewhere,
            _ => walk.join(items),
        };
        let room = near.len();
        owners.resize(room, 0);
        others.resize(room, 0);
        let (owners, others) = (&mut owners[..room], &mut others[..room]);
        let mut count = 0;
        // No branch on what is kept, which the processor could not predict.
        for (owner, place) in near_owners.iter().zip(near) {
            owners[count] = *owner;
            others[count] = *place;
            count += usize::from(counts(*owner as usize, *place as usize));
        }
        pairs.count = count;
    }

    /// Adds the pairs that each item finds.
    #[inline(always)]
    fn add_searched<R: Float, const REACH: u8>(
        &self,
        pairs: &mut Pairs<'_>,
        radius: R,
        positions: &[Vector3<R>],
        acts: impl Fn(usize) -> bool,
        counts: impl Fn(usize, usize) -> bool,
    ) {
        let mut found = self.found();
        pairs.owners.items.clear();
        pairs.others.items.clear();
        for number in (0..self.own_items()).filter(|number| acts(*number)) {
            let (cell, item) = (self.column_of(number), self.first_item() + number);
            self.others_within::<R, REACH>(cell, item, positions[item], radius, positions, &mut found.items);
            for other in found.items.iter().filter(|other| counts(number, **other as usize)) {
                pairs.owners.items.push(number as u32);
                pairs.others.items.push(*other);
            }
        }
        pairs.count = pairs.others.items.len();
    }
}

impl Pairs<'_> {
    /// Repeats the last pair up to the end of its group.
    fn fill_up(&mut self) {
        let (count, whole) = (self.count, self.count.next_multiple_of(GROUP));
        for Found { items, .. } in [&mut self.owners, &mut self.others] {
            items.truncate(count);
            items.resize(whole, items.last().copied().unwrap_or_default());
        }
    }

    /// Whether there are none.
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The pairs in batches.
    #[inline(always)]
    pub fn batches(&self) -> impl Iterator<Item = Batch<'_>> {
        let batches = self.owners.items.chunks(BATCH).zip(self.others.items.chunks(BATCH));
        batches.zip((0..self.count).step_by(BATCH)).map(|((owners, others), first)| Batch {
            owners,
            others,
            count: self.count - first,
        })
    }
}

impl Batch<'_> {
    /// The groups of lanes.
    #[inline(always)]
    pub fn groups(&self) -> impl Iterator<Item = usize> {
        (0..self.owners.len().min(BATCH) / GROUP).map(|group| group * GROUP)
    }

    /// The index of the searching item among the row's own items. It cannot panic, so that a kernel that does
    /// not use it pays nothing for it.
    #[inline(always)]
    pub fn owner(&self, lane: usize) -> usize {
        self.owners.get(lane).copied().unwrap_or_default() as usize
    }

    /// Reads the values of the searching items. Element `first` belongs to the row's first own item.
    #[inline(always)]
    pub fn read_owners<T: KernelValue>(&self, first: usize, values: &[T::Memory], batch: &mut T::Batch) {
        for (lane, owner) in self.owners.iter().enumerate() {
            T::set_lane(batch, lane, T::from_memory(values[first + *owner as usize]));
        }
    }

    /// Reads the values of the found items.
    #[inline(always)]
    pub fn read_others<T: KernelValue>(&self, values: &[T::Memory], batch: &mut T::Batch) {
        for (lane, other) in self.others.iter().enumerate() {
            T::set_lane(batch, lane, T::from_memory(values[*other as usize]));
        }
    }

    /// Adds the numbers of the pairs to the values of the searching items.
    #[inline(always)]
    pub fn add<T: KernelValue + AddAssign>(&self, row: &Row<'_>, numbers: &T::Batch, sums: &mut [T::Memory]) {
        self.change_sums(row, sums, |sum: &mut T, lane| *sum += T::lane(numbers, lane));
    }

    /// Subtracts the numbers of the pairs from the values of the searching items.
    #[inline(always)]
    pub fn subtract<T: KernelValue + SubAssign>(
        &self,
        row: &Row<'_>,
        numbers: &T::Batch,
        sums: &mut [T::Memory],
    ) {
        self.change_sums(row, sums, |sum: &mut T, lane| *sum -= T::lane(numbers, lane));
    }

    /// Changes the values of the searching items, pair by pair. The sum of integers may overflow.
    #[inline(always)]
    fn change_sums<T: KernelValue>(
        &self,
        row: &Row<'_>,
        sums: &mut [T::Memory],
        mut change: impl FnMut(&mut T, usize),
    ) {
        let mut place = row.place();
        for (lane, owner) in self.owners.iter().enumerate().take(self.count) {
            let number = *owner as usize;
            place.item = Some(row.first_item() + number);
            let Some(sum) = sums.get_mut(number) else { continue };
            let mut value = T::from_memory(*sum);
            change(&mut value, lane);
            *sum = value.to_memory();
        }
        place.leave();
    }
}
