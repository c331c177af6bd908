//! Passes over the rows, in parallel.
//!
//! The rows are split into pieces. Each belongs to one thread at a time. Neither the split nor the distance
//! between passes changes a result. A row writes only its own values, and faults are compared by pass,
//! process and cell.

mod found;
mod ground;
mod halo;
mod now;
mod pass;
mod pieces;
mod prepare;
mod prepared;
mod search;
mod tools;

use crate::activity::{Activity, DueRow};
use crate::blocks::{blocks, blocks_of_due, long_blocks};
use crate::dense::Halo;
use crate::group::{Group, population};
use crate::population::Population;
use found::Found;
pub(crate) use found::{FirstFault, Mover};
pub(crate) use ground::{Ground, StageOfStep};
use pass::{Followed, Only, Pass, Selection};
use prepare::Ready;
use rayon::prelude::*;
use search::Searches;
pub(crate) use search::searched;
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;
use xca_core::Model;
use xca_wavefront::{Depth, Piece, Wavefront};

/// A pass that has done its first rows.
pub(crate) struct Begun {
    first: Rows,
    searches: Searches,
    /// The rows in which something was due. `None` if all rows are needed.
    due: Option<Vec<DueRow>>,
    found: Found,
}

/// Some rows of a part of a space: those that see another part, or all others.
#[derive(Debug, Clone)]
pub(crate) struct Rows {
    /// Whether each row sees another part.
    pub(crate) at_border: Arc<[bool]>,
    /// The value of these rows.
    pub(crate) wanted: bool,
}

impl Rows {
    /// The selection of these rows.
    fn only(&self) -> Only<'_> {
        Only { at_border: &self.at_border, wanted: self.wanted }
    }

    /// All other rows.
    fn others(self) -> Self {
        Self { wanted: !self.wanted, ..self }
    }
}

impl Begun {
    /// The items that the migration moves in these rows.
    pub(crate) fn movers(&self) -> &[Mover] {
        &self.found.movers
    }
}

/// Begins a pass in a part of a space: runs some rows. [`run`] ends it. Rows that see another part need its
/// edges.
pub(crate) fn begin(
    ground: Ground<'_>,
    groups: &mut [Group],
    stage: StageOfStep<'_>,
    activity: Option<&Activity>,
    first: Rows,
) -> Begun {
    let due = activity.and_then(|activity| activity.rows(stage.processes));
    let ready = [Ready::of_first_rows(ground, groups, stage)];
    let order = Wavefront::of_one_pass(blocks_of(ground, groups, stage.processes, due.as_deref()));
    let selection = Selection {
        followed: activity.map(|activity| Followed {
            activity,
            processes: stage.processes,
            due: due.as_deref(),
        }),
        only: Some(first.only()),
    };
    let found = work(ground, groups, &ready, &order, selection).into_iter().next().unwrap_or_default();
    let [Ready { searches, .. }] = ready;
    Begun { first, searches, due, found }
}

/// Runs a pass over the rows, or over those that are left of a pass that has begun. With `activity`, its
/// processes run only where they are due. Returns the items that its migration moves, in the order of items.
pub(crate) fn run(
    ground: Ground<'_>,
    groups: &mut [Group],
    stage: StageOfStep<'_>,
    activity: Option<&mut Activity>,
    begun: Option<Begun>,
) -> Result<Vec<Mover>, FirstFault> {
    let due = activity.as_ref().and_then(|activity| activity.rows(stage.processes));
    let is_quiet = |due: &Option<Vec<DueRow>>| due.as_ref().is_some_and(Vec::is_empty);
    if is_quiet(&due) && begun.as_ref().is_none_or(|begun| is_quiet(&begun.due)) {
        if let Some(activity) = activity {
            activity.worked(stage.processes, 0);
        }
        return Ok(Vec::new());
    }
    let (rest, searches, due_before, found_before) = match begun {
        Some(Begun { first, searches, due, found }) => {
            (Some(first.others()), Some(searches), due, Some(found))
        }
        None => (None, None, None, None),
    };
    let ready = [Ready::new(ground, groups, stage, searches)];
    let order = Wavefront::of_one_pass(blocks_of(ground, groups, stage.processes, due.as_deref()));
    let followed = activity.as_deref().map(|activity| Followed {
        activity,
        processes: stage.processes,
        due: due.as_deref(),
    });
    let only = rest.as_ref().map(Rows::only);
    let mut found = work(ground, groups, &ready, &order, Selection { followed, only });
    if let (Some(found), Some(before)) = (found.first_mut(), found_before) {
        found.join(before);
    }
    let worked = found.iter().map(|found| found.worked).sum();
    let movers = conclude(groups, &ready, found)?;
    let Some(activity) = activity else { return Ok(movers) };
    activity.worked(stage.processes, worked);
    match &due {
        Some(due) => {
            let due = due_before.iter().flatten().chain(due);
            activity.end_pass(stage.processes, due.map(|due| due.row));
        }
        None => activity.end_pass(stage.processes, 0..ground.layout.rows()),
    }
    Ok(movers)
}

/// Runs passes over all rows, each in the wake of the previous one. None of them may involve items.
pub(crate) fn run_in_wake(
    ground: Ground<'_>,
    groups: &mut [Group],
    stages: &[StageOfStep<'_>],
    depth: Depth,
) -> Result<(), FirstFault> {
    let ready: Vec<Ready<'_>> = stages.iter().map(|stage| Ready::in_wake(ground, groups, *stage)).collect();
    let blocks = long_blocks(ground.layout, rayon::current_num_threads(), depth);
    let found = work(ground, groups, &ready, &Wavefront::new(depth, blocks), Selection::default());
    conclude(groups, &ready, found).map(drop)
}

/// Like [`run_in_wake`], in a part of a space: without the layers at its borders, which [`run_at_borders`]
/// does pass by pass. The buffers and what is known of halos are then as before the first pass.
pub(crate) fn run_within_borders(
    ground: Ground<'_>,
    groups: &mut [Group],
    stages: &[StageOfStep<'_>],
    depth: Depth,
) -> Result<(), FirstFault> {
    let planes = |groups: &[Group]| -> Vec<Vec<Halo>> {
        let of_group = |group: &Group| match group {
            Group::Cells(planes) => planes.iter().map(|plane| plane.halo).collect(),
            Group::Population(_) => Vec::new(),
        };
        groups.iter().map(of_group).collect()
    };
    let halos = planes(groups);
    let ready: Vec<Ready<'_>> = stages.iter().map(|stage| Ready::in_wake(ground, groups, *stage)).collect();
    let blocks = long_blocks(ground.layout, rayon::current_num_threads(), depth);
    let found = work(ground, groups, &ready, &Wavefront::new(depth, blocks), Selection::default());
    for &(substate, second) in ready.iter().flat_map(|ready| &ready.written) {
        if let Group::Cells(planes) = &mut groups[substate.group] {
            planes[substate.field].swap(second);
        }
    }
    for (group, halos) in groups.iter_mut().zip(halos) {
        if let Group::Cells(planes) = group {
            planes.iter_mut().zip(halos).for_each(|(plane, halo)| plane.halo = halo);
        }
    }
    conclude(groups, &ready, found).map(drop)
}

/// Runs a pass over the layers that [`run_within_borders`] has left out of it.
pub(crate) fn run_at_borders(
    ground: Ground<'_>,
    groups: &mut [Group],
    (stage, pass): (StageOfStep<'_>, usize),
    depth: Depth,
) -> Result<(), FirstFault> {
    let ready = [Ready::new(ground, groups, stage, None)];
    let layer = depth.lag.layer;
    let share = |layers: Range<usize>| {
        let rows = layers.start * layer..layers.end * layer;
        let length = rows.len().div_ceil(4 * rayon::current_num_threads()).max(1);
        let end = rows.end;
        rows.step_by(length).map(move |start| start..(start + length).min(end))
    };
    let blocks = depth.layers_at_borders(pass, ground.layout.rows() / layer).flat_map(share).collect();
    let found = work(ground, groups, &ready, &Wavefront::of_one_pass(blocks), Selection::default());
    conclude(groups, &ready, found).map(drop).map_err(|first| FirstFault { pass, ..first })
}

/// The blocks of rows for the threads: those of the due rows, or of all.
fn blocks_of(
    ground: Ground<'_>,
    groups: &[Group],
    processes: &[usize],
    due: Option<&[DueRow]>,
) -> Vec<Range<usize>> {
    if let Some(due) = due {
        return blocks_of_due(due, rayon::current_num_threads());
    }
    let populations = populations(ground.model, groups, processes);
    blocks(ground.layout, &populations, rayon::current_num_threads())
}

/// The populations that processes use, each once.
fn populations<'a>(model: &Model, groups: &'a [Group], processes: &[usize]) -> Vec<&'a Population> {
    let numbers = processes.iter().filter_map(|process| model.plan().process(*process).population);
    let mut numbers: Vec<usize> = numbers.collect();
    numbers.sort_unstable();
    numbers.dedup();
    numbers.into_iter().filter_map(|number| population(&groups[number])).collect()
}

/// Runs all pieces of all passes. Returns the findings of each pass.
fn work(
    ground: Ground<'_>,
    groups: &[Group],
    ready: &[Ready<'_>],
    order: &Wavefront,
    selection: Selection<'_>,
) -> Vec<Found> {
    let offsets = ground.layout.offsets(ground.model.geometry());
    let passes: Vec<Pass<'_>> =
        ready.iter().map(|ready| Pass::new(ground, groups, ready, &offsets, selection)).collect();
    // Later passes do not count after a fault, and their input may be invalid.
    let faulty = AtomicUsize::new(usize::MAX);
    let piece = |piece: Piece| {
        let mut found: Vec<Found> = passes.iter().map(Pass::nothing).collect();
        for portion in order.portions(piece) {
            if portion.pass > faulty.load(Ordering::Relaxed) {
                continue;
            }
            let found = &mut found[portion.pass];
            passes[portion.pass].work(portion.rows, found);
            if found.fault.is_some() {
                faulty.fetch_min(portion.pass, Ordering::Relaxed);
            }
        }
        found
    };
    let start = Instant::now();
    let mut all: Vec<Found> = passes.iter().map(Pass::nothing).collect();
    for pieces in order.pieces() {
        // Each piece can run on another thread.
        let pieces = pieces.into_par_iter().with_max_len(1);
        let found: Vec<Vec<Found>> = pieces.map(piece).collect();
        for found in found {
            all.iter_mut().zip(found).for_each(|(all, found)| all.add(found));
        }
    }
    let time = start.elapsed();
    all.iter_mut().for_each(|found| found.time = time);
    all
}

/// Stores the findings of the passes. Returns the items that the last pass moves.
fn conclude(groups: &mut [Group], ready: &[Ready<'_>], found: Vec<Found>) -> Result<Vec<Mover>, FirstFault> {
    let mut movers = Vec::new();
    for (number, (ready, found)) in ready.iter().zip(found).enumerate() {
        if let Some(fault) = found.fault {
            return Err(FirstFault { pass: number, ..fault });
        }
        for &number in &ready.searches.populations {
            let processes = ready.processes.iter().zip(&found.widest);
            let of_population = processes.filter(|(process, _)| process.population == Some(number));
            let widest = of_population.fold(0.0_f64, |widest, (_, one)| widest.max(*one));
            if let Group::Population(population) = &mut groups[number] {
                population.upkeep.searched(widest, ready.searches.listed[number].is_some(), found.time);
            }
        }
        for (measured, motion) in ready.measured.iter().zip(found.motions) {
            if let Group::Population(population) = &mut groups[measured.population] {
                population.measured(motion);
            }
        }
        movers = found.movers;
    }
    Ok(movers)
}
