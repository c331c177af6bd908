//! Loops over the others in the cell that do something for some of these only, which a condition on the other
//! tells.

use super::body::Writer;
use super::company::{compares, is_same_for_all};
use crate::ast::{Block, Expression, Statement};
use proc_macro2::{Ident, TokenStream};
use quote::quote;
use syn::{BinOp, UnOp};

/// Marks of the items that have such others in their cell.
pub(super) struct Mates {
    pub(super) marks: Ident,
    /// Makes the marks.
    pub(super) prepare: TokenStream,
}

impl Mates {
    /// The condition without which a turn of a loop does nothing, if computing it cannot panic and it depends
    /// on the other alone.
    pub(super) fn condition(variable: &Ident, body: &Block, writer: &mut Writer<'_>) -> Option<TokenStream> {
        let Block { statements, value } = body;
        let only = match (&**statements, value.as_deref()) {
            ([], Some(only)) | ([Statement::Expression(only)], None) => Some(only),
            _ => None,
        };
        if let Some(Expression::If { condition, otherwise: None, .. }) = only {
            let condition = necessary(condition, variable)?;
            return Some(writer.expression(condition));
        }
        let Some(Statement::Expression(Expression::If { condition, then, otherwise: None, .. })) =
            statements.first()
        else {
            return None;
        };
        let Block { statements, value: None } = then else { return None };
        let skips = matches!(&**statements, [Statement::Continue(None, _)]);
        (skips && is_of_other(condition, variable)).then(|| {
            let condition = writer.expression(condition);
            quote!(!(#condition))
        })
    }

    /// The marks of a loop.
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
