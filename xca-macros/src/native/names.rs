//! The names of the generated code.

use crate::access::GroupOf;
use proc_macro2::{Ident, Span};
use quote::format_ident;
use syn::ext::IdentExt;

/// A name of the generated code that no name of the user can meet.
pub(super) fn hidden(name: &str, span: Span) -> Ident {
    format_ident!("__xca_{name}", span = Span::mixed_site().located_at(span))
}

/// The variable that holds an own substate while the body runs.
pub(super) fn own_name(field: &Ident) -> Ident {
    hidden(&format!("own_{}", field.unraw()), field.span())
}

/// The argument from which a substate is read.
pub(super) fn read_name(group: GroupOf, field: &Ident) -> Ident {
    let prefix = match group {
        GroupOf::Argument(number) => format!("read_{}", number.0),
        GroupOf::Position => "search".to_owned(),
    };
    hidden(&format!("{prefix}_{}", field.unraw()), field.span())
}

/// The variable that holds a substate of the other item of a pair.
pub(super) fn other_name(group: GroupOf, field: &Ident) -> Ident {
    hidden(&format!("other_{}", read_name(group, field)), field.span())
}

/// The argument to which a substate is written.
pub(super) fn write_name(field: &Ident) -> Ident {
    hidden(&format!("write_{}", field.unraw()), field.span())
}
