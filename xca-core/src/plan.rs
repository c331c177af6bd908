//! The plan of a model: the substates that each process reads and writes, and its population. For engines;
//! models do not need it.
//!
//! The reference engine does not use the plan, so that comparisons with it find errors in the plan.

use crate::engine::SubstateId;
use crate::model::Group;
use std::any::TypeId;
use xca_process::{Argument, Process};

/// The plan of a model, derived from its processes.
#[derive(Debug, Clone, Default)]
pub struct Plan {
    processes: Vec<ProcessPlan>,
}

/// The plan of one process.
#[derive(Debug, Clone)]
pub struct ProcessPlan {
    /// The substate of each access, in the order of the process.
    pub accesses: Vec<SubstateId>,
    /// The substates in use, each once.
    pub uses: Vec<SubstateUse>,
    /// The group of the population whose items it visits.
    pub population: Option<usize>,
}

/// The use of a substate by a process.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SubstateUse {
    /// The substate.
    pub substate: SubstateId,
    /// Whether the process reads it, anywhere.
    pub read: bool,
    /// Whether the process reads it at neighbours or of other items.
    pub elsewhere: bool,
    /// Whether the process writes it.
    pub written: bool,
}

impl SubstateUse {
    /// Whether results must not replace what others still read, so that they go to a second buffer.
    pub fn is_doubled(&self) -> bool {
        self.elsewhere && self.written
    }
}

impl Plan {
    pub(crate) fn new(processes: &[Process], groups: &[Group]) -> Self {
        Self { processes: processes.iter().map(|process| ProcessPlan::new(process, groups)).collect() }
    }

    /// The plan of the process with this number.
    pub fn process(&self, number: usize) -> &ProcessPlan {
        &self.processes[number]
    }

    /// Whether a process reads the substate elsewhere and writes it.
    pub fn is_doubled(&self, substate: SubstateId) -> bool {
        self.uses(substate).any(SubstateUse::is_doubled)
    }

    /// Whether a process reads the substate elsewhere.
    pub fn is_read_elsewhere(&self, substate: SubstateId) -> bool {
        self.uses(substate).any(|found| found.elsewhere)
    }

    fn uses(&self, substate: SubstateId) -> impl Iterator<Item = &SubstateUse> {
        self.processes.iter().filter_map(move |process| process.use_of(substate))
    }
}

impl ProcessPlan {
    fn new(process: &Process, groups: &[Group]) -> Self {
        let group = |argument: &Argument| number_of(groups, (argument.type_id)()).unwrap_or_default();
        let accesses: Vec<SubstateId> = process
            .access
            .iter()
            .map(|access| SubstateId {
                group: group(&process.substates[access.argument]),
                field: access.field,
            })
            .collect();
        let mut uses: Vec<SubstateUse> = Vec::new();
        for (access, &substate) in process.access.iter().zip(&accesses) {
            match uses.iter_mut().find(|known| known.substate == substate) {
                Some(known) => {
                    known.read |= access.centre || access.others;
                    known.elsewhere |= access.others;
                    known.written |= access.write;
                }
                None => {
                    uses.push(SubstateUse {
                        substate,
                        read: access.centre || access.others,
                        elsewhere: access.others,
                        written: access.write,
                    });
                }
            }
        }
        Self { accesses, uses, population: process.population().map(group) }
    }

    /// How the process uses a substate, if it does.
    pub fn use_of(&self, substate: SubstateId) -> Option<&SubstateUse> {
        self.uses.iter().find(|known| known.substate == substate)
    }
}

fn number_of(groups: &[Group], type_id: TypeId) -> Option<usize> {
    groups.iter().position(|group| group.type_id() == type_id)
}
