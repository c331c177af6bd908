//! The types of substates and parameters in the generated code.

use crate::access::{GroupOf, structs};
use crate::ast::{Function, Role};
use crate::fields::{POSITION, name_number};
use proc_macro2::{Ident, TokenStream};
use quote::{quote, quote_spanned};
use syn::Type;
use syn::ext::IdentExt;

/// `<S as HasSubstate<…>>` for a substate.
pub(super) fn substate(group: GroupOf, field: &Ident, function: &Function) -> TokenStream {
    let type_ = structs(function).nth(group.argument().0).map(struct_of);
    let key = match group {
        GroupOf::Position => name_number(POSITION),
        _ => name_number(&field.unraw().to_string()),
    };
    let span = field.span();
    quote_spanned!(span=> <#type_ as ::xca_core::HasSubstate<#key>>)
}

/// The type of a substate in a kernel.
pub(super) fn native_type(
    group: GroupOf,
    field: &Ident,
    function: &Function,
    real: &TokenStream,
) -> TokenStream {
    let substate = substate(group, field, function);
    quote!(#substate::Native<#real>)
}

/// What a kernel sees of the parameters.
pub(super) fn native_parameters(type_: &Type, real: &TokenStream) -> TokenStream {
    quote!(<#type_ as ::xca_core::Parameters>::Native<#real>)
}

/// The type of a struct of substates.
pub(super) fn struct_of(role: &Role) -> Option<&Type> {
    match role {
        Role::Cell(type_) | Role::Slot(type_) | Role::Slots(type_) => Some(type_),
        Role::Parameters(_) | Role::Space | Role::Value(_) => None,
    }
}

/// The structs of parameters, with the names of their arguments.
pub(super) fn parameters(function: &Function) -> impl Iterator<Item = (&Ident, &Type)> {
    function.arguments.iter().filter_map(|argument| match &argument.role {
        Role::Parameters(type_) => Some((&argument.name, type_)),
        _ => None,
    })
}

/// The function behind a method that is an operation.
pub(super) fn operation(name: &Ident) -> TokenStream {
    quote_spanned!(name.span()=> ::xca_core::methods::#name)
}
