//! The items of a row that have others nearby, for processes in which all others do nothing.

use super::walk::{Share, Walk};
use super::{Row, reach};
use crate::float::Float;
use xca_values::Vector3;

impl Row<'_> {
    /// Marks, with 1, those own items that share their cell with another for which the condition holds. All
    /// others get 0.
    #[inline(always)]
    pub fn mates(&self, condition: impl Fn(usize) -> bool, marks: &mut Vec<u32>) {
        let cells = self.items.map_or(&[][..], |items| items.cells);
        let first = self.first_item();
        marks.clear();
        marks.resize(cells.len(), 0);
        // Items are sorted by cell. Those before each item in its cell count first, then those after it. No
        // branch, which the processor could not predict.
        let (mut cell, mut any) = (u32::MAX, 0);
        for (number, mark) in marks.iter_mut().enumerate() {
            *mark = if cells[number] == cell { any } else { 0 };
            (cell, any) = (cells[number], *mark | u32::from(condition(first + number)));
        }
        (cell, any) = (u32::MAX, 0);
        for (number, mark) in marks.iter_mut().enumerate().rev() {
            let after = if cells[number] == cell { any } else { 0 };
            *mark |= after;
            (cell, any) = (cells[number], after | u32::from(condition(first + number)));
        }
    }

    /// Fills the buffer with the indices of those own items that have a mark in one of `mates`. These are all
    /// own items if the process must write the values of all.
    #[inline(never)]
    pub fn with_mates(&self, mates: &[&Vec<u32>], company: &mut Vec<u32>) {
        company.clear();
        let count = self.own_items();
        if self.copies() {
            return company.extend(0..count as u32);
        }
        // Most rows have no mates at all. The compiler reads many marks at once here, and one by one below.
        if mates.iter().any(|marks| marks.iter().fold(0, |any, mark| any | mark) != 0) {
            keep_marked(company, count, |number| mates.iter().fold(0, |any, marks| any | marks[number]) != 0);
        }
    }

    /// Whether the process reads and writes two buffers, so that it must copy what it does not change.
    fn copies(&self) -> bool {
        self.entries.iter().any(|entry| !entry.read.is_null() && !entry.write.is_null())
    }

    /// Fills the buffer with the indices of those own items that have others within `radius` in the searched
    /// cells, or a mark in one of `mates`, or, if `in_cell` is set, others in their cell. If lists cannot
    /// tell, these are all own items, and so they are if the process must write the values of all.
    #[inline(never)]
    pub fn with_company<R: Float, const REACH: u8>(
        &self,
        in_cell: bool,
        mates: &[&Vec<u32>],
        radius: R,
        positions: &[Vector3<R>],
        company: &mut Vec<u32>,
    ) {
        let count = self.own_items();
        company.clear();
        if self.copies() || !self.is_allowed::<R, REACH>(radius) || !self.walk(radius, positions) {
            return company.extend(0..count as u32);
        }
        self.widest.set(self.widest.get().max(radius.to_f64()));
        let mut walk = self.scratch.walk.borrow_mut();
        let Walk { all: Share { near, owners }, marks, .. } = &mut *walk;
        let Some(items) = self.items.filter(|_| 2 * near.len() < count) else {
            return company.extend(0..count as u32);
        };
        marks.clear();
        marks.resize(count, 0);
        if in_cell {
            mark_shared_cells(marks, items.cells);
        }
        for mates in mates {
            marks.iter_mut().zip(*mates).for_each(|(mark, mate)| *mark |= u8::from(*mate != 0));
        }
        for (owner, place) in owners.iter().zip(near) {
            let owner = *owner as usize;
            let other = items.cells.get((*place as usize).wrapping_sub(items.own.0));
            let here = other == items.cells.get(owner);
            marks[owner] |= u8::from(REACH == reach::ALL || here == (REACH == reach::CELL));
        }
        keep_marked(company, count, |number| marks[number] != 0);
    }
}

/// Keeps the indices of marked items, of so many. No branch on what is marked, which the processor could not
/// predict.
#[inline(always)]
fn keep_marked(company: &mut Vec<u32>, count: usize, is_marked: impl Fn(usize) -> bool) {
    company.resize(count, 0);
    let mut length = 0;
    for number in 0..count {
        company[length] = number as u32;
        length += usize::from(is_marked(number));
    }
    company.truncate(length);
}

/// Marks the items that share their cell with others. Items are sorted by cell.
fn mark_shared_cells(marks: &mut [u8], cells: &[u32]) {
    if let ([first, middle @ .., last], [one, two, ..], [.., before, end]) = (marks, cells, cells) {
        *first = u8::from(one == two);
        *last = u8::from(before == end);
        for (mark, cells) in middle.iter_mut().zip(cells.windows(3)) {
            *mark = u8::from((cells[0] == cells[1]) | (cells[1] == cells[2]));
        }
    }
}
