//! Migration: moves the items that change their cell, and keeps all others in order.
//!
//! Few items move in a step. The rest keeps its order, so a row that none enters or leaves is copied as it is, and the items of any
//! other row are merged by label. Rows are independent once it is known how many items each of them will have.

use crate::layout::Layout;
use crate::population::Population;
use crate::rows::Mover;
use rayon::prelude::*;
use std::ops::Range;
use xca_core::engine::Fault;
use xca_core::kernel::{NOWHERE, OUTSIDE};
use xca_core::{Geometry, Process};

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
    arrivals.sort_unstable();
    let width = layout.width() as u32;
    let mut rows = vec![0_u32; layout.rows() + 1];
    for row in 0..layout.rows() {
        let (first, end) = population.row(row);
        rows[row + 1] = (end - first) as u32;
    }
    for mover in movers {
        rows[(mover.from / width) as usize + 1] -= 1;
    }
    for arrival in &arrivals {
        rows[(arrival.cell / width) as usize + 1] += 1;
    }
    for row in 0..layout.rows() {
        rows[row + 1] += rows[row];
    }
    let items = rows[layout.rows()] as usize;
    let mut next = std::mem::take(&mut population.next);
    next.resize(items, &population.types);
    let plan = plan(population, layout, &rows, movers, &arrivals);
    let sources = order(population, layout, &plan, movers, &arrivals)?;
    copy(population, &mut next, &plan, &sources);
    update_ranges(population, layout, &plan, &sources);
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

/// What happens to one row that has items, before or after.
struct RowPlan {
    row: usize,
    old: Range<usize>,
    new: Range<usize>,
    /// Its part of the movers.
    movers: Range<usize>,
    /// Its part of the arrivals.
    arrivals: Range<usize>,
}

impl RowPlan {
    fn is_unchanged(&self) -> bool {
        self.movers.is_empty() && self.arrivals.is_empty()
    }
}

fn plan(
    population: &Population,
    layout: &Layout,
    rows: &[u32],
    movers: &[Mover],
    arrivals: &[Arrival],
) -> Vec<RowPlan> {
    let width = layout.width() as u32;
    let (mut mover, mut arrival) = (0, 0);
    let mut plan = Vec::new();
    for row in 0..layout.rows() {
        let (first_mover, first_arrival) = (mover, arrival);
        while mover < movers.len() && (movers[mover].from / width) as usize == row {
            mover += 1;
        }
        while arrival < arrivals.len() && (arrivals[arrival].cell / width) as usize == row {
            arrival += 1;
        }
        let (first, end) = population.row(row);
        let new = rows[row] as usize..rows[row + 1] as usize;
        if first < end || !new.is_empty() {
            plan.push(RowPlan {
                row,
                old: first..end,
                new,
                movers: first_mover..mover,
                arrivals: first_arrival..arrival,
            });
        }
    }
    plan
}

/// The changed rows' items in their new order, and their new number in each cell.
struct Sources {
    items: Vec<u32>,
    counts: Vec<u32>,
}

/// For each changed row, where its items come from.
fn order(
    population: &Population,
    layout: &Layout,
    plan: &[RowPlan],
    movers: &[Mover],
    arrivals: &[Arrival],
) -> Result<Vec<Option<Sources>>, Fault> {
    let results: Vec<Result<Option<Sources>, (u32, usize)>> = plan
        .par_iter()
        .map(|row| {
            if row.is_unchanged() {
                return Ok(None);
            }
            merge(population, layout, row, &movers[row.movers.clone()], &arrivals[row.arrivals.clone()])
                .map(Some)
        })
        .collect();
    // The first in the order of rows is the first in the order of cells.
    results.into_iter().collect::<Result<_, _>>().map_err(|(cell, items)| {
        let (width, height) = (layout.width(), layout.rows());
        let row = cell as usize / width;
        debug_assert!(row < height);
        let [y, z] = layout.row(row);
        Fault::CellFull { cell: [cell as usize % width, y, z], items, slots: population.slots }
    })
}

/// Merges those that stay and those that come, cell by cell and by label.
fn merge(
    population: &Population,
    layout: &Layout,
    row: &RowPlan,
    mut leaving: &[Mover],
    mut coming: &[Arrival],
) -> Result<Sources, (u32, usize)> {
    let labels = &population.items.labels;
    let first_cell = (row.row * layout.width()) as u32;
    let padded = layout.first(row.row);
    let mut sources =
        Sources { items: Vec::with_capacity(row.new.len()), counts: Vec::with_capacity(layout.width()) };
    for x in 0..layout.width() {
        let cell = first_cell + x as u32;
        let before = sources.items.len();
        for item in population.starts[padded + x]..population.ends[padded + x] {
            if let [mover, rest @ ..] = leaving
                && mover.item == item
            {
                leaving = rest;
                continue;
            }
            while let [arrival, rest @ ..] = coming
                && arrival.cell == cell
                && arrival.label < labels[item as usize]
            {
                sources.items.push(arrival.item);
                coming = rest;
            }
            sources.items.push(item);
        }
        while let [arrival, rest @ ..] = coming
            && arrival.cell == cell
        {
            sources.items.push(arrival.item);
            coming = rest;
        }
        let count = sources.items.len() - before;
        if count > population.slots {
            return Err((cell, count));
        }
        sources.counts.push(count as u32);
    }
    Ok(sources)
}

/// Copies labels and fields to their new places, in parallel over parts of the new arrays that belong to one row each.
fn copy(
    population: &Population,
    next: &mut crate::population::Arrays,
    plan: &[RowPlan],
    sources: &[Option<Sources>],
) {
    let old = &population.items;
    let chunks = |size: usize| plan.iter().map(move |row| row.new.len() * size);
    {
        let parts = split(bytemuck::cast_slice_mut(&mut next.labels), chunks(4));
        parts.into_par_iter().with_min_len(16).zip(plan).zip(sources).for_each(|((part, row), sources)| {
            copy_row(bytemuck::cast_slice(&old.labels), part, row, sources.as_ref(), 4);
        });
    }
    for ((field, new), stored) in old.fields.iter().zip(&mut next.fields).zip(&population.types) {
        let size = stored.size();
        let parts = split(new.bytes_mut(), chunks(size));
        parts.into_par_iter().with_min_len(16).zip(plan).zip(sources).for_each(|((part, row), sources)| {
            copy_row(field.bytes(), part, row, sources.as_ref(), size);
        });
    }
}

fn split(mut bytes: &mut [u8], lengths: impl Iterator<Item = usize>) -> Vec<&mut [u8]> {
    lengths
        .map(|length| {
            let (part, rest) = std::mem::take(&mut bytes).split_at_mut(length);
            bytes = rest;
            part
        })
        .collect()
}

fn copy_row(old: &[u8], new: &mut [u8], row: &RowPlan, sources: Option<&Sources>, size: usize) {
    let Some(sources) = sources else {
        new.copy_from_slice(&old[row.old.start * size..row.old.end * size]);
        return;
    };
    // Sizes known to the compiler make the copy a move of a register or two.
    match size {
        1 => gather::<1>(old, new, &sources.items),
        4 => gather::<4>(old, new, &sources.items),
        8 => gather::<8>(old, new, &sources.items),
        12 => gather::<12>(old, new, &sources.items),
        16 => gather::<16>(old, new, &sources.items),
        24 => gather::<24>(old, new, &sources.items),
        _ => {
            for (value, &item) in new.chunks_exact_mut(size).zip(&sources.items) {
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

/// Sets the cells' ranges of items.
fn update_ranges(
    population: &mut Population,
    layout: &Layout,
    plan: &[RowPlan],
    sources: &[Option<Sources>],
) {
    let (starts, ends) = (&mut population.starts, &mut population.ends);
    for (row, sources) in plan.iter().zip(sources) {
        let cells = layout.first(row.row)..layout.first(row.row) + layout.width();
        match sources {
            None => {
                let shift = (row.new.start as u32).wrapping_sub(row.old.start as u32);
                if shift != 0 {
                    for cell in cells {
                        starts[cell] = starts[cell].wrapping_add(shift);
                        ends[cell] = ends[cell].wrapping_add(shift);
                    }
                }
            }
            Some(sources) => {
                let mut item = row.new.start as u32;
                for (cell, count) in cells.zip(&sources.counts) {
                    starts[cell] = item;
                    item += count;
                    ends[cell] = item;
                }
            }
        }
    }
}
