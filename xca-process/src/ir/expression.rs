//! Expressions of a function.

use super::{BinaryOperator, Block, Builtin, Constant, Function, Type, UnaryOperator};
use xca_methods::Operation;
use xca_values::ScalarType;

/// An expression.
#[derive(Debug, Clone)]
pub enum Expression {
    /// A literal.
    Literal(Literal),
    /// A variable or a value argument.
    Local(&'static str),
    /// A constant of the surrounding Rust code.
    Constant {
        /// Its path in the source, for a reader.
        name: &'static str,
        /// Its value.
        value: Constant,
    },
    /// A substate of the cell or item that the process runs for, including what the process has already
    /// written.
    Own(&'static str),
    /// A substate of another struct of the cell (`&Cell<S>`). The cell is that of the process, or that of its
    /// item.
    OfCell {
        /// The index of the struct among the process's structs of substates.
        argument: usize,
        /// The substate.
        field: &'static str,
    },
    /// `cell.neighbour(index).field`
    Neighbour {
        /// The index of the struct. 0 is that of the cell that the process runs for.
        argument: usize,
        /// The index of the neighbour, `u32`.
        index: Box<Expression>,
        /// The substate.
        field: &'static str,
    },
    /// `name.field` where `name` was bound by [`super::Statement::LetNeighbour`].
    NamedNeighbour {
        /// The number of the struct.
        argument: usize,
        /// The variable.
        name: &'static str,
        /// The substate.
        field: &'static str,
    },
    /// `name.field` where `name` is the variable of [`super::LoopKind::Others`] or
    /// [`super::LoopKind::Items`].
    Other {
        /// The number of the struct.
        argument: usize,
        /// The variable.
        name: &'static str,
        /// The substate.
        field: &'static str,
    },
    /// `name.label()` of such a variable, `u32`.
    OtherLabel(&'static str),
    /// `parameters.field`
    Parameter {
        /// The name of the argument of the function.
        argument: &'static str,
        /// The field.
        field: &'static str,
    },
    /// An argument of parameters as a whole, passed on to a helper.
    Parameters(&'static str),
    /// The space as a whole, passed on to a helper.
    Space,
    /// A function or value that the engine provides.
    Builtin(Builtin, Vec<Expression>),
    /// `-a`, `!a`
    Unary(UnaryOperator, Box<Expression>),
    /// `a + b` and the like.
    Binary(BinaryOperator, Box<Expression>, Box<Expression>),
    /// `value as type`
    Cast(Box<Expression>, Type),
    /// A call of a helper.
    Call {
        /// Returns the helper.
        function: fn() -> Function,
        /// The arguments.
        arguments: Vec<Expression>,
    },
    /// A method of a number, vector or array that is an operation. Other methods are calls of helpers.
    Method {
        /// The operation.
        method: Operation,
        /// The receiver.
        receiver: Box<Expression>,
        /// The other arguments.
        arguments: Vec<Expression>,
    },
    /// `.x`, `.y`, `.z`, `.w`: 0 to 3.
    Component(Box<Expression>, u8),
    /// `array[index]`
    Element(Box<Expression>, Box<Expression>),
    /// `[a, b, c]`
    Array(Vec<Expression>),
    /// `(a, b, …)`, two or more.
    Tuple(Vec<Expression>),
    /// `[value; length]`
    Repeat(Box<Expression>, usize),
    /// `Vector3::new(a, b, c)`: as many components as lanes.
    Vector(Vec<Expression>),
    /// `Vector3::splat(a)`, and the number of lanes.
    Splat(Box<Expression>, u8),
    /// `if condition { then } else { otherwise }`
    If {
        /// The condition.
        condition: Box<Expression>,
        /// The first branch.
        then: Block,
        /// The second branch.
        otherwise: Option<Block>,
    },
    /// `match value { … }` over integers.
    Match {
        /// The value to compare.
        value: Box<Expression>,
        /// The arms in order.
        arms: Vec<Arm>,
    },
    /// `{ … }`
    Block(Block),
}

/// An arm of a match.
#[derive(Debug, Clone)]
pub struct Arm {
    /// The patterns, any of which selects the arm.
    pub patterns: Vec<Pattern>,
    /// `if` guard.
    pub guard: Option<Expression>,
    /// The value or statements.
    pub body: Block,
}

/// A pattern of a match arm.
#[derive(Debug, Clone)]
pub enum Pattern {
    /// `_`
    Any,
    /// A literal or constant.
    Value(Expression),
    /// `a..=b`
    Range(Expression, Expression),
}

/// A literal as written.
#[derive(Debug, Clone)]
pub enum Literal {
    /// `true`, `false`
    Bool(bool),
    /// An integer, with its suffix if there is one.
    Integer(u64, Option<ScalarType>),
    /// A decimal fraction: the digits as written without underscores, and the suffix.
    Float(&'static str, Option<ScalarType>),
}
