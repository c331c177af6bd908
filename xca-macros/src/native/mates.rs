//! Loops over the others in the cell that do something for some of these only, which a condition on the other
//! tells.

use super::plain::{compares, is_same_for_all};
use crate::ast::{Block, Expression, Statement};
use proc_macro2::{Ident, TokenStream};
use quote::quote;
use syn::{BinOp, UnOp};

/// A condition on the other without which a turn of a loop does nothing. Computing it cannot panic, and it
/// depends on the other alone.
pub(super) struct Condition<'a> {
    pub(super) expression: &'a Expression,
    /// The value that is wanted.
    pub(super) value: bool,
}

/// Marks of the items that have wanted others in their cell.
pub(super) struct Mates {
    pub(super) marks: Ident,
    /// Makes the marks.
    pub(super) prepare: TokenStream,
}

impl<'a> Condition<'a> {
    /// The condition of a loop: that of an `if` which is all that the body has, or of an `if` that begins the
    /// body and skips the turn.
    pub(super) fn of(variable: &Ident, body: &'a Block) -> Option<Self> {
        let Block { statements, value } = body;
        let only = match (&**statements, value.as_deref()) {
            ([], Some(only)) | ([Statement::Expression(only)], None) => Some(only),
            _ => None,
        };
        if let Some(Expression::If { condition, otherwise: None, .. }) = only {
            return Some(Self { expression: necessary(condition, variable)?, value: true });
        }
        let expression = skip_condition(statements.first()?)?;
        is_of_other(expression, variable).then_some(Self { expression, value: false })
    }
}

/// The condition of an `if` that skips the turn of a loop.
pub(super) fn skip_condition(statement: &Statement) -> Option<&Expression> {
    let Statement::Expression(Expression::If { condition, then, otherwise: None, .. }) = statement else {
        return None;
    };
    let Block { statements, value: None } = then else { return None };
    matches!(&**statements, [Statement::Continue(None, _)]).then_some(condition)
}

impl Mates {
    /// The marks of a loop with this condition.
    pub(super) fn new(marks: Ident, variable: &Ident, condition: &TokenStream, row: &Ident) -> Self {
        let prepare = quote! {
            let mut #marks = #row.found();
            #row.mates(|#variable: usize| #condition, &mut #marks.items);
        };
        Self { marks, prepare }
    }
}

/// The part of a condition that is computed first and depends on the other alone.
fn necessary<'a>(condition: &'a Expression, other: &Ident) -> Option<&'a Expression> {
    match condition {
        _ if is_of_other(condition, other) => Some(condition),
        Expression::Binary(BinOp::And(_), left, _) => necessary(left, other),
        _ => None,
    }
}

/// Whether a condition depends on the other alone, and computing it cannot panic.
fn is_of_other(condition: &Expression, other: &Ident) -> bool {
    match condition {
        Expression::Other { name, .. } => name == other,
        Expression::Unary(UnOp::Not(_), value) | Expression::Component(value, _) => is_of_other(value, other),
        Expression::Binary(operator, left, right) => {
            compares(operator) && is_of_other(left, other) && is_of_other(right, other)
        }
        same => is_same_for_all(same),
    }
}
