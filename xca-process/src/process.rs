//! Elementary processes as a model holds them.

use crate::ir;
use crate::kernel::{Access, RowKernel};
use std::any::TypeId;
use xca_values::Precision;
use xca_values::Schema;

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

/// A struct that a process takes.
#[derive(Debug, Clone, Copy)]
pub struct Argument {
    /// The type of the struct.
    pub type_id: fn() -> TypeId,
    /// Its fields.
    pub schema: &'static Schema,
    /// What it holds.
    pub holds: Holds,
}

/// What a struct that a process takes holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Holds {
    /// Substates of cells.
    Cells,
    /// Substates of the items of a population.
    Items,
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
    /// In which steps it is run: in every one, or in every so many, the first time as the last of so many.
    pub every: u64,
    /// The structs of substates that it takes: first that of what it is run for, which alone it can write.
    pub substates: &'static [Argument],
    /// The structs of parameters that it takes, with their types.
    pub parameters: &'static [ParametersArgument],
    /// Whether it looks at neighbours.
    pub local_interaction: bool,
    /// Whether it asks for the opposite of a neighbour.
    pub uses_opposite: bool,
    /// Whether its text asks for random numbers or for the number of the step; a helper may do so too, which
    /// only a kernel notes.
    pub uses_step: bool,
    /// How it uses each substate; a substate may stand in two accesses, one of which is the position for a
    /// search.
    pub access: &'static [Access],
    /// Its body as data.
    pub body: fn() -> ir::Function,
    /// The kernel for `f32`.
    pub row_f32: RowKernel,
    /// The kernel for `f64`.
    pub row_f64: RowKernel,
}

/// A struct of parameters that a process takes.
#[derive(Debug, Clone, Copy)]
pub struct ParametersArgument {
    /// The type of the struct.
    pub type_id: fn() -> TypeId,
    /// Its fields.
    pub schema: &'static Schema,
}

impl Process {
    /// The kernel for a precision.
    pub fn kernel(&self, precision: Precision) -> RowKernel {
        match precision {
            Precision::F32 => self.row_f32,
            Precision::F64 => self.row_f64,
        }
    }

    /// The struct of what it is run for.
    pub fn subject(&self) -> &'static Argument {
        &self.substates[0]
    }

    /// The population whose items it runs for or goes through.
    pub fn population(&self) -> Option<&'static Argument> {
        self.substates.iter().find(|argument| argument.holds == Holds::Items)
    }

    /// Whether it is run in the step with this number, from 0.
    pub fn is_due(&self, step: u64) -> bool {
        (step % self.every) + 1 == self.every
    }
}

/// A function marked `#[elementary_process]` or `#[migration]`.
///
/// Its name is a value that a model takes, as in `.process(evolve)`, and therefore not free for variables in
/// the same module.
#[diagnostic::on_unimplemented(
    message = "this is no elementary process",
    label = "not marked as an elementary process",
    note = "write `#[elementary_process]` or `#[migration]` above the function, and name it here: `.process(evolve)`"
)]
pub trait ElementaryProcess: 'static {
    /// What an engine knows about it.
    fn process() -> Process;
}

/// One process, or several in parentheses that run one after the other: `relax`, `(flow, balance, cool)`.
#[diagnostic::on_unimplemented(
    message = "this is no elementary process",
    label = "not marked as an elementary process",
    note = "write `#[elementary_process]` or `#[migration]` above the function, and name it here: `.process(evolve)`"
)]
pub trait Processes {
    /// Adds them in order.
    fn add_to(processes: &mut Vec<Process>);
}

impl<P: ElementaryProcess> Processes for P {
    fn add_to(processes: &mut Vec<Process>) {
        processes.push(P::process());
    }
}

macro_rules! several {
    ($($process:ident)+) => {
        #[diagnostic::do_not_recommend]
        impl<$($process: Processes),+> Processes for ($($process,)+) {
            fn add_to(processes: &mut Vec<Process>) {
                $($process::add_to(processes);)+
            }
        }
    };
}

several!(A);
several!(A B);
several!(A B C);
several!(A B C D);
several!(A B C D E);
several!(A B C D E F);
several!(A B C D E F G);
several!(A B C D E F G H);
