//! The body of an elementary process as data.
//!
//! `#[elementary_process]`, `#[migration]` and `#[helper]` keep the parsed body of the function beside the
//! native kernel. An engine that cannot call Rust (a GPU) generates its program from the body. Types are
//! those in the source. The reader repeats the type inference of Rust from the schemas of the substates and
//! parameters.
//!
//! This module is for engines and for code that the macros write. Models do not need it.

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

/// A type in the source.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Type {
    /// `bool`
    Bool,
    /// A number.
    Scalar(ScalarType),
    /// `Vector2`, `Vector3` or `Vector4` of a scalar, and the number of lanes.
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

/// Statements, and the value of the last expression if the block has one.
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
    /// `let name: type_ = value;` A later `let` with the same name shadows the earlier one, as in Rust.
    Let {
        /// The variable.
        name: &'static str,
        /// Whether it is `mut`.
        mutable: bool,
        /// The type, if it is written.
        type_: Option<Type>,
        /// The first value.
        value: Expression,
    },
    /// `let (a, b) = value;`
    LetTuple {
        /// The variables.
        parts: Vec<TuplePart>,
        /// The type, if it is written.
        type_: Option<Type>,
        /// The tuple.
        value: Expression,
    },
    /// `let name = cell.neighbour(index);`
    LetNeighbour {
        /// The variable for the neighbour.
        name: &'static str,
        /// The index of the neighbour, `u32`.
        index: Expression,
    },
    /// `place = value`, `place += value` and the like.
    Assign {
        /// The target of the assignment.
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

/// A variable for a part of a tuple.
#[derive(Debug, Clone)]
pub struct TuplePart {
    /// Its name. `None` for `_`.
    pub name: Option<&'static str>,
    /// Whether it is `mut`.
    pub mutable: bool,
}

/// A loop.
#[derive(Debug, Clone)]
pub struct Loop {
    /// Its label, without the apostrophe. No enclosing loop has the same label.
    pub label: Option<&'static str>,
    /// The kind of loop.
    pub kind: LoopKind,
    /// The body.
    pub body: Block,
}

/// The kind of a loop.
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
    /// `for variable in me.others…()`: over other items, sorted by neighbour index, then label.
    Others {
        /// The variable for the other item.
        variable: &'static str,
        /// The cells to search.
        reach: Reach,
        /// With a radius, only items at a smaller distance.
        radius: Option<Expression>,
    },
    /// `for variable in slots` in a process over cells: the items of the central cell, by label.
    Items {
        /// The variable for the item.
        variable: &'static str,
    },
}

/// `from..to`, or `from..=to` if `inclusive`.
#[derive(Debug, Clone)]
pub struct Range {
    /// The first value.
    pub from: Expression,
    /// The end.
    pub to: Expression,
    /// Whether the range includes the end.
    pub inclusive: bool,
    /// `.rev()`: from the end to the first value.
    pub reversed: bool,
    /// `.step_by(step)`, applied after `reversed`. A `usize`, at least 1.
    pub step: Option<Expression>,
}

/// The cells in which a search for other items looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reach {
    /// The item's own cell.
    Cell,
    /// The neighbours, without the own cell.
    Neighbours,
    /// The own cell, then the neighbours.
    All,
}

/// The target of an assignment: a variable or an own substate, then components and elements of it.
#[derive(Debug, Clone)]
pub struct Place {
    /// The root of the path.
    pub root: PlaceRoot,
    /// The path from there, outermost first.
    pub path: Vec<Projection>,
}

/// The root of a place.
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
