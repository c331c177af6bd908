//! Stages: groups of processes that run together, row by row.
//!
//! Consecutive processes share a pass over the rows if the result is the same. No process of the pass may
//! read at neighbours (or from other items) what another one writes. A row then goes through all of them
//! while it is in the cache. If one process both reads a substate elsewhere and writes it, it writes to a
//! second buffer. The second buffer becomes the first after the pass, and no other process of the pass may
//! use the substate.
//!
//! Stages over items can form a convoy: each passes over the rows in the wake of the previous one, while the
//! items are in the cache.

use crate::edges::seen;
use crate::wavefront::Lag;
use xca_core::plan::ProcessPlan;
use xca_core::{Model, ProcessKind};

/// The indices of processes that run together, in order.
pub(crate) type Stage = Vec<usize>;

/// Stages that pass over the rows together, each in the wake of the previous one.
#[derive(Debug, Clone)]
pub(crate) struct Convoy {
    /// At least one.
    pub(crate) stages: Vec<Stage>,
    /// The distance between the passes.
    pub(crate) lag: Lag,
}

impl Convoy {
    /// Splits stages into convoys. `lag` is `None` if stages must not follow each other. Only the first stage
    /// of a convoy reads elsewhere, and only the last one moves items.
    pub(crate) fn all(model: &Model, stages: Vec<Stage>, lag: Option<Lag>) -> Vec<Self> {
        let mut convoys: Vec<Self> = Vec::new();
        for stage in stages {
            let joins = lag.is_some() && seen(model, &stage).is_empty();
            match convoys.last_mut() {
                Some(convoy) if joins && !convoy.processes().any(|number| moves_items(model, number)) => {
                    convoy.stages.push(stage);
                }
                _ => convoys.push(Self { stages: vec![stage], lag: lag.unwrap_or(Lag::NONE) }),
            }
        }
        convoys
    }

    /// All processes, in order.
    pub(crate) fn processes(&self) -> impl DoubleEndedIterator<Item = usize> + '_ {
        self.stages.iter().flatten().copied()
    }

    /// The processes of the first stage.
    pub(crate) fn first(&self) -> &[usize] {
        self.stages.first().map_or(&[], Vec::as_slice)
    }
}

/// Whether a process migrates items or writes their positions.
fn moves_items(model: &Model, number: usize) -> bool {
    let uses = &model.plan().process(number).uses;
    let is_position = |group: usize, field: usize| model.groups()[group].schema().position == Some(field);
    model.processes()[number].kind == ProcessKind::Migration
        || uses.iter().any(|one| one.written && is_position(one.substate.group, one.substate.field))
}

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
