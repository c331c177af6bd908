//! The body of an elementary process as data.
//!
//! `#[elementary_process]`, `#[migration]` and `#[helper]` keep, beside the native kernel, the parsed body of
//! the function. An engine that cannot call Rust (a GPU) writes its own program from it. Types are those the
//! user wrote; whatever Rust infers is inferred again by the reader of the data, from the schemas of the
//! substates and parameters.
//!
//! This module is for engines and for code that the macros write; models do not need it.

mod expression;

pub use crate::ir_constant::ConstantValue;
pub use expression::{Arm, BinaryOperator, Builtin, Constant, Expression, Literal, Pattern, UnaryOperator};
pub use xca_methods::Operation;
use xca_values::ScalarType;
use xca_values::Schema;
use xca_values::StateNames;

/// A parsed function.
#[derive(Debug, Clone)]
pub struct Function {
    /// The function's name in the source.
    pub name: &'static str,
    /// The module that it stands in, `module_path!()`.
    pub module: &'static str,
    /// What the function is for.
    pub kind: FunctionKind,
    /// The arguments in order.
    pub arguments: Vec<Argument>,
    /// The type of the result, if there is one.
    pub result: Option<Type>,
    /// The statements.
    pub body: Block,
}

/// What a function is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FunctionKind {
    /// An elementary process, run once for each cell.
    Cells,
    /// An elementary process, run once for each item of a population.
    Items,
    /// Says to which cell an item belongs.
    Migration,
    /// A function called by the others.
    Helper,
}

/// An argument of a function.
#[derive(Debug, Clone)]
pub struct Argument {
    /// Its name in the source.
    pub name: &'static str,
    /// What it stands for.
    pub role: Role,
}

/// What an argument stands for.
#[derive(Debug, Clone)]
pub enum Role {
    /// The central cell: the struct that the process writes (`&mut Cell<S>`), and others of the cell
    /// (`&Cell<S>`); in a process over items the cell that the item stands in.
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

/// A type that the user wrote.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Type {
    /// `bool`
    Bool,
    /// A number.
    Scalar(ScalarType),
    /// `Vector2`, `Vector3` or `Vector4` of a scalar; the second is the number of lanes.
    Vector(ScalarType, u8),
    /// An enum that derives `States`.
    State(&'static StateNames),
    /// `[T; N]`
    Array(Box<Type>, usize),
    /// `(A, B, …)`
    Tuple(Vec<Type>),
    /// `Destination`, the result of a migration.
    Destination,
}

/// Statements, and the value of the last expression where the block has one.
#[derive(Debug, Clone)]
pub struct Block {
    /// The statements in order.
    pub statements: Vec<Statement>,
    /// The value of the block.
    pub value: Option<Box<Expression>>,
}

/// A statement.
#[derive(Debug, Clone)]
pub enum Statement {
    /// `let name: type_ = value;` A later `let` of the same name hides the earlier one, as in Rust.
    Let {
        /// The variable.
        name: &'static str,
        /// Whether it is `mut`.
        mutable: bool,
        /// The type, where it is written.
        type_: Option<Type>,
        /// The first value.
        value: Expression,
    },
    /// `let (a, b) = value;`
    LetTuple {
        /// The variables.
        parts: Vec<TuplePart>,
        /// The type, where it is written.
        type_: Option<Type>,
        /// The tuple.
        value: Expression,
    },
    /// `let name = cell.neighbour(index);`
    LetNeighbour {
        /// The variable that stands for the neighbour.
        name: &'static str,
        /// The index of the neighbour, `u32`.
        index: Expression,
    },
    /// `place = value`, `place += value` and the like.
    Assign {
        /// What is written.
        place: Place,
        /// The operator of a compound assignment.
        operator: Option<BinaryOperator>,
        /// The right-hand side.
        value: Expression,
    },
    /// An expression for its effects: `if`, `match`, a block, a call.
    Expression(Expression),
    /// `while`, `loop` and `for`.
    Loop(Loop),
    /// `break;` or `break 'label;`
    Break(Option<&'static str>),
    /// `continue;` or `continue 'label;`
    Continue(Option<&'static str>),
    /// `return;` or `return value;`
    Return(Option<Expression>),
    /// `cell.fault(code, value);`
    Fault {
        /// The code, `u32`.
        code: Expression,
        /// A value to report, `Real`.
        value: Expression,
    },
}

/// A variable that takes a part of a tuple.
#[derive(Debug, Clone)]
pub struct TuplePart {
    /// Its name, nothing where it is `_`.
    pub name: Option<&'static str>,
    /// Whether it is `mut`.
    pub mutable: bool,
}

/// A loop.
#[derive(Debug, Clone)]
pub struct Loop {
    /// Its label, without the apostrophe. No loop around it has the same.
    pub label: Option<&'static str>,
    /// What it runs over.
    pub kind: LoopKind,
    /// The body.
    pub body: Block,
}

/// What a loop runs over.
#[derive(Debug, Clone)]
pub enum LoopKind {
    /// `while condition`
    While(Expression),
    /// `loop`
    Forever,
    /// `for variable in range`
    Range {
        /// The variable.
        variable: &'static str,
        /// The range.
        range: Range,
    },
    /// `for variable in array`
    Elements {
        /// The variable, a copy of the element.
        variable: &'static str,
        /// The array.
        array: Expression,
    },
    /// `for variable in me.others…()`: over other items, in the order neighbour index, then label.
    Others {
        /// The variable that stands for the other item.
        variable: &'static str,
        /// Where the items are looked for.
        reach: Reach,
        /// With a radius, only items whose position is nearer than this (strictly).
        radius: Option<Expression>,
    },
    /// `for variable in slots` in a process over cells: the items of the central cell, by label.
    Items {
        /// The variable that stands for the item.
        variable: &'static str,
    },
}

/// `from..to`, and with `..=` where `inclusive`.
#[derive(Debug, Clone)]
pub struct Range {
    /// The first value.
    pub from: Expression,
    /// The end.
    pub to: Expression,
    /// Whether the end belongs to the range.
    pub inclusive: bool,
    /// `.rev()`: from the end to the first value.
    pub reversed: bool,
    /// `.step_by(step)`, of what `reversed` gives: every so many values, `usize`, at least 1.
    pub step: Option<Expression>,
}

/// Where a search for other items looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reach {
    /// The item's own cell.
    Cell,
    /// The neighbours, without the own cell.
    Neighbours,
    /// The own cell, then the neighbours.
    All,
}

/// Something that can be assigned to: a variable or an own substate, then components and elements of it.
#[derive(Debug, Clone)]
pub struct Place {
    /// Where it starts.
    pub root: PlaceRoot,
    /// The path from there, outermost first.
    pub path: Vec<Projection>,
}

/// Where a place starts.
#[derive(Debug, Clone)]
pub enum PlaceRoot {
    /// A variable.
    Local(&'static str),
    /// A substate of the cell or item that the process runs for.
    Own(&'static str),
}

/// One step into a value.
#[derive(Debug, Clone)]
pub enum Projection {
    /// `.x`, `.y`, `.z`, `.w`: 0 to 3.
    Component(u8),
    /// `[index]`
    Element(Expression),
}
