//! A function as far as it is spelled out.

use proc_macro2::Span;
use quote::format_ident;
use std::fmt;
use syn::{Error, Expr, Ident, ItemFn};

/// A function without iterators and names in patterns.
pub struct Spelled {
    /// The function.
    pub function: ItemFn,
    /// Names that may be references in Rust, and are values here.
    pub references: Vec<Ident>,
    /// What cannot be spelled out.
    pub errors: Vec<Error>,
    pub(crate) in_closure: bool,
}

impl fmt::Debug for Spelled {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Spelled").field("references", &self.references).finish_non_exhaustive()
    }
}

/// Without parentheses and invisible groups.
pub fn strip(expression: &Expr) -> &Expr {
    match expression {
        Expr::Paren(paren) => strip(&paren.expr),
        Expr::Group(group) => strip(&group.expr),
        other => other,
    }
}

/// Whether the word is written as constants are.
pub fn is_constant(name: &Ident) -> bool {
    name.to_string().trim_start_matches('_').starts_with(char::is_uppercase)
}

/// A name that no name of the user can meet.
pub(crate) fn hidden(name: &str) -> Ident {
    format_ident!("__xca_{name}", span = Span::mixed_site())
}
