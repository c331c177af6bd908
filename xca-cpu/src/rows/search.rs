//! Preparation of the searches of a pass: the filter of cells, and neighbour lists.
#![allow(unsafe_code)]

use crate::group::{Group, population};
use crate::layout::Layout;
use crate::lists::Room;
use crate::measurement::{self, Since};
use crate::motion::{Motion, largest};
use crate::renewal::keep_lists;
use xca_core::kernel::CellFilter;
use xca_core::storage::Buffer;
use xca_core::{Model, Precision, Process, ProcessKind};

/// The data for the searches of a pass.
pub(super) struct Searches {
    /// The populations that are searched.
    pub(super) populations: Vec<usize>,
    /// The largest distance in metres, along an axis, of one of their items from its cell.
    slack: f64,
    pub(super) filter: Option<CellFilter>,
    /// The largest radius in metres for which searches can use lists, by group.
    pub(super) listed: Vec<Option<f64>>,
}

impl Searches {
    /// The same searches, with the items of other parts that are visible now.
    pub(super) fn with_ghosts(
        self,
        model: &Model,
        layout: &Layout,
        precision: Precision,
        groups: &[Group],
    ) -> Self {
        if self.populations.is_empty() {
            return self;
        }
        let searched = self.populations.iter().filter_map(|number| population(&groups[*number]));
        let slack = searched.fold(self.slack, |slack, population| largest(slack, population.slack_of_ghosts));
        let filter = CellFilter::new(model.geometry(), precision, layout.steps(), slack);
        Self { filter, ..self }
    }
}

/// The populations that processes search.
pub(crate) fn searched(model: &Model, processes: &[usize]) -> Vec<usize> {
    let searches = |process: &Process| {
        let position = process.subject().schema.position;
        let access = &process.access;
        let reads =
            || access.iter().any(|one| one.argument == 0 && one.others && Some(one.field) == position);
        process.kind == ProcessKind::Items && position.is_some() && reads()
    };
    let searching = processes.iter().filter(|number| searches(&model.processes()[**number]));
    let mut numbers: Vec<usize> =
        searching.filter_map(|number| model.plan().process(*number).population).collect();
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}

/// Measures populations as needed, and keeps their lists up to date.
pub(super) fn prepare(
    model: &Model,
    layout: &Layout,
    precision: Precision,
    groups: &mut [Group],
    processes: &[usize],
) -> Searches {
    let populations = searched(model, processes);
    let listed = vec![None; groups.len()];
    let mut searches = Searches { populations, slack: 0.0, filter: None, listed };
    if searches.populations.is_empty() {
        return searches;
    }
    let geometry = model.geometry();
    for &number in &searches.populations {
        if let Group::Population(population) = &mut groups[number] {
            let own = population.slack(layout, geometry);
            searches.slack = largest(searches.slack, own);
        }
    }
    searches = searches.with_ghosts(model, layout, precision, groups);
    let Some(filter) = &searches.filter else { return searches };
    let Some(widest) = filter.room(geometry.covered_radius(precision)) else { return searches };
    for &number in &searches.populations {
        if let Group::Population(population) = &mut groups[number]
            && let Some(motion) = population.motion
        {
            let room = Room::new(widest, geometry, &motion);
            searches.listed[number] = keep_lists(population, layout, geometry, &room);
        }
    }
    searches
}

/// A population that a pass measures while its rows are in the cache.
#[derive(Clone, Copy)]
pub(super) struct Measured {
    pub(super) population: usize,
    /// The address of its positions, and the size of each in bytes.
    positions: *const u8,
    size: usize,
    /// Whether the pass migrates the population.
    migrates: bool,
    /// Whether the pass changes positions, and there are lists.
    moves: bool,
}

// SAFETY: the pointer leads to positions that are read row by row, each by the thread that has the row.
unsafe impl Send for Measured {}
// SAFETY: as above.
unsafe impl Sync for Measured {}

impl Measured {
    /// The populations that are searched and whose positions or cells a pass changes. Excludes those whose
    /// positions are written to a second buffer.
    pub(super) fn all(
        model: &Model,
        groups: &mut [Group],
        processes: &[usize],
        written: &[(xca_core::engine::SubstateId, bool)],
    ) -> Vec<Self> {
        let mut all = Vec::new();
        for (number, group) in groups.iter_mut().enumerate() {
            let Group::Population(population) = group else { continue };
            let Some(field) = population.position.filter(|_| population.searched) else { continue };
            let migrates = processes.iter().any(|process| {
                model.processes()[*process].kind == ProcessKind::Migration
                    && model.plan().process(*process).population == Some(number)
            });
            let of_position = |(substate, _): &&(xca_core::engine::SubstateId, bool)| {
                substate.group == number && substate.field == field
            };
            let second = written.iter().find(of_position).map(|(_, second)| *second);
            if second.is_some() || migrates {
                population.motion = None;
            }
            if second == Some(false) || (migrates && second.is_none()) {
                let size = population.types[field].size();
                let positions = population.items.fields[field].as_mut_ptr().cast_const();
                let moves = second.is_some() && population.lists.is_some();
                all.push(Self { population: number, positions, size, migrates, moves });
            }
        }
        all
    }

    /// The positions of the items of a row. Not while a kernel of the row runs.
    fn positions(&self, groups: &[Group], row: usize) -> &[u8] {
        let Some(population) = population(&groups[self.population]) else { return &[] };
        let (first, end) = population.row(row);
        // SAFETY: the row's own items, which this thread alone has; no kernel of the row runs.
        unsafe {
            std::slice::from_raw_parts(self.positions.add(first * self.size), (end - first) * self.size)
        }
    }

    /// Keeps the positions of a row, before all processes of the pass, if they change.
    pub(super) fn keep(&self, groups: &[Group], row: usize, before: &mut Buffer) {
        let positions = if self.moves { self.positions(groups, row) } else { &[] };
        before.resize(positions.len());
        before.bytes_mut().copy_from_slice(positions);
    }

    /// Measures the items of a row, after all processes of the pass.
    pub(super) fn measure_row(
        &self,
        model: &Model,
        layout: &Layout,
        groups: &[Group],
        row: usize,
        (before, answers): (&Buffer, &[u32]),
    ) -> Motion {
        let Some(population) = population(&groups[self.population]) else {
            return Motion::NONE;
        };
        let (positions, since) = (self.positions(groups, row), Since::Pass(before.bytes()));
        let answers = self.migrates.then_some(answers);
        measurement::measure_row(population, layout, model.geometry(), row, positions, since, answers)
    }
}
