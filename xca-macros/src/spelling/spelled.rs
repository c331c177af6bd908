//! A function as far as it is spelled out.

use proc_macro2::Span;
use quote::format_ident;
use syn::{Error, Expr, Ident, ItemFn};

/// A function without iterators and names in patterns.
pub(crate) struct Spelled {
    pub(crate) function: ItemFn,
    /// Names that may be references in Rust, and are values here.
    pub(crate) references: Vec<Ident>,
    pub(crate) errors: Vec<Error>,
    pub(super) in_closure: bool,
}

/// Without parentheses and invisible groups.
pub(crate) fn strip(expression: &Expr) -> &Expr {
    match expression {
        Expr::Paren(paren) => strip(&paren.expr),
        Expr::Group(group) => strip(&group.expr),
        other => other,
    }
}

/// Whether the word is written as constants are.
pub(crate) fn is_constant(name: &Ident) -> bool {
    name.to_string().trim_start_matches('_').starts_with(char::is_uppercase)
}

/// A name that no name of the user can meet.
pub(super) fn hidden(name: &str) -> Ident {
    format_ident!("__xca_{name}", span = Span::mixed_site())
}
