//! Functions: processes, migrations and helpers.

use super::{Block, Type};
use xca_values::Schema;

/// A parsed function.
#[derive(Debug, Clone)]
pub struct Function {
    /// The function's name in the source.
    pub name: &'static str,
    /// The module of the function, `module_path!()`.
    pub module: &'static str,
    /// The kind of the function.
    pub kind: FunctionKind,
    /// The arguments in order.
    pub arguments: Vec<Argument>,
    /// The type of the result, if there is one.
    pub result: Option<Type>,
    /// The statements.
    pub body: Block,
}

/// The kind of a function.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FunctionKind {
    /// An elementary process, run once for each cell.
    Cells,
    /// An elementary process, run once for each item of a population.
    Items,
    /// A migration: returns the cell of an item.
    Migration,
    /// A function called by the others.
    Helper,
}

/// An argument of a function.
#[derive(Debug, Clone)]
pub struct Argument {
    /// Its name in the source.
    pub name: &'static str,
    /// Its role.
    pub role: Role,
}

/// The role of an argument.
#[derive(Debug, Clone)]
pub enum Role {
    /// The central cell. Either the struct that the process writes (`&mut Cell<S>`), or another struct of the
    /// cell (`&Cell<S>`). In a process over items, the cell of the item.
    Cell(&'static Schema),
    /// The item of a population (`&mut Slot<S>`, `&Slot<S>`).
    Slot(&'static Schema),
    /// All items of the central cell (`&Slots<S>`), for a process over cells.
    Slots(&'static Schema),
    /// The parameters (`&P`).
    Parameters(&'static Schema),
    /// The cellular space (`&Space`).
    Space,
    /// A value, for helpers.
    Value(Type),
}
