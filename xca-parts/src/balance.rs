//! When and where the bounds of parts move.
//!
//! Parts count their work. After some steps the host compares the largest work of a part with that of the
//! best cut for the same work. The difference is lost. When the losses add up to the cost of a move, the
//! bounds move. A short run therefore moves nothing, nor does an imbalance that soon ends. Items that are set
//! are work to be expected, and count like work done.
//!
//! Only counts decide, and no clock. Results depend neither on where the bounds are nor on when they move.

use crate::cut::Cut;
use std::num::NonZeroU64;
use xca_core::engine::RowWork;
use xca_core::{Geometry, Model, ProcessKind};

/// When the bounds of parts follow the work.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Balance {
    /// The steps between two looks at the work. `None`: the rows stay distributed evenly.
    pub every: Option<NonZeroU64>,
    /// What it costs to move a cell to another part, in runs of a process on a cell. The bounds move once
    /// they have lost as much as a move of all cells and items costs.
    pub cost: u64,
}

impl Balance {
    /// The rows stay distributed evenly.
    pub const NEVER: Self = Self { every: None, cost: 0 };
}

impl Default for Balance {
    /// A look every 32 steps, at a cost of 32.
    fn default() -> Self {
        Self { every: NonZeroU64::new(32), cost: 32 }
    }
}

/// A run of a process on an item, in runs on a cell: an item has neighbours to search, and its values are not
/// in a row with those of its neighbours.
const RUN_ON_ITEM: u64 = 16;

/// The cost of moving an item, in cells.
const MOVE_OF_ITEM: u64 = 4;

/// A work that is a tenth above another one is clearly more.
fn is_clear(more: u64, less: u64) -> bool {
    u128::from(more) * 10 > u128::from(less) * 11
}

/// The work of each row as one number, in runs of a process on a cell. `None` if an engine does not count.
fn weighted(work: &RowWork) -> Option<Vec<u64>> {
    let rows = work.cells.iter().zip(&work.items);
    let all: Vec<u64> = rows.map(|(cells, items)| cells + RUN_ON_ITEM * items).collect();
    (!all.is_empty()).then_some(all)
}

/// Decides when bounds move.
#[derive(Debug)]
pub(crate) struct Balancer {
    balance: Balance,
    /// The work of each row at the last look, since the executions started.
    counted: Vec<u64>,
    /// The steps since then.
    steps: u64,
    /// The steps since the executions started.
    age: u64,
    /// Whether the first step of the executions is over. It works on all cells, which says nothing.
    is_settled: bool,
    /// What bounds have lost since an imbalance is clear.
    lost: u64,
    /// How often bounds have moved.
    moves: u64,
    tally: Tally,
    /// Of each population, the items of each row as they were set. `None` if steps have followed.
    items: Vec<Option<Vec<u64>>>,
}

/// The work of all looks.
#[derive(Debug, Clone, Copy, Default)]
struct Tally {
    /// That of the part with the largest.
    largest: f64,
    /// That of a part on average.
    mean: f64,
}

impl Tally {
    fn with(self, parts: &[u64]) -> Self {
        let largest = parts.iter().copied().max().unwrap_or(0) as f64;
        let sum: f64 = parts.iter().map(|work| *work as f64).sum();
        Self { largest: self.largest + largest, mean: self.mean + sum / parts.len().max(1) as f64 }
    }
}

impl Balancer {
    pub(crate) fn new(model: &Model, balance: Balance) -> Self {
        Self {
            balance,
            counted: Vec::new(),
            steps: 0,
            age: 0,
            is_settled: false,
            lost: 0,
            moves: 0,
            tally: Tally::default(),
            items: vec![None; model.groups().len()],
        }
    }

    /// The number of steps before the next look at the work.
    pub(crate) fn steps_left(&self) -> u64 {
        let Some(every) = self.balance.every else { return u64::MAX };
        let wanted = if self.is_settled { every.get() } else { 1 };
        wanted.saturating_sub(self.steps)
    }

    /// Counts steps.
    pub(crate) fn stepped(&mut self, steps: u64) {
        self.steps += steps;
        self.age += steps;
        self.items.fill(None);
    }

    /// Takes the items of each row of a population that have been set.
    pub(crate) fn set(&mut self, group: usize, items: &[usize]) {
        self.items[group] = Some(items.iter().map(|items| *items as u64).collect());
    }

    /// Looks at the work of each row since the start of the executions. Returns a cut to move to, if it pays.
    /// `cost` tells how many cells and items are to be moved.
    pub(crate) fn look(&mut self, model: &Model, cut: &Cut, work: &RowWork, cost: Cost) -> Option<Cut> {
        let Some(all) = weighted(work) else {
            // Nothing is counted, so nothing is to be looked at.
            self.steps = 0;
            self.is_settled = true;
            return None;
        };
        let recent = self.since_last(&all);
        self.tally = self.tally.with(&cut.work_of_parts(model.geometry(), &recent));
        let (is_settled, steps) = (self.is_settled, self.steps);
        (self.counted, self.steps, self.is_settled) = (all, 0, true);
        (is_settled && steps > 0).then(|| self.judge(model.geometry(), cut, &recent, cost)).flatten()
    }

    /// Judges the work to be expected of items that have been set, if all populations have. Returns a cut to
    /// move to, if it pays soon.
    pub(crate) fn expect(&mut self, model: &Model, cut: &Cut, cost: Cost) -> Option<Cut> {
        let every = self.balance.every?.get();
        // Bounds that have just moved stay, even if items are set in each step.
        let has_moved = (1..every).contains(&self.age);
        if has_moved || self.items.iter().all(Option::is_none) {
            return None;
        }
        let items = std::mem::replace(&mut self.items, vec![None; model.groups().len()]);
        let [width, height, depth] = model.geometry().extents();
        let mut work = RowWork { cells: vec![0; height * depth], items: vec![0; height * depth] };
        for (number, process) in model.processes().iter().enumerate() {
            if process.kind == ProcessKind::Cells {
                work.cells.iter_mut().for_each(|cells| *cells += width as u64 * every);
            }
            if let Some(group) = model.plan().process(number).population {
                // The items of a population that has not been set are unknown.
                let set = items[group].as_ref()?;
                work.items.iter_mut().zip(set).for_each(|(items, set)| *items += set * every);
            }
        }
        let lost = std::mem::take(&mut self.lost);
        let cut = self.judge(model.geometry(), cut, &weighted(&work)?, cost);
        if cut.is_none() {
            self.lost = lost;
        }
        cut
    }

    /// Adds up what is lost, and returns the better cut once it pays.
    fn judge(&mut self, geometry: &Geometry, cut: &Cut, work: &[u64], cost: Cost) -> Option<Cut> {
        let largest = |cut: &Cut| cut.work_of_parts(geometry, work).into_iter().max().unwrap_or(0);
        let now = largest(cut);
        let mean = work.iter().sum::<u64>() / cut.count().max(1) as u64;
        let better = is_clear(now, mean).then(|| Cut::balanced(geometry, cut.grid(), work));
        let better = better.map(|better| (largest(&better), better)).filter(|(best, _)| is_clear(now, *best));
        let Some((best, better)) = better else {
            self.lost = 0;
            return None;
        };
        self.lost += now - best;
        (self.lost >= cost.of_move(self.balance)).then_some(better)
    }

    /// The executions have started anew with other bounds.
    pub(crate) fn moved(&mut self) {
        self.counted.clear();
        (self.steps, self.age, self.is_settled, self.lost) = (0, 0, false, 0);
        self.moves += 1;
    }

    /// Figures for reports, with the work since the last look.
    pub(crate) fn figures(&self, geometry: &Geometry, cut: &Cut, work: &RowWork) -> Vec<(String, f64)> {
        let mut figures = vec![("bounds_moved".to_owned(), self.moves as f64)];
        if let Some(all) = weighted(work) {
            let tally = self.tally.with(&cut.work_of_parts(geometry, &self.since_last(&all)));
            if tally.mean > 0.0 {
                figures.push(("imbalance".to_owned(), tally.largest / tally.mean));
            }
        }
        figures
    }

    fn since_last(&self, all: &[u64]) -> Vec<u64> {
        let before = |row: usize| self.counted.get(row).copied().unwrap_or(0);
        all.iter().enumerate().map(|(row, work)| work.saturating_sub(before(row))).collect()
    }
}

/// What is to be moved.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cost {
    pub(crate) cells: u64,
    pub(crate) items: u64,
}

impl Cost {
    /// In runs of a process on a cell.
    fn of_move(self, balance: Balance) -> u64 {
        balance.cost.saturating_mul(self.cells.saturating_add(self.items.saturating_mul(MOVE_OF_ITEM)))
    }
}

#[cfg(test)]
mod tests;
