//! Code that stands only where the check of a function or a struct has found no error.

use proc_macro2::{Ident, Span, TokenStream};
use quote::{ToTokens, quote};
use syn::Type;

/// The name of the constant that has a value only where all is right.
pub(crate) fn name() -> Ident {
    Ident::new("__XCA_CHECKED", Span::call_site())
}

/// A type of the user, or one that is unknown to the compiler where the check has found an error.
pub(crate) fn checked(type_: &impl ToTokens) -> Type {
    let check = name();
    Type::Verbatim(quote!(<::xca_core::checks::Checked<#check> as ::xca_core::checks::Then<#type_>>::Type))
}

/// A value of the user, likewise.
pub(crate) fn checked_value(value: &TokenStream) -> TokenStream {
    let check = name();
    quote!(<::xca_core::checks::Checked<#check> as ::xca_core::checks::Then<_>>::pass(#value))
}
