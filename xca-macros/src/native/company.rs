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
    /// Others that are near, if these count too.
    pub(super) within: Option<Within>,
}

/// The others within a radius.
pub(super) struct Within {
    pub(super) radius: TokenStream,
    /// The cells in which they count.
    pub(super) reach: Reach,
}

impl Company {
    /// `None` if an item may do something alone, or if the radius may differ between items.
    pub(super) fn of(
        function: &Function,
        statements: &[&Statement],
        writer: &mut Writer<'_>,
    ) -> Option<Self> {
        if function.kind != FunctionKind::Items || function.body.value.is_some() {
            return None;
        }
        let (mut in_cell, mut mates) = (false, false);
        let mut within: Option<Within> = None;
        for statement in statements {
            let Statement::Loop(turns) = statement else {
                if return_condition(statement).is_some() {
                    continue;
                }
                return None;
            };
            match &turns.kind {
                LoopKind::Others { variable, reach: Reach::Cell, radius: None } => {
                    let is_conditional = Condition::of(variable, &turns.body).is_some();
                    in_cell |= !is_conditional;
                    mates |= is_conditional;
                }
                LoopKind::Others { reach, radius: Some(radius), .. } if is_same_for_all(radius) => {
                    let radius = writer.expression(radius);
                    let known = within.get_or_insert(Within { radius: radius.clone(), reach: *reach });
                    if known.radius.to_string() != radius.to_string() {
                        return None;
                    }
                    known.reach = if known.reach == *reach { *reach } else { Reach::All };
                }
                _ => return None,
            }
        }
        (within.is_some() || (mates && !in_cell)).then_some(Self { in_cell, within })
    }
}

/// The condition of `if condition { return; }`, if it cannot panic.
pub(super) fn return_condition(statement: &Statement) -> Option<&Expression> {
    let Statement::Expression(Expression::If { condition, then, otherwise: None, .. }) = statement else {
        return None;
    };
    let Block { statements, value: None } = then else { return None };
    (matches!(&**statements, [Statement::Return(None, _)]) && is_plain(condition)).then_some(condition)
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
