//! How a process stops a run, and what stopped it.

use crate::program::Program;
use xca_core::ProcessKind;
use xca_core::engine::Fault;

/// How a process stopped a run; the number is what the device notes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Cause {
    /// It reported a fault, or Rust would have stopped it.
    Reported = 0,
    /// A migration sent an item where it cannot go.
    Aimed = 1,
    /// A migration sent more items into a cell than it has slots.
    Full = 2,
}

impl Cause {
    /// How this process may stop a run.
    pub(crate) fn of(program: &Program) -> Vec<Self> {
        let mut causes = Vec::new();
        if program.may_fault() {
            causes.push(Self::Reported);
        }
        if program.process.kind == ProcessKind::Migration {
            causes.extend([Self::Aimed, Self::Full]);
        }
        causes
    }
}

/// What stopped a run.
pub(crate) struct Stop {
    pub(crate) step: u64,
    /// The index of the process in the model.
    pub(crate) process: usize,
    /// The linear index of the cell, or the number of the item.
    pub(crate) at: u32,
    pub(crate) fault: Fault,
}
