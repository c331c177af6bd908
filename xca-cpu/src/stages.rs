//! Which processes run together, row by row.
//!
//! Consecutive processes share a pass over the rows where no row can notice: none of them may read at
//! neighbours (or of other items) what another of them writes. Then a row goes through all of them while it
//! is in the processor's cache. A substate that one process both reads elsewhere and writes goes to a second
//! buffer, which becomes the first after the pass: no other process of the pass may touch it.

use xca_core::plan::ProcessPlan;
use xca_core::{Model, ProcessKind};

/// The numbers of processes that run together, in order.
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

/// Whether two processes would notice that they run together.
fn disturb(earlier: &ProcessPlan, later: &ProcessPlan) -> bool {
    earlier.uses.iter().any(|one| {
        later.use_of(one.substate).is_some_and(|other| {
            let doubled = one.is_doubled() || other.is_doubled();
            (one.written && other.elsewhere) || (one.elsewhere && other.written) || doubled
        })
    })
}
