//! Elementary processes as a model holds them.

use crate::ir;
use crate::kernel::{Access, Group, Of, RowKernel};
use crate::value::Precision;

/// What a process is run for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ProcessKind {
    /// Each cell.
    Cells,
    /// Each item of a population.
    Items,
    /// Each item of a population, to say to which cell it belongs.
    Migration,
}

/// Everything that an engine knows about a process; written by `#[elementary_process]` and `#[migration]`.
#[derive(Debug, Clone, Copy)]
pub struct Process {
    /// The name of the function.
    pub name: &'static str,
    /// The module that the function stands in.
    pub module: &'static str,
    /// What it is run for.
    pub kind: ProcessKind,
    /// The substates of what it is run for.
    pub subject: Group,
    /// Of a process over items, the substates of their cell; of a process over cells, those of its items.
    pub companion: Option<Group>,
    /// The struct of the parameters that it takes.
    pub parameters: Option<Group>,
    /// Whether it looks at neighbours.
    pub local_interaction: bool,
    /// Whether it asks for the opposite of a neighbour.
    pub uses_opposite: bool,
    /// How it uses each substate; a substate may stand in two accesses, one of which is the position for a search.
    pub access: &'static [Access],
    /// Its body as data.
    pub body: fn() -> ir::Function,
    /// The kernel for `f32`.
    pub row_f32: RowKernel,
    /// The kernel for `f64`.
    pub row_f64: RowKernel,
}

impl Process {
    /// The kernel for a precision.
    pub fn kernel(&self, precision: Precision) -> RowKernel {
        match precision {
            Precision::F32 => self.row_f32,
            Precision::F64 => self.row_f64,
        }
    }

    /// The group of an access: the subject, or the companion where there is one.
    pub fn group(&self, of: Of) -> Group {
        match of {
            Of::Subject => self.subject,
            Of::Companion => self.companion.unwrap_or(self.subject),
        }
    }
}

/// A function marked `#[elementary_process]` or `#[migration]`.
///
/// Its name is a value that a model takes, as in `.process(evolve)`, and therefore not free for variables in the same module.
#[diagnostic::on_unimplemented(
    message = "this is no elementary process",
    label = "not marked as an elementary process",
    note = "write `#[elementary_process]` or `#[migration]` above the function, and name it here: `.process(evolve)`"
)]
pub trait ElementaryProcess: 'static {
    /// What an engine knows about it.
    fn process() -> Process;
}
