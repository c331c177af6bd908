//! Expressions that cannot panic.

use crate::ast::Expression;
use syn::BinOp;

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
