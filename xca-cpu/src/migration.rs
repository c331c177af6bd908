//! Migration: moves items that change their cell, and keeps all others in order.
//!
//! Few items move in a step. A row stays as it is if no item enters or leaves it. The items of any other row
//! are merged by label, within the room of the row. The values of arriving items are copied out first. After
//! that the rows are independent.

use crate::arrays::{Arrays, Values};
use crate::layout::Layout;
use crate::lists::STRANGER;
use crate::motion::{largest, outside};
use crate::population::Population;
use crate::rows::Mover;
use rayon::prelude::*;
use xca_core::engine::Fault;
use xca_core::kernel::{NOWHERE, OUTSIDE};
use xca_core::{Geometry, Process};

/// The number of rows that are worth the start of a thread.
const ROWS_WORTH_A_START: usize = 16;

/// An item that enters a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Arrival {
    pub(crate) cell: u32,
    pub(crate) label: u32,
    /// Its previous place, in the row of the cell that it leaves.
    pub(crate) item: u32,
    pub(crate) from: u32,
}

/// Moves items. `movers` are in the order of items.
pub(crate) fn migrate(
    population: &mut Population,
    layout: &Layout,
    geometry: &Geometry,
    process: &Process,
    movers: &mut [Mover],
) -> Result<(), Fault> {
    if movers.is_empty() {
        return Ok(());
    }
    let (mut arrivals, left) = arrivals(population, geometry, process, movers)?;
    arrivals.par_sort_unstable();
    check_slots(population, layout, geometry, process, movers, &arrivals)?;
    population.left += left;
    settle(population, layout, geometry, movers, &arrivals);
    Ok(())
}

/// Moves items after all checks. Items from other parts are stored after all places.
pub(crate) fn settle(
    population: &mut Population,
    layout: &Layout,
    geometry: &Geometry,
    movers: &mut [Mover],
    arrivals: &[Arrival],
) {
    let slack = slack(population, geometry, arrivals);
    let carried = carried(population, arrivals);
    let strangers = strangers(population, arrivals);
    population.truncate();
    if let Some(counts) = counts_without_room(population, layout, movers, arrivals) {
        let shifts = population.make_room(layout, &counts);
        let shift = |from: u32| shifts[layout.row_of(from as usize)];
        movers.iter_mut().for_each(|mover| mover.item = mover.item.wrapping_add(shift(mover.from)));
    }
    let changes = changes(layout, movers, arrivals);
    if let Some(lists) = &mut population.lists {
        let left = movers.iter().filter(|mover| mover.answer == OUTSIDE);
        left.for_each(|mover| lists.left(population.items.numbers[mover.item as usize]));
        strangers.into_iter().for_each(|cell| lists.met_stranger(layout, layout.row_of(cell as usize)));
    }
    // The items that stay have been measured in place.
    if let Some(motion) = &mut population.motion {
        motion.slack = slack;
    }
    change(population, layout, &changes, &carried);
    changes.iter().for_each(|change| population.follow(change.row));
    population.fill_halo(layout);
}

/// Checks the destinations of the movers, and counts those that leave.
pub(crate) fn arrivals(
    population: &Population,
    geometry: &Geometry,
    process: &Process,
    movers: &[Mover],
) -> Result<(Vec<Arrival>, u64), Fault> {
    let mut left = 0;
    let mut arrivals = Vec::with_capacity(movers.len());
    for mover in movers {
        let label = population.items.labels[mover.item as usize];
        let cell = geometry.indices(mover.from as usize);
        match mover.answer {
            NOWHERE => return Err(Fault::Nowhere { process: process.name, label, cell }),
            OUTSIDE if population.may_leave => left += 1,
            OUTSIDE => return Err(Fault::Left { process: process.name, label, cell }),
            answer => {
                let to = geometry.indices(answer as usize);
                let displacements = geometry.neighbourhood().displacements(cell);
                if !displacements.iter().any(|displacement| geometry.at(cell, *displacement) == Some(to)) {
                    return Err(Fault::TooFar { process: process.name, label, from: cell, to });
                }
                arrivals.push(Arrival { cell: answer, label, item: mover.item, from: mover.from });
            }
        }
    }
    Ok((arrivals, left))
}

/// Checks that all entered cells have enough slots.
pub(crate) fn check_slots(
    population: &Population,
    layout: &Layout,
    geometry: &Geometry,
    process: &Process,
    mut movers: &[Mover],
    arrivals: &[Arrival],
) -> Result<(), Fault> {
    for coming in arrivals.chunk_by(|one, next| one.cell == next.cell) {
        let cell = coming[0].cell;
        movers = &movers[movers.iter().take_while(|mover| mover.from < cell).count()..];
        let leaving = movers.iter().take_while(|mover| mover.from == cell).count();
        let padded = layout.padded(cell as usize);
        let items = (population.ends[padded] - population.starts[padded]) as usize - leaving + coming.len();
        if items > population.slots {
            let (process, cell) = (Some(process.name), geometry.indices(cell as usize));
            return Err(Fault::CellFull { process, cell, items, slots: population.slots });
        }
    }
    Ok(())
}

/// The slack of all items, with the movers in their new cells.
fn slack(population: &Population, geometry: &Geometry, arrivals: &[Arrival]) -> f64 {
    let stay = population.motion.map_or(0.0, |motion| motion.slack);
    arrivals.iter().fold(stay, |slack, arrival| {
        let cell = geometry.indices(arrival.cell as usize);
        let position = population.position_of(arrival.item as usize);
        position.map_or(slack, |position| largest(slack, outside(position, cell, geometry.side())))
    })
}

/// The cells that items in no list enter.
fn strangers(population: &Population, arrivals: &[Arrival]) -> Vec<u32> {
    let numbers = &population.items.numbers;
    let is_stranger = |arrival: &&Arrival| numbers.get(arrival.item as usize) == Some(&STRANGER);
    arrivals.iter().filter(is_stranger).map(|arrival| arrival.cell).collect()
}

/// The number of items of each row, now or after the migration, whichever is larger. `None` if all rows have
/// enough room.
fn counts_without_room(
    population: &Population,
    layout: &Layout,
    movers: &[Mover],
    arrivals: &[Arrival],
) -> Option<Vec<u32>> {
    let row_of = |cell: u32| layout.row_of(cell as usize);
    let (mut leaving, mut coming) = (movers, arrivals);
    let mut fits = true;
    while let Some(arrival) = coming.first() {
        let row = row_of(arrival.cell);
        let come = take_first(&mut coming, |arrival| row_of(arrival.cell) == row).len();
        take_first(&mut leaving, |mover| row_of(mover.from) < row);
        let leave = take_first(&mut leaving, |mover| row_of(mover.from) == row).len();
        let (first, end) = population.row(row);
        fits &= end - first + come - leave <= population.room(row);
    }
    if fits {
        return None;
    }
    let before: Vec<u32> = population.places().map(|places| places.len() as u32).collect();
    let mut counts = before.clone();
    for arrival in arrivals {
        counts[row_of(arrival.cell)] += 1;
    }
    for mover in movers {
        counts[row_of(mover.from)] -= 1;
    }
    counts.iter_mut().zip(before).for_each(|(count, before)| *count = before.max(*count));
    Some(counts)
}

/// The changes in a row.
struct Change<'a> {
    row: usize,
    leaving: &'a [Mover],
    coming: &'a [Arrival],
    /// The number of items that enter earlier rows.
    carried: usize,
}

/// The rows that change, in order.
fn changes<'a>(layout: &Layout, movers: &'a [Mover], arrivals: &'a [Arrival]) -> Vec<Change<'a>> {
    let row_of = |cell: u32| layout.row_of(cell as usize);
    let (mut leaving, mut coming) = (movers, arrivals);
    let mut changes = Vec::new();
    let mut carried = 0;
    loop {
        let firsts = [leaving.first().map(|mover| mover.from), coming.first().map(|arrival| arrival.cell)];
        let Some(cell) = firsts.into_iter().flatten().min() else { return changes };
        let row = row_of(cell);
        let leaving = take_first(&mut leaving, |mover| row_of(mover.from) == row);
        let coming = take_first(&mut coming, |arrival| row_of(arrival.cell) == row);
        changes.push(Change { row, leaving, coming, carried });
        carried += coming.len();
    }
}

/// The values of the arriving items, array by array.
fn carried(population: &mut Population, arrivals: &[Arrival]) -> Vec<Vec<u8>> {
    let take = |values: Values<'_>| {
        let mut taken = Vec::with_capacity(arrivals.len() * values.size);
        for arrival in arrivals {
            let place = arrival.item as usize * values.size;
            taken.extend_from_slice(&values.bytes[place..place + values.size]);
        }
        taken
    };
    let mut carried: Vec<Vec<u8>> =
        population.items.values(&population.types).into_iter().map(take).collect();
    let cells: Vec<u32> = arrivals.iter().map(|arrival| arrival.cell).collect();
    carried[Arrays::CELLS].copy_from_slice(bytemuck::cast_slice(&cells));
    carried
}

/// Makes the changes, in parallel over blocks of rows.
fn change(population: &mut Population, layout: &Layout, changes: &[Change<'_>], carried: &[Vec<u8>]) {
    let Population { types, items, starts, ends, rows, row_ends, .. } = population;
    // Splits the arrays, so that each block has the part that it writes.
    let mut values = items.values(types);
    let (mut starts, mut ends) = (starts.as_mut_slice(), ends.as_mut_slice());
    let mut row_ends = row_ends.as_mut_slice();
    let (mut first_cell, mut first_place, mut first_row) = (0, 0, 0);
    let size = changes.len().div_ceil(4 * rayon::current_num_threads()).max(ROWS_WORTH_A_START);
    let mut parts = Vec::new();
    for block in changes.chunks(size) {
        let Some(last) = block.last() else { continue };
        let end_cell = layout.first(last.row) + layout.width();
        let end_place = rows[last.row + 1] as usize;
        parts.push(Part {
            changes: block,
            carried,
            layout,
            rows,
            values: values
                .iter_mut()
                .map(|Values { size, bytes }| Values {
                    size: *size,
                    bytes: split_off(bytes, (end_place - first_place) * *size),
                })
                .collect(),
            starts: split_off(&mut starts, end_cell - first_cell),
            ends: split_off(&mut ends, end_cell - first_cell),
            row_ends: split_off(&mut row_ends, last.row + 1 - first_row),
            first_cell,
            first_place,
            first_row,
        });
        (first_cell, first_place, first_row) = (end_cell, end_place, last.row + 1);
    }
    parts.into_par_iter().with_max_len(1).for_each(Part::change);
}

fn split_off<'a, T>(rest: &mut &'a mut [T], length: usize) -> &'a mut [T] {
    let (part, after) = std::mem::take(rest).split_at_mut(length);
    *rest = after;
    part
}

/// The source of consecutive values of a changed row.
#[derive(Clone, Copy)]
struct Span {
    origin: Origin,
    first: u32,
    count: u32,
    /// The place of the first one after the change.
    to: u32,
}

#[derive(Clone, Copy, PartialEq)]
enum Origin {
    /// Places of the row.
    Here,
    /// The values of arriving items.
    Carried,
}

/// Some rows, and the memory to write for them.
struct Part<'a> {
    changes: &'a [Change<'a>],
    /// The values of arriving items, for each array.
    carried: &'a [Vec<u8>],
    layout: &'a Layout,
    rows: &'a [u32],
    values: Vec<Values<'a>>,
    starts: &'a mut [u32],
    ends: &'a mut [u32],
    row_ends: &'a mut [u32],
    /// The padded index of the first cell of `starts` and `ends`.
    first_cell: usize,
    /// The first place of the values.
    first_place: usize,
    /// The first row of `row_ends`.
    first_row: usize,
}

impl Part<'_> {
    fn change(mut self) {
        let (mut spans, mut moves) = (Vec::new(), Vec::new());
        for change in self.changes {
            spans.clear();
            let first = self.merge(change, &mut spans);
            in_order(&mut spans, first, &mut moves);
            for (Values { size, bytes }, carried) in self.values.iter_mut().zip(self.carried) {
                for Span { origin, first, count, to } in &moves {
                    let [count, to] =
                        [*count as usize, *to as usize - self.first_place].map(|places| places * *size);
                    match origin {
                        Origin::Here => {
                            let first = (*first as usize - self.first_place) * *size;
                            bytes.copy_within(first..first + count, to);
                        }
                        Origin::Carried => {
                            let first = *first as usize * *size;
                            bytes[to..to + count].copy_from_slice(&carried[first..first + count]);
                        }
                    }
                }
            }
        }
    }

    /// Merges the staying and the arriving items of a row by cell and label, and sets the ranges of the
    /// cells. Returns the first place that can change. The values from there on come from `spans`.
    fn merge(&mut self, change: &Change<'_>, spans: &mut Vec<Span>) -> u32 {
        let (mut leaving, mut coming) = (change.leaving, change.coming);
        let width = self.layout.width();
        let first_of_row = self.layout.linear(change.row) as u32;
        let padded = self.layout.first(change.row) - self.first_cell;
        let labels: &[u32] = bytemuck::cast_slice(&*self.values[Arrays::LABELS].bytes);
        let mut carried = change.carried as u32;
        let (mut x, mut end, mut first_place) = (0, 0, None);
        loop {
            let cells = [leaving.first().map(|mover| mover.from), coming.first().map(|arrival| arrival.cell)];
            let next = cells.into_iter().flatten().min().map_or(width, |cell| (cell - first_of_row) as usize);
            if first_place.is_none() {
                (x, end) = (next, self.starts[padded + next]);
                first_place = Some(end);
            }
            if x < next {
                // Cells whose items only shift.
                let old = self.starts[padded + x]..self.ends[padded + next - 1];
                let shift = end.wrapping_sub(old.start);
                let count = old.end - old.start;
                if shift != 0 {
                    let cells = padded + x..padded + next;
                    for range in self.starts[cells.clone()].iter_mut().chain(&mut self.ends[cells]) {
                        *range = range.wrapping_add(shift);
                    }
                }
                // At the end of a row, unshifted values need no copy.
                if shift != 0 || next < width {
                    push(spans, Origin::Here, old.start, count);
                }
                end += count;
            }
            if next == width {
                break;
            }
            let cell = first_of_row + next as u32;
            let old = self.starts[padded + next]..self.ends[padded + next];
            self.starts[padded + next] = end;
            let mut carry = |come: &[Arrival], end: &mut u32, spans: &mut Vec<Span>| {
                push(spans, Origin::Carried, carried, come.len() as u32);
                carried += come.len() as u32;
                *end += come.len() as u32;
            };
            for item in old {
                if let [mover, rest @ ..] = leaving
                    && mover.item == item
                {
                    leaving = rest;
                    continue;
                }
                let label = labels[item as usize - self.first_place];
                let come = take_first(&mut coming, |one| one.cell == cell && one.label <= label);
                carry(come, &mut end, spans);
                push(spans, Origin::Here, item, 1);
                end += 1;
            }
            carry(take_first(&mut coming, |one| one.cell == cell), &mut end, spans);
            self.ends[padded + next] = end;
            x = next + 1;
        }
        debug_assert!(end <= self.rows[change.row + 1], "more items than room");
        self.row_ends[change.row - self.first_row] = end;
        first_place.unwrap_or(end)
    }
}

/// Places spans one after the other from `place` on. Collects those that move, in an order in which none is
/// written over before it has moved: the values of a row stay in order, so only those that move up can be in
/// the way of others that move up, and only those that move down in the way of others that move down.
fn in_order(spans: &mut [Span], mut place: u32, moves: &mut Vec<Span>) {
    for span in &mut *spans {
        span.to = place;
        place += span.count;
    }
    let (here, carried) =
        (|span: &&Span| span.origin == Origin::Here, |span: &&Span| span.origin == Origin::Carried);
    moves.clear();
    moves.extend(spans.iter().rev().filter(here).filter(|span| span.to > span.first));
    moves.extend(spans.iter().filter(here).filter(|span| span.to < span.first));
    moves.extend(spans.iter().filter(carried));
}

/// Adds values. Extends the previous span if they follow it.
fn push(spans: &mut Vec<Span>, origin: Origin, first: u32, count: u32) {
    match spans.last_mut() {
        _ if count == 0 => {}
        Some(last) if last.origin == origin && last.first + last.count == first => last.count += count,
        _ => spans.push(Span { origin, first, count, to: 0 }),
    }
}

/// Takes from the front while the condition holds.
fn take_first<'a, T>(rest: &mut &'a [T], condition: impl Fn(&T) -> bool) -> &'a [T] {
    let count = rest.iter().take_while(|one| condition(one)).count();
    let (first, after) = rest.split_at(count);
    *rest = after;
    first
}
