//! Which processes run together, row by row.
//!
//! Consecutive processes share a pass over the rows where no row can notice: none of them may read at neighbours (or of other items) what
//! another of them writes. Then a row goes through all of them while it is in the processor's cache. A substate that one process
//! both reads elsewhere and writes goes to a second buffer, which becomes the first after the pass: no other process of the pass may touch it.

use std::ops::Range;
use xca_core::engine::SubstateId;
use xca_core::{Model, Process, ProcessKind};

/// Processes that run together: a range of the model's processes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Stage {
    pub(crate) processes: Range<usize>,
}

/// Splits a range of processes into stages.
pub(crate) fn stages(model: &Model, processes: Range<usize>) -> Vec<Stage> {
    let mut stages = Vec::new();
    let mut first = processes.start;
    for index in processes.clone() {
        let alone = (first..index).any(|earlier| {
            let (earlier, later) = (&model.processes()[earlier], &model.processes()[index]);
            earlier.kind == ProcessKind::Migration || disturb(model, earlier, later)
        });
        if alone {
            stages.push(Stage { processes: first..index });
            first = index;
        }
    }
    if first < processes.end {
        stages.push(Stage { processes: first..processes.end });
    }
    stages
}

/// Whether two processes would notice that they run together.
fn disturb(model: &Model, earlier: &Process, later: &Process) -> bool {
    uses(model, earlier).iter().any(|(substate, others, write)| {
        uses(model, later).iter().any(|(same, later_others, later_write)| {
            let doubled = (*others && *write) || (*later_others && *later_write);
            substate == same && ((*write && *later_others) || (*others && *later_write) || doubled)
        })
    })
}

/// The substates of a process, each with whether it is read elsewhere, and whether it is written.
fn uses(model: &Model, process: &Process) -> Vec<(SubstateId, bool, bool)> {
    let mut uses: Vec<(SubstateId, bool, bool)> = Vec::new();
    for access in process.access {
        let substate = model.substate(process, access);
        match uses.iter_mut().find(|(known, ..)| *known == substate) {
            Some((_, others, write)) => {
                *others |= access.others;
                *write |= access.write;
            }
            None => uses.push((substate, access.others, access.write)),
        }
    }
    uses
}

/// Whether a process of the model reads the substate elsewhere and writes it.
pub(crate) fn is_doubled(model: &Model, substate: SubstateId) -> bool {
    any_use(model, substate, |others, write| others && write)
}

/// Whether a process of the model reads the substate elsewhere.
pub(crate) fn is_read_elsewhere(model: &Model, substate: SubstateId) -> bool {
    any_use(model, substate, |others, _| others)
}

fn any_use(model: &Model, substate: SubstateId, wanted: impl Fn(bool, bool) -> bool) -> bool {
    model.processes().iter().any(|process| {
        uses(model, process)
            .iter()
            .any(|(known, others, write)| *known == substate && wanted(*others, *write))
    })
}
