//! Processes in which an item without others nearby does nothing.

use super::body::Writer;
use super::mates::Condition;
use super::plain::{compares, is_same_for_all};
use crate::ast::{Block, Expression, Function, FunctionKind, LoopKind, Reach, Statement};
use proc_macro2::TokenStream;
use syn::UnOp;

/// The others without which an item does nothing.
pub(super) struct Company {
    /// Whether any in its cell count. If not, those that a [`Condition`] wants do.
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
                    in_cell |= Condition::of(variable, &turns.body).is_none();
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
