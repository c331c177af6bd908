//! Elementary processes as a model holds them.

use crate::ir;
use crate::kernel::{Access, RowKernel};
use std::any::TypeId;
use xca_values::Precision;
use xca_values::Schema;

/// The subject of a process.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ProcessKind {
    /// Each cell.
    Cells,
    /// Each item of a population.
    Items,
    /// Each item of a population, to decide its cell.
    Migration,
}

/// A struct of substates among the arguments of a process.
#[derive(Debug, Clone, Copy)]
pub struct Argument {
    /// The type of the struct.
    pub type_id: fn() -> TypeId,
    /// Its fields.
    pub schema: &'static Schema,
    /// The owner of the substates.
    pub holds: Holds,
}

/// The owner of the substates of an argument.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Holds {
    /// Substates of cells.
    Cells,
    /// Substates of the items of a population.
    Items,
}

/// The data of a process for engines. `#[elementary_process]` and `#[migration]` generate it.
#[derive(Debug, Clone, Copy)]
pub struct Process {
    /// The name of the function.
    pub name: &'static str,
    /// The module of the function.
    pub module: &'static str,
    /// The subject of the process.
    pub kind: ProcessKind,
    /// The interval of steps. With 10 the process runs in step 10, 20 and so on.
    pub every: u64,
    /// The structs of substates among its arguments. The first is that of its subject, and the only writable
    /// one.
    pub substates: &'static [Argument],
    /// The structs of parameters among its arguments.
    pub parameters: &'static [ParametersArgument],
    /// Whether it reads neighbours.
    pub local_interaction: bool,
    /// Whether it uses `opposite`.
    pub uses_opposite: bool,
    /// Whether its text uses random numbers or the step. A helper may use them too; only kernels report that.
    pub uses_step: bool,
    /// Its uses of substates. A substate may have two entries, one of them as the position of a search.
    pub access: &'static [Access],
    /// Its body as data.
    pub body: fn() -> ir::Function,
    /// The kernel for `f32`.
    pub row_f32: RowKernel,
    /// The kernel for `f64`.
    pub row_f64: RowKernel,
}

/// A struct of parameters among the arguments of a process.
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

    /// The struct of its subject.
    pub fn subject(&self) -> &'static Argument {
        &self.substates[0]
    }

    /// The population whose items it visits.
    pub fn population(&self) -> Option<&'static Argument> {
        self.substates.iter().find(|argument| argument.holds == Holds::Items)
    }

    /// Whether it runs in the step with this number, from 0.
    pub fn is_due(&self, step: u64) -> bool {
        (step % self.every) + 1 == self.every
    }
}

/// A function marked `#[elementary_process]` or `#[migration]`.
///
/// Its name is a value for a model, as in `.process(evolve)`. Variables of the same module cannot have that
/// name.
#[diagnostic::on_unimplemented(
    message = "this is no elementary process",
    label = "not marked as an elementary process",
    note = "write `#[elementary_process]` or `#[migration]` above the function, and name it here: `.process(evolve)`"
)]
pub trait ElementaryProcess: 'static {
    /// The data of the process for engines.
    fn process() -> Process;
}

/// One process, or a tuple of processes in order: `relax`, `(flow, balance, cool)`.
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
