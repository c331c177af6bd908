//! The attributes of a function that go to the code made from it.

use crate::ast::Function;
use proc_macro2::Ident;
use syn::spanned::Spanned;
use syn::{Attribute, Meta};

/// The attributes that everything made from the function needs.
pub(super) fn conditions(function: &Function) -> impl Iterator<Item = &Attribute> {
    function.attributes.iter().filter(|attribute| attribute.path().is_ident("cfg"))
}

/// The attributes that set lints. What the user expects may come true in one part of what the function
/// becomes and not in another.
pub(super) fn lints(attributes: &[Attribute]) -> Vec<Attribute> {
    let levels = ["allow", "expect", "warn", "deny"];
    let mut lints: Vec<Attribute> = attributes
        .iter()
        .filter(|attribute| levels.iter().any(|word| attribute.path().is_ident(word)))
        .cloned()
        .collect();
    for attribute in &mut lints {
        if let Meta::List(list) = &mut attribute.meta
            && list.path.is_ident("expect")
        {
            list.path = Ident::new("allow", list.path.span()).into();
        }
    }
    lints
}
