//! Processes in which an item without others nearby does nothing.

use super::body::Writer;
use super::mates::Mates;
use crate::ast::{Block, Expression, Function, FunctionKind, LoopKind, Reach, Statement};
use proc_macro2::TokenStream;
use syn::{BinOp, UnOp};

/// The others without which an item does nothing.
pub(super) struct Company {
    /// Whether any in its cell count. If not, those with [`Mates`] do.
    pub(super) in_cell: bool,
    pub(super) radius: TokenStream,
    /// The cells in which those within the radius count.
    pub(super) reach: Reach,
}

impl Company {
    /// `None` if an item may do something alone, or if the radius may differ between items.
    pub(super) fn of(function: &Function, writer: &mut Writer<'_>) -> Option<Self> {
        if function.kind != FunctionKind::Items || function.body.value.is_some() {
            return None;
        }
        let mut in_cell = false;
        let mut within: Option<(TokenStream, Reach)> = None;
        for statement in &function.body.statements {
            let Statement::Loop(turns) = statement else {
                if is_plain_return(statement) {
                    continue;
                }
                return None;
            };
            match &turns.kind {
                LoopKind::Others { variable, reach: Reach::Cell, radius: None } => {
                    in_cell |= Mates::condition(variable, &turns.body, writer).is_none();
                }
                LoopKind::Others { reach, radius: Some(radius), .. } if is_same_for_all(radius) => {
                    let radius = writer.expression(radius);
                    let known = within.get_or_insert((radius.clone(), *reach));
                    if known.0.to_string() != radius.to_string() {
                        return None;
                    }
                    known.1 = if known.1 == *reach { *reach } else { Reach::All };
                }
                _ => return None,
            }
        }
        within.map(|(radius, reach)| Self { in_cell, radius, reach })
    }
}

/// Whether this is `if condition { return; }`, with a condition that cannot panic.
fn is_plain_return(statement: &Statement) -> bool {
    let Statement::Expression(Expression::If { condition, then, otherwise: None, .. }) = statement else {
        return false;
    };
    let Block { statements, value: None } = then else { return false };
    matches!(&**statements, [Statement::Return(None, _)]) && is_plain(condition)
}

/// Whether computing a condition cannot panic, and changes nothing.
fn is_plain(condition: &Expression) -> bool {
    match condition {
        Expression::Own(_) => true,
        Expression::Unary(UnOp::Not(_), value) | Expression::Component(value, _) => is_plain(value),
        Expression::Binary(operator, left, right) => compares(operator) && is_plain(left) && is_plain(right),
        other => is_same_for_all(other),
    }
}

/// Whether a number is the same for all items, and computing it cannot panic.
pub(super) fn is_same_for_all(number: &Expression) -> bool {
    match number {
        Expression::Bool(_)
        | Expression::Integer(_)
        | Expression::Float(_)
        | Expression::Constant(_)
        | Expression::Parameter { .. } => true,
        // Of floating-point numbers: the product of integers may overflow.
        Expression::Binary(BinOp::Mul(_), left, right) => {
            let floats = [left, right].iter().any(|factor| matches!(***factor, Expression::Float(_)));
            floats && is_same_for_all(left) && is_same_for_all(right)
        }
        _ => false,
    }
}

pub(super) fn compares(operator: &BinOp) -> bool {
    use BinOp::{And, Eq, Ge, Gt, Le, Lt, Ne, Or};
    matches!(operator, And(_) | Or(_) | Eq(_) | Ne(_) | Lt(_) | Le(_) | Gt(_) | Ge(_))
}
