//! Stages: groups of processes that run together, row by row.
//!
//! Consecutive processes share a pass over the rows if the result is the same. No process of the pass may
//! read at neighbours (or from other items) what another one writes. A row then goes through all of them
//! while it is in the cache. If one process both reads a substate elsewhere and writes it, it writes to a
//! second buffer. The second buffer becomes the first after the pass, and no other process of the pass may
//! use the substate.

use xca_core::plan::ProcessPlan;
use xca_core::{Model, ProcessKind};

/// The indices of processes that run together, in order.
pub(crate) type Stage = Vec<usize>;

/// Splits processes into stages.
pub(crate) fn stages(model: &Model, processes: impl IntoIterator<Item = usize>) -> Vec<Stage> {
    let mut stages: Vec<Stage> = Vec::new();
    for number in processes {
        let plan = model.plan().process(number);
        let joins = stages.last().is_some_and(|stage| {
            stage.iter().all(|&earlier| {
                model.processes()[earlier].kind != ProcessKind::Migration
                    && !disturb(model.plan().process(earlier), plan)
            })
        });
        match stages.last_mut() {
            Some(stage) if joins => stage.push(number),
            _ => stages.push(vec![number]),
        }
    }
    stages
}

/// Whether running two processes together would change a result.
fn disturb(earlier: &ProcessPlan, later: &ProcessPlan) -> bool {
    earlier.uses.iter().any(|one| {
        later.use_of(one.substate).is_some_and(|other| {
            let doubled = one.is_doubled() || other.is_doubled();
            (one.written && other.elsewhere) || (one.elsewhere && other.written) || doubled
        })
    })
}
