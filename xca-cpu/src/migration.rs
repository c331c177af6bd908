//! Migration: moves the items that change their cell, and keeps all others in order.
//!
//! Few items move in a step. The rest keeps its order, so a row that none enters or leaves is copied as it is, and the items of any
//! other row are merged by label. Rows are independent once it is known how many items each of them will have.

use crate::blocks::blocks;
use crate::layout::Layout;
use crate::population::{Arrays, Population};
use crate::rows::Mover;
use rayon::prelude::*;
use std::ops::Range;
use xca_core::engine::Fault;
use xca_core::kernel::{NOWHERE, OUTSIDE};
use xca_core::storage::Buffer;
use xca_core::{Geometry, Process, StoredType};

/// An item on its way into a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Arrival {
    cell: u32,
    label: u32,
    item: u32,
}

/// Moves items; `movers` are in the order of items.
pub(crate) fn migrate(
    population: &mut Population,
    layout: &Layout,
    geometry: &Geometry,
    process: &Process,
    movers: &[Mover],
) -> Result<(), Fault> {
    if movers.is_empty() {
        return Ok(());
    }
    let (mut arrivals, left) = arrivals(population, geometry, process, movers)?;
    arrivals.par_sort_unstable();
    check_slots(population, layout, geometry, process, movers, &arrivals)?;
    let rows = new_rows(population, layout, movers, &arrivals);
    let mut next = std::mem::take(&mut population.next);
    next.resize(rows[layout.rows()] as usize, &population.types);
    rearrange(population, &mut next, layout, &rows, movers, &arrivals);
    population.next = std::mem::replace(&mut population.items, next);
    population.rows = rows;
    population.left += left;
    population.fill_halo(layout);
    Ok(())
}

/// Checks where the movers go, and counts those that leave.
fn arrivals(
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
                arrivals.push(Arrival { cell: answer, label, item: mover.item });
            }
        }
    }
    Ok((arrivals, left))
}

/// Whether all cells that items enter have slots for them.
fn check_slots(
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

/// For each row its first item after the migration, and at the end the number of items.
fn new_rows(population: &Population, layout: &Layout, movers: &[Mover], arrivals: &[Arrival]) -> Vec<u32> {
    let width = layout.width() as u32;
    let mut rows = vec![0_u32; layout.rows() + 1];
    for row in 0..layout.rows() {
        let (first, end) = population.row(row);
        rows[row + 1] = (end - first) as u32;
    }
    for mover in movers {
        rows[(mover.from / width) as usize + 1] -= 1;
    }
    for arrival in arrivals {
        rows[(arrival.cell / width) as usize + 1] += 1;
    }
    for row in 0..layout.rows() {
        rows[row + 1] += rows[row];
    }
    rows
}

/// Copies all items to their new places and sets the cells' ranges, in parallel over blocks of rows.
fn rearrange(
    population: &mut Population,
    next: &mut Arrays,
    layout: &Layout,
    rows: &[u32],
    movers: &[Mover],
    arrivals: &[Arrival],
) {
    let blocks = blocks(layout, &[population], rayon::current_num_threads());
    let Population { types, items, starts, ends, rows: old_rows, .. } = population;
    let old = Old { types, items, rows: old_rows };
    // What a block writes is cut off from what the blocks after it write.
    let Arrays { labels, fields } = next;
    let mut labels = labels.as_mut_slice();
    let mut fields: Vec<&mut [u8]> = fields.iter_mut().map(Buffer::bytes_mut).collect();
    let (mut starts, mut ends) = (starts.as_mut_slice(), ends.as_mut_slice());
    let mut cut = 0;
    let parts: Vec<Part<'_>> = blocks
        .into_iter()
        .map(|block| {
            let items = (rows[block.end] - rows[block.start]) as usize;
            let cells = layout.first(block.end - 1) + layout.width() - cut;
            let part = Part {
                labels: split_off(&mut labels, items),
                fields: fields
                    .iter_mut()
                    .zip(old.types)
                    .map(|(field, stored)| split_off(field, items * stored.size()))
                    .collect(),
                starts: split_off(&mut starts, cells),
                ends: split_off(&mut ends, cells),
                first_cell: cut,
                rows: block,
            };
            cut += cells;
            part
        })
        .collect();
    parts.into_par_iter().with_max_len(1).for_each(|part| part.fill(&old, layout, rows, movers, arrivals));
}

fn split_off<'a, T>(rest: &mut &'a mut [T], length: usize) -> &'a mut [T] {
    let (part, after) = std::mem::take(rest).split_at_mut(length);
    *rest = after;
    part
}

/// The items before the migration.
struct Old<'a> {
    types: &'a [StoredType],
    items: &'a Arrays,
    rows: &'a [u32],
}

/// A block of rows, with what it writes.
struct Part<'a> {
    rows: Range<usize>,
    /// The labels and fields of the rows' new items.
    labels: &'a mut [u32],
    fields: Vec<&'a mut [u8]>,
    /// The ranges of padded cells, those of the rows among them.
    starts: &'a mut [u32],
    ends: &'a mut [u32],
    /// The padded number of the first of these cells.
    first_cell: usize,
}

impl Part<'_> {
    fn fill(mut self, old: &Old<'_>, layout: &Layout, rows: &[u32], movers: &[Mover], arrivals: &[Arrival]) {
        let width = layout.width() as u32;
        let first_cell = self.rows.start as u32 * width;
        let mut movers = &movers[movers.partition_point(|mover| mover.from < first_cell)..];
        let mut arrivals = &arrivals[arrivals.partition_point(|arrival| arrival.cell < first_cell)..];
        let first_item = rows[self.rows.start];
        let mut sources = Vec::new();
        for row in self.rows.clone() {
            let end = (row as u32 + 1) * width;
            let leaving = take_first(&mut movers, |mover| mover.from < end);
            let coming = take_first(&mut arrivals, |arrival| arrival.cell < end);
            let before = old.rows[row] as usize..old.rows[row + 1] as usize;
            let after = (rows[row] - first_item) as usize..(rows[row + 1] - first_item) as usize;
            let cells = layout.first(row) - self.first_cell;
            let cells = cells..cells + layout.width();
            if leaving.is_empty() && coming.is_empty() {
                self.labels[after.clone()].copy_from_slice(&old.items.labels[before.clone()]);
                for (number, stored) in old.types.iter().enumerate() {
                    let size = stored.size();
                    self.fields[number][after.start * size..after.end * size].copy_from_slice(
                        &old.items.fields[number].bytes()[before.start * size..before.end * size],
                    );
                }
                let shift = rows[row].wrapping_sub(old.rows[row]);
                if shift != 0 && !before.is_empty() {
                    for range in self.starts[cells.clone()].iter_mut().chain(&mut self.ends[cells]) {
                        *range = range.wrapping_add(shift);
                    }
                }
                continue;
            }
            sources.clear();
            let ranges = self.starts[cells.clone()].iter_mut().zip(&mut self.ends[cells]);
            let changes = Changes { first_cell: row as u32 * width, leaving, coming };
            changes.merge(&old.items.labels, ranges, rows[row], &mut sources);
            for (label, &item) in self.labels[after.clone()].iter_mut().zip(&sources) {
                *label = old.items.labels[item as usize];
            }
            for (number, stored) in old.types.iter().enumerate() {
                let size = stored.size();
                let new = &mut self.fields[number][after.start * size..after.end * size];
                gather_values(size, old.items.fields[number].bytes(), new, &sources);
            }
        }
    }
}

/// Takes from the front while the condition holds.
fn take_first<'a, T>(rest: &mut &'a [T], condition: impl Fn(&T) -> bool) -> &'a [T] {
    let count = rest.iter().take_while(|one| condition(one)).count();
    let (first, after) = rest.split_at(count);
    *rest = after;
    first
}

/// What changes in a row.
struct Changes<'a> {
    /// The row's first cell.
    first_cell: u32,
    leaving: &'a [Mover],
    coming: &'a [Arrival],
}

impl Changes<'_> {
    /// Merges those that stay and those that come, cell by cell and by label, and sets the cells' ranges, from the row's new first item on.
    fn merge<'a>(
        mut self,
        labels: &[u32],
        ranges: impl Iterator<Item = (&'a mut u32, &'a mut u32)>,
        first_item: u32,
        sources: &mut Vec<u32>,
    ) {
        for (cell, (start, end)) in (self.first_cell..).zip(ranges) {
            let before = *start..*end;
            *start = first_item + sources.len() as u32;
            for item in before {
                if let [mover, rest @ ..] = self.leaving
                    && mover.item == item
                {
                    self.leaving = rest;
                    continue;
                }
                self.arrive(cell, labels[item as usize], sources);
                sources.push(item);
            }
            self.arrive(cell, u32::MAX, sources);
            *end = first_item + sources.len() as u32;
        }
    }

    /// Adds those that come to the cell with labels up to this one.
    fn arrive(&mut self, cell: u32, label: u32, sources: &mut Vec<u32>) {
        while let [arrival, rest @ ..] = self.coming
            && arrival.cell == cell
            && arrival.label <= label
        {
            sources.push(arrival.item);
            self.coming = rest;
        }
    }
}

/// Gathers values of one field. Sizes known to the compiler make the copy a move of a register or two.
fn gather_values(size: usize, old: &[u8], new: &mut [u8], sources: &[u32]) {
    match size {
        1 => gather::<1>(old, new, sources),
        4 => gather::<4>(old, new, sources),
        8 => gather::<8>(old, new, sources),
        12 => gather::<12>(old, new, sources),
        16 => gather::<16>(old, new, sources),
        24 => gather::<24>(old, new, sources),
        _ => {
            for (value, &item) in new.chunks_exact_mut(size).zip(sources) {
                value.copy_from_slice(&old[item as usize * size..(item as usize + 1) * size]);
            }
        }
    }
}

fn gather<const SIZE: usize>(old: &[u8], new: &mut [u8], sources: &[u32]) {
    let (old, _) = old.as_chunks::<SIZE>();
    let (new, _) = new.as_chunks_mut::<SIZE>();
    for (value, &item) in new.iter_mut().zip(sources) {
        *value = old[item as usize];
    }
}
