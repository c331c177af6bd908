//! One pass over the rows, in parallel.
//!
//! The rows are split into blocks of consecutive rows; each block belongs to one thread at a time. How they are split changes nothing in the
//! result: a row writes only what is its own, and faults are compared by process and cell.
#![allow(unsafe_code)]

mod found;
mod now;
mod pieces;
mod prepare;
mod prepared;
mod search;

use crate::activity::{Activity, DueRow};
use crate::blocks::{blocks, blocks_of_due};
use crate::group::{Group, population};
use crate::layout::Layout;
use crate::motion::Motion;
use crate::population::Population;
use found::Found;
pub(crate) use found::{FirstFault, Mover};
use now::{Now, Report};
use pieces::Pieces;
use prepare::prepare_buffers;
use prepared::{Prepared, prepare};
use rayon::prelude::*;
use search::{Measured, Searches};
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;
use xca_core::engine::{Fault, StepContext};
use xca_core::kernel::{Entry, Frame, Row, RowItems, STAY, Scratch, StoppedAt};
use xca_core::{Model, Parity, Precision, ProcessKind, Stream};

/// Runs processes together over all rows, or with `activity` where they are due. The result is what the migration among them, if there is one,
/// moves, in the order of items.
pub(crate) fn run(
    model: &Model,
    layout: &Layout,
    precision: Precision,
    groups: &mut [Group],
    processes: &[usize],
    mut activity: Option<&mut Activity>,
    context: &StepContext<'_>,
) -> Result<Vec<Mover>, FirstFault> {
    let due = activity.as_ref().and_then(|activity| activity.rows(processes));
    if let (Some(activity), Some([])) = (&mut activity, due.as_deref()) {
        activity.worked(processes, 0);
        return Ok(Vec::new());
    }
    let geometry = model.geometry();
    let written = prepare_buffers(model, layout, groups, processes);
    let searches = search::prepare(model, layout, precision, groups, processes);
    let prepared: Vec<Prepared<'_>> = processes
        .iter()
        .enumerate()
        .map(|(number, &index)| prepare(model, layout, groups, (number, index), precision, &written))
        .collect();
    let offsets = layout.offsets(geometry);
    let measured = Measured::all(model, groups, processes, &written);
    let frame = |index: usize, odd: usize| Frame {
        geometry,
        extents: geometry.extents().map(|extent| extent as u32),
        side: geometry.side(),
        toroidal: geometry.toroidal(),
        step: context.step,
        seed: context.seed,
        stream: Stream::process(index),
        parameters: context.parameters,
        offsets: &offsets[odd],
        filter: searches.filter.as_ref(),
    };
    let frames = prepared.iter().map(|prepared| [0, 1].map(|odd| frame(prepared.index, odd))).collect();
    let continuation = layout.continuation();
    let parity = geometry.neighbourhood().parity();
    let pass = Pass {
        layout,
        parity,
        frames,
        prepared,
        continuation,
        groups,
        searches: &searches,
        measured: &measured,
        activity: activity.as_deref(),
        due: due.as_deref(),
    };
    // Each block can go to another thread.
    let blocks = pass.blocks().into_par_iter().with_max_len(1);
    let start = Instant::now();
    let found: Vec<Found> = blocks.map(|rows| pass.block(model, rows)).collect();
    let time = start.elapsed();
    let mut movers = Vec::new();
    let mut first = Found::default();
    let mut motions = vec![Motion::NONE; measured.len()];
    let mut widest = vec![0.0_f64; processes.len()];
    let mut worked = 0;
    for block in found {
        worked += block.worked;
        movers.extend(block.movers);
        motions.iter_mut().zip(block.motions).for_each(|(all, one)| *all = all.and(one));
        widest.iter_mut().zip(block.widest).for_each(|(all, one)| *all = all.max(one));
        if let Some(FirstFault { process, cell, fault }) = block.fault {
            first.keep(process, cell, fault);
        }
    }
    if let Some(fault) = first.fault {
        return Err(fault);
    }
    for &number in &searches.populations {
        let of_population = processes
            .iter()
            .zip(&widest)
            .filter(|(process, _)| model.plan().process(**process).population == Some(number));
        let widest = of_population.fold(0.0_f64, |widest, (_, one)| widest.max(*one));
        if let Group::Population(population) = &mut groups[number] {
            population.upkeep.searched(widest, searches.listed[number].is_some(), time);
        }
    }
    for (measured, motion) in measured.iter().zip(motions) {
        if let Group::Population(population) = &mut groups[measured.population] {
            population.measured(motion);
        }
    }
    if let Some(activity) = activity {
        activity.worked(processes, worked);
        for (substate, _) in written.iter().filter(|(one, _)| matches!(groups[one.group], Group::Cells(_))) {
            match &due {
                Some(due) => activity.spread(*substate, processes, due.iter().map(|due| due.row)),
                None => activity.spread(*substate, processes, 0..layout.rows()),
            }
        }
    }
    for (substate, second) in written {
        match &mut groups[substate.group] {
            Group::Cells(planes) => planes[substate.field].written(second),
            Group::Population(population) if second => {
                std::mem::swap(
                    &mut population.items.fields[substate.field],
                    &mut population.next[substate.field],
                );
            }
            Group::Population(_) => {}
        }
    }
    Ok(movers)
}

/// Everything that the rows of a pass share.
struct Pass<'a> {
    layout: &'a Layout,
    parity: Parity,
    /// For each process those of even and odd rows or columns.
    frames: Vec<[Frame<'a>; 2]>,
    prepared: Vec<Prepared<'a>>,
    /// The cells of the halo that continue a row, with their sources.
    continuation: Vec<(isize, isize)>,
    groups: &'a [Group],
    searches: &'a Searches,
    measured: &'a [Measured],
    /// What is known of where processes are due.
    activity: Option<&'a Activity>,
    /// The rows in which they are, where not all rows are needed.
    due: Option<&'a [DueRow]>,
}

impl Pass<'_> {
    /// Shares the rows among the threads: ranges of rows, or of those that are due.
    fn blocks(&self) -> Vec<Range<usize>> {
        if let Some(due) = self.due {
            return blocks_of_due(due, rayon::current_num_threads());
        }
        let mut numbers: Vec<usize> =
            self.prepared.iter().filter_map(|prepared| prepared.population).collect();
        numbers.sort_unstable();
        numbers.dedup();
        let populations: Vec<&Population> =
            numbers.into_iter().filter_map(|number| population(&self.groups[number])).collect();
        blocks(self.layout, &populations, rayon::current_num_threads())
    }

    /// Runs all processes over a block of rows, one row after the other.
    fn block(&self, model: &Model, rows: Range<usize>) -> Found {
        let mut found = Found {
            motions: vec![Motion::NONE; self.measured.len()],
            widest: vec![0.0; self.prepared.len()],
            ..Found::default()
        };
        let now = Now::default();
        // Numbers in the list of those that are due, if there is one.
        let (mut rows, mut processes) = (rows, self.prepared.len());
        while let Err(panic) = catch_unwind(AssertUnwindSafe(|| {
            self.rows(model, rows.clone(), processes, &now, &mut found);
        })) {
            let (number, row, at) = (now.process.get(), now.row.get(), now.stopped.get());
            let Prepared { process, index, .. } = self.prepared[number];
            // What the row had reported before comes first.
            match now.reported.get() {
                Some(fault) => {
                    found.keep(index, fault.cell, Fault::reported(process, fault, model.geometry()));
                }
                None => {
                    let first = || model.geometry().linear(self.layout.origin(row)) as u32;
                    let at = at.unwrap_or_else(|| StoppedAt { cell: first(), label: None });
                    found.keep(index, at.cell, Fault::panicked(process, at, &*panic, model.geometry()));
                }
            }
            // The fault of an earlier process comes first, in whatever row.
            (rows, processes) = (now.place.get() + 1..rows.end, number);
        }
        found
    }

    /// Runs the first processes over rows.
    fn rows(&self, model: &Model, rows: Range<usize>, processes: usize, now: &Now, found: &mut Found) {
        let mut work = Work {
            entries: Vec::new(),
            answers: Vec::new(),
            scratch: Scratch::default(),
            pieces: Pieces::default(),
            now,
        };
        let populations: Vec<Option<&Population>> =
            self.prepared.iter().map(|prepared| self.population(prepared)).collect();
        for place in rows {
            let row = self.due.map_or(place, |due| due[place].row);
            let first = self.layout.first(row);
            let origin = self.layout.origin(row).map(|index| index as u32);
            let those = self.prepared[..processes].iter().zip(&populations);
            for (number, (prepared, population)) in those.enumerate() {
                now.start(number, row, place);
                let own = population.map_or((0, 0), |population| population.row(row));
                if prepared.process.kind != ProcessKind::Cells && own.0 == own.1 {
                    continue;
                }
                if prepared.process.kind == ProcessKind::Migration {
                    work.answers.clear();
                    work.answers.resize(own.1 - own.0, STAY);
                }
                let cells = Cells { first, origin, length: self.layout.width(), own };
                let widest = match self.activity {
                    Some(activity) if prepared.process.kind == ProcessKind::Cells => {
                        let done = self.run_pieces(activity, prepared, (row, &cells), *population, &mut work);
                        found.worked += done.cells as u64;
                        done.widest
                    }
                    _ => {
                        let outcome = self.run_row(prepared, &cells, *population, &mut work);
                        self.continue_row(prepared, first);
                        outcome.widest
                    }
                };
                found.widest[number] = found.widest[number].max(widest);
                if let Some(fault) = now.reported.get() {
                    found.keep(
                        prepared.index,
                        fault.cell,
                        Fault::reported(prepared.process, fault, model.geometry()),
                    );
                }
                if let (ProcessKind::Migration, Some(population)) = (prepared.process.kind, population) {
                    self.collect_movers(population, row, &work.answers, &mut found.movers);
                }
            }
            for (measured, motion) in self.measured.iter().zip(&mut found.motions) {
                let now = measured.measure_row(model, self.layout, self.groups, row, &work.answers);
                *motion = motion.and(now);
            }
        }
    }

    fn population(&self, prepared: &Prepared<'_>) -> Option<&Population> {
        population(&self.groups[prepared.population?])
    }

    /// Continues what a process has written to a row into the halo along x, while the row is in the cache.
    fn continue_row(&self, prepared: &Prepared<'_>, first: usize) {
        for shared in prepared.substates.iter().filter(|shared| shared.continued) {
            let element = shared.memory.element;
            let planes = (0..shared.memory.length).map(|number| number * self.layout.cells() + first);
            let starts = planes.map(|first| shared.write.wrapping_add(first * element));
            let size = element as isize;
            let copies = starts.flat_map(|start| self.continuation.iter().map(move |copy| (start, copy)));
            for (start, (target, source)) in copies {
                // SAFETY:
                // - Source and target are cells of one padded line of a plane: the source in the row, the target in the halo beside it.
                // - No kernel writes the halo, and this is the only thread that has the row, so no one writes either of them meanwhile.
                // - No one reads the target meanwhile: a plane that is read elsewhere in this pass is written to the second buffer, of which
                //   nothing is read, or not written at all (`stages`).
                unsafe {
                    copy_value(element, start.offset(source * size), start.offset(target * size));
                }
            }
        }
    }

    fn run_row(
        &self,
        prepared: &Prepared<'_>,
        cells: &Cells,
        population: Option<&Population>,
        work: &mut Work<'_>,
    ) -> Outcome {
        let frames = &self.frames[prepared.number];
        if self.parity != Parity::Column || !prepared.process.local_interaction {
            let frame = &frames[if self.parity == Parity::Row { cells.origin[1] as usize % 2 } else { 0 }];
            return self.run_cells(prepared, frame, cells, population, 0, work);
        }
        // The neighbourhood changes from cell to cell: each is a row of its own.
        let mut outcome = Outcome::default();
        for number in 0..cells.length {
            let (first, x) = (cells.first + number, cells.origin[0] as usize + number);
            let own = population.map_or((0, 0), |population| {
                (population.starts[first] as usize, population.ends[first] as usize)
            });
            let cell = Cells { first, origin: [x as u32, cells.origin[1], cells.origin[2]], length: 1, own };
            // In a row without items the ranges of cells are empty, but may start anywhere.
            let first_answer = own.0.saturating_sub(cells.own.0);
            let one = self.run_cells(prepared, &frames[x % 2], &cell, population, first_answer, work);
            outcome.widest = outcome.widest.max(one.widest);
            outcome.asked_for_step |= one.asked_for_step;
        }
        outcome
    }

    fn run_cells(
        &self,
        prepared: &Prepared<'_>,
        frame: &Frame<'_>,
        cells: &Cells,
        population: Option<&Population>,
        first_answer: usize,
        work: &mut Work<'_>,
    ) -> Outcome {
        work.entries.clear();
        work.entries.extend(prepared.substates.iter().map(|shared| shared.entry(cells.first, cells.own.0)));
        let near = population.and_then(|population| {
            let radius = self.searches.listed[prepared.population?]?;
            Some(population.lists.as_ref()?.view(population, radius))
        });
        let items = population.map(|population| RowItems {
            // Not of a part of the list: neighbours lie before the row too.
            starts: population.starts.as_ptr().wrapping_add(cells.first),
            ends: population.ends.as_ptr().wrapping_add(cells.first),
            labels: &population.items.labels,
            own: cells.own,
            cells: &population.items.cells[cells.own.0..cells.own.1],
            near: near.as_ref(),
        });
        let migrates = prepared.process.kind == ProcessKind::Migration;
        let destinations =
            migrates.then(|| &mut work.answers[first_answer..first_answer + cells.own.1 - cells.own.0]);
        // SAFETY:
        // - `entries` follow the process's accesses, in buffers that are aligned for every scalar and hold values of the schema's types.
        // - Planes have a halo as wide as the neighbourhood, and the offsets are made from the same layout, so that all of them can be
        //   read from every cell of the row. Planes of items hold as many values as labels.
        // - What is written belongs to the row's own cells or items. Rows are disjoint, and each is run by one thread.
        // - A process that reads a substate elsewhere and writes it writes to the second buffer; no process of a stage writes what another of
        //   it reads elsewhere (`stages`). So nothing readable is written meanwhile, by this row or by another.
        // - `starts` and `ends` are padded like planes and hold ranges of items; those of a row's cells are the row's own items.
        let row = unsafe {
            Row::new(frame, &work.entries, items, destinations, &work.scratch, cells.origin, cells.length)
        };
        let report = Report { row: &row, now: work.now };
        (prepared.kernel)(report.row);
        Outcome { widest: row.widest_search(), asked_for_step: row.has_asked_for_step() }
    }

    fn collect_movers(&self, population: &Population, row: usize, answers: &[u32], movers: &mut Vec<Mover>) {
        let (first, end) = population.row(row);
        let cells = &population.items.cells[first..end];
        for ((item, from), answer) in (first as u32..).zip(cells).zip(answers) {
            if *answer != STAY && answer != from {
                movers.push(Mover { item, from: *from, answer: *answer });
            }
        }
    }
}

/// Copies one value. A size that the compiler knows makes it a move of a register.
///
/// # Safety
/// So many bytes can be read at `from` and written at `to`, and they do not overlap.
unsafe fn copy_value(size: usize, from: *const u8, to: *mut u8) {
    // SAFETY: as the function.
    unsafe {
        match size {
            1 => std::ptr::copy_nonoverlapping(from, to, 1),
            4 => std::ptr::copy_nonoverlapping(from, to, 4),
            8 => std::ptr::copy_nonoverlapping(from, to, 8),
            _ => std::ptr::copy_nonoverlapping(from, to, size),
        }
    }
}

/// What a kernel has done in some cells.
#[derive(Default)]
struct Outcome {
    /// The largest radius of a search.
    widest: f64,
    /// Whether the result may be another one in another step.
    asked_for_step: bool,
}

/// Lists that are kept from row to row.
struct Work<'a> {
    entries: Vec<Entry>,
    /// A migration's answers for the items of a row.
    answers: Vec<u32>,
    scratch: Scratch,
    pieces: Pieces,
    now: &'a Now,
}

/// The cells that a kernel is given.
struct Cells {
    /// The padded number of the first.
    first: usize,
    origin: [u32; 3],
    length: usize,
    /// Their items.
    own: (usize, usize),
}
