//! The findings of a pass.

use crate::motion::Motion;
use std::time::Duration;
use xca_core::engine::Fault;

/// The findings of a pass over a block of rows.
#[derive(Default)]
pub(super) struct Found {
    /// The items that a migration moves: item, linear index of its cell, answer.
    pub(super) movers: Vec<Mover>,
    /// The measures of the measured populations, in their order.
    pub(super) motions: Vec<Motion>,
    /// The largest search radius of each process, by its index in the pass. Processes after the last one that
    /// searches may be missing.
    pub(super) widest: Vec<f64>,
    /// The number of updated cells, counted for each process.
    pub(super) worked: u64,
    pub(super) fault: Option<FirstFault>,
    /// The time for the rows.
    pub(super) time: Duration,
}

/// The first fault by pass, process and cell.
#[derive(Debug)]
pub(crate) struct FirstFault {
    /// The index of the pass among those that run in each other's wake.
    pub(crate) pass: usize,
    /// The index of the process in the model.
    pub(crate) process: usize,
    /// The linear index of the cell.
    pub(crate) cell: u32,
    pub(crate) fault: Fault,
}

/// An item that moves to another cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Mover {
    pub(crate) item: u32,
    pub(crate) from: u32,
    pub(crate) answer: u32,
}

impl Found {
    /// Adds the findings of the same pass in other rows.
    pub(super) fn add(&mut self, other: Self) {
        self.worked += other.worked;
        self.movers.extend(other.movers);
        self.motions.iter_mut().zip(other.motions).for_each(|(all, one)| *all = all.and(one));
        other.widest.into_iter().enumerate().for_each(|(process, radius)| self.searched(process, radius));
        if let Some(FirstFault { process, cell, fault, .. }) = other.fault {
            self.keep(process, cell, fault);
        }
    }

    /// Records that a process has searched within a radius, 0 for none.
    pub(super) fn searched(&mut self, process: usize, radius: f64) {
        if radius > 0.0 {
            if self.widest.len() <= process {
                self.widest.resize(process + 1, 0.0);
            }
            self.widest[process] = self.widest[process].max(radius);
        }
    }

    /// Adds the findings of the same pass in rows before, after and between these, at another time.
    pub(super) fn join(&mut self, other: Self) {
        let time = self.time + other.time;
        self.add(other);
        self.time = time;
        self.movers.sort_unstable_by_key(|mover| mover.item);
    }

    pub(super) fn keep(&mut self, process: usize, cell: u32, fault: Fault) {
        if self.fault.as_ref().is_none_or(|first| (process, cell) < (first.process, first.cell)) {
            self.fault = Some(FirstFault { pass: 0, process, cell, fault });
        }
    }
}
