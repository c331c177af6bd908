//! Statements of a function.

use super::{BinaryOperator, Expression, Type};

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
