//! The rows of a pass: all processes, one after the other, in each row.
#![allow(unsafe_code)]

use super::found::{Found, Mover};
use super::ground::Ground;
use super::now::{Now, Report};
use super::prepare::Ready;
use super::prepared::Prepared;
use super::search::{Measured, Searches};
use super::tools::{Buffers, Cells, Outcome, Work};
use crate::activity::{Activity, DueRow};
use crate::group::{Group, population};
use crate::layout::Layout;
use crate::motion::{Motion, moves};
use crate::population::Population;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};
use xca_core::engine::Fault;
use xca_core::kernel::{Frame, Row, RowItems, STAY, StoppedAt};
use xca_core::storage::Buffer;
use xca_core::{Model, Parity, ProcessKind, Stream};

/// The places where processes are due.
#[derive(Clone, Copy)]
pub(super) struct Followed<'a> {
    pub(super) activity: &'a Activity,
    /// The processes of the pass.
    pub(super) processes: &'a [usize],
    /// The due rows. `None` if all rows are needed.
    pub(super) due: Option<&'a [DueRow]>,
}

/// The rows at the borders of a part of the space, or all others.
#[derive(Clone, Copy)]
pub(super) struct Only<'a> {
    /// Whether each row sees another part.
    pub(super) at_border: &'a [bool],
    /// The value of the rows that are meant.
    pub(super) wanted: bool,
}

/// The rows and tiles that a pass updates. By default all.
#[derive(Clone, Copy, Default)]
pub(super) struct Selection<'a> {
    pub(super) followed: Option<Followed<'a>>,
    pub(super) only: Option<Only<'a>>,
}

impl Only<'_> {
    fn means(self, row: usize) -> bool {
        self.at_border[row] == self.wanted
    }
}

/// The data that the rows of a pass share.
pub(super) struct Pass<'a> {
    pub(super) model: &'a Model,
    pub(super) layout: &'a Layout,
    parity: Parity,
    /// The frames of even and odd rows or columns, for each process.
    frames: Vec<[Frame<'a>; 2]>,
    pub(super) prepared: &'a [Prepared<'a>],
    /// The halo cells that continue a row, with their sources.
    pub(super) continuation: Vec<(isize, isize)>,
    /// Whether rows are also continued beyond the faces along y and z.
    pub(super) continues_lines: bool,
    groups: &'a [Group],
    searches: &'a Searches,
    measured: &'a [Measured],
    selection: Selection<'a>,
}

impl<'a> Pass<'a> {
    pub(super) fn new(
        Ground { model, layout, .. }: Ground<'a>,
        groups: &'a [Group],
        ready: &'a Ready<'a>,
        offsets: &'a [Vec<isize>; 2],
        selection: Selection<'a>,
    ) -> Self {
        let geometry = model.geometry();
        let frame = |index: usize, odd: usize| Frame {
            geometry,
            extents: geometry.extents().map(|extent| extent as u32),
            side: geometry.side(),
            toroidal: geometry.toroidal(),
            step: ready.context.step,
            seed: ready.context.seed,
            stream: Stream::process(index),
            parameters: ready.context.parameters,
            offsets: &offsets[odd],
            filter: ready.searches.filter.as_ref(),
        };
        let processes = ready.processes.iter();
        Self {
            model,
            layout,
            parity: geometry.neighbourhood().parity(),
            frames: processes.map(|prepared| [0, 1].map(|odd| frame(prepared.index, odd))).collect(),
            prepared: &ready.processes,
            continuation: layout.continuation(),
            continues_lines: ready.continues_lines,
            groups,
            searches: &ready.searches,
            measured: &ready.measured,
            selection,
        }
    }

    /// The findings of a pass without rows.
    pub(super) fn nothing(&self) -> Found {
        Found { motions: vec![Motion::NONE; self.measured.len()], ..Found::default() }
    }

    /// Runs all processes over some rows, one row after the other. `rows` are rows, or indices into the due
    /// rows.
    pub(super) fn work(&self, rows: Range<usize>, found: &mut Found) {
        let model = self.model;
        let now = Now::default();
        // Indices into the list of due rows, if there is one.
        let (mut rows, mut processes) = (rows, self.prepared.len());
        while let Err(panic) = catch_unwind(AssertUnwindSafe(|| {
            self.rows(rows.clone(), processes, &now, found);
        })) {
            let (number, row, at) = (now.process.get(), now.row.get(), now.stopped.get());
            let Prepared { process, index, .. } = self.prepared[number];
            // A fault reported earlier in the row comes first.
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
            // A fault of an earlier process comes first, in any row.
            (rows, processes) = (now.place.get() + 1..rows.end, number);
        }
    }

    /// Runs the first processes of the pass over rows.
    fn rows(&self, rows: Range<usize>, processes: usize, now: &Now, found: &mut Found) {
        let model = self.model;
        let mut work = Work::begin(now);
        let populations: Vec<Option<&Population>> =
            self.prepared.iter().map(|prepared| self.population(prepared)).collect();
        let Selection { followed, only } = self.selection;
        let due = followed.and_then(|followed| followed.due);
        for place in rows {
            let row = due.map_or(place, |due| due[place].row);
            if only.is_some_and(|only| !only.means(row)) {
                continue;
            }
            let first = self.layout.first(row);
            let origin = self.layout.origin(row).map(|index| index as u32);
            work.buffers.positions.resize_with(self.measured.len(), || Buffer::zeroed(0));
            for (measured, before) in self.measured.iter().zip(&mut work.buffers.positions) {
                measured.keep(self.groups, row, before);
            }
            let those = self.prepared[..processes].iter().zip(&populations);
            for (number, (prepared, population)) in those.enumerate() {
                now.start(number, row, place);
                let own = population.map_or((0, 0), |population| population.row(row));
                if prepared.process.kind != ProcessKind::Cells && own.0 == own.1 {
                    continue;
                }
                if prepared.process.kind == ProcessKind::Migration {
                    work.buffers.answers.clear();
                    work.buffers.answers.resize(own.1 - own.0, STAY);
                }
                let cells = Cells { row, first, origin, length: self.layout.width(), own };
                let widest = match followed {
                    Some(followed) if prepared.process.kind == ProcessKind::Cells => {
                        let done = self.run_pieces(followed, prepared, (row, &cells), *population, &mut work);
                        found.worked += done.cells as u64;
                        followed.activity.worked_in(row, done.cells);
                        done.widest
                    }
                    _ => {
                        let outcome = self.run_row(prepared, &cells, *population, &mut work);
                        if prepared.continues {
                            self.continue_row(prepared, row);
                        }
                        outcome.widest
                    }
                };
                found.searched(number, widest);
                if let Some(fault) = now.reported.get() {
                    found.keep(
                        prepared.index,
                        fault.cell,
                        Fault::reported(prepared.process, fault, model.geometry()),
                    );
                }
                if let (ProcessKind::Migration, Some(population)) = (prepared.process.kind, population) {
                    self.collect_movers(population, row, &work.buffers.answers, &mut found.movers);
                }
            }
            let Buffers { positions, answers, .. } = &work.buffers;
            for ((measured, before), motion) in self.measured.iter().zip(positions).zip(&mut found.motions) {
                let now = measured.measure_row(model, self.layout, self.groups, row, (before, answers));
                *motion = motion.and(now);
            }
        }
        work.end();
    }

    fn population(&self, prepared: &Prepared<'_>) -> Option<&Population> {
        population(&self.groups[prepared.population?])
    }

    pub(super) fn run_row(
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
        // The neighbourhood differs between cells, so each cell is a row of its own.
        let mut outcome = Outcome::default();
        for number in 0..cells.length {
            let (first, x) = (cells.first + number, cells.origin[0] as usize + number);
            let own = population.map_or((0, 0), |population| {
                (population.starts[first] as usize, population.ends[first] as usize)
            });
            let [_, y, z] = cells.origin;
            let cell = Cells { row: cells.row, first, origin: [x as u32, y, z], length: 1, own };
            // In a row without items, the ranges of cells are empty and may start anywhere.
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
        work.buffers.entries.clear();
        work.buffers
            .entries
            .extend(prepared.substates.iter().map(|shared| shared.entry(cells.first, cells.own.0)));
        let near = population.and_then(|population| {
            let radius = self.searches.listed[prepared.population?]?;
            let lists = population.lists.as_ref().filter(|lists| lists.are_whole(cells.row))?;
            Some(lists.view(&population.items, radius))
        });
        let items = population.map(|population| RowItems {
            // Not a slice of the array, because neighbours also lie before the row.
            starts: population.starts.as_ptr().wrapping_add(cells.first),
            ends: population.ends.as_ptr().wrapping_add(cells.first),
            labels: &population.items.labels,
            own: cells.own,
            cells: &population.items.cells[cells.own.0..cells.own.1],
            near: near.as_ref(),
        });
        let migrates = prepared.process.kind == ProcessKind::Migration;
        let destinations = migrates
            .then(|| &mut work.buffers.answers[first_answer..first_answer + cells.own.1 - cells.own.0]);
        // SAFETY:
        // - `entries` follow the process's accesses, in buffers that are aligned for every scalar and hold
        //   values of the schema's types.
        // - Planes have a halo as wide as the neighbourhood, and the offsets are made from the same layout.
        //   All of them can therefore be read from every cell of the row. Planes of items hold as many values
        //   as labels.
        // - What is written belongs to the row's own cells or items. Rows are disjoint, and each is run by
        //   one thread.
        // - A process that reads a substate elsewhere and writes it writes to the second buffer. No process
        //   of a stage writes what another process of the stage reads elsewhere (`stages`). A pass in the
        //   wake of another is at no row that sees this one (`Wavefront`). So nothing readable is written
        //   meanwhile, by this row or by another.
        // - `starts` and `ends` are padded like planes and hold ranges of items; those of a row's cells are
        //   the row's own items.
        let row = unsafe {
            Row::new(
                frame,
                &work.buffers.entries,
                items,
                destinations,
                &work.scratch,
                cells.origin,
                cells.length,
            )
        };
        let report = Report { row: &row, now: work.now };
        (prepared.kernel)(report.row);
        Outcome { widest: row.widest_search(), asked_for_step: row.has_asked_for_step() }
    }

    fn collect_movers(&self, population: &Population, row: usize, answers: &[u32], movers: &mut Vec<Mover>) {
        let (first, end) = population.row(row);
        let cells = &population.items.cells[first..end];
        // In most rows no item moves. This loop has no branch, and so compares many items at once.
        let any = cells.iter().zip(answers).fold(false, |any, (from, answer)| any | moves(*from, *answer));
        if !any {
            return;
        }
        for ((item, from), answer) in (first as u32..).zip(cells).zip(answers) {
            if moves(*from, *answer) {
                movers.push(Mover { item, from: *from, answer: *answer });
            }
        }
    }
}
