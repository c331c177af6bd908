//! Helpers: an ordinary function, and one for each precision, found through a type of the same name.

use super::attributes::conditions;
use super::body::Writer;
use super::check;
use super::generics::Generics;
use super::names::hidden;
use super::types::native_parameters;
use crate::ast::{Call, Function, Role};
use crate::checked::checked;
use crate::fields::with_real;
use proc_macro2::TokenStream;
use quote::{format_ident, quote, quote_spanned};
use syn::Result;
use syn::spanned::Spanned;

pub(super) fn expand(function: &Function, original: &syn::ItemFn) -> Result<TokenStream> {
    let data = crate::data::function(function)?;
    let (name, visibility) = (&function.name, &function.visibility);
    let ordinary = check::ordinary(function, original);
    let natives = [quote!(f32), quote!(f64)].map(|real| native(function, &real));
    let (check, aliases) = (check::check(function, original), check::aliases(function));
    let conditions: Vec<_> = conditions(function).collect();
    let Generics { declared, .. } = Generics::of(function);
    let depth = depth(function);
    Ok(quote! {
        #ordinary

        #(#conditions)*
        #[doc(hidden)]
        #[allow(non_camel_case_types, dead_code)]
        #[derive(Clone, Copy, Debug)]
        #visibility struct #name {}

        #(#conditions)*
        const _: () = {
            #check

            #[automatically_derived]
            #[diagnostic::do_not_recommend]
            impl<T> ::xca_core::checks::Callable<T> for #name {}

            #[allow(warnings, arithmetic_overflow, overflowing_literals, unconditional_panic, clippy::all)]
            #[automatically_derived]
            impl #name {
                #depth

                #(#natives)*

                #[doc(hidden)]
                pub fn body #declared () -> ::xca_core::ir::Function {
                    #data
                }
            }

            #aliases

            const _: () = #name::SHADERS_KNOW_NO_RECURSION_WRITE_A_LOOP;
        };
    })
}

/// A constant that needs those of all helpers that are called. Helpers that call each other in a circle have
/// no such constant. The compiler then shows the calls, and the name says what to do.
fn depth(function: &Function) -> TokenStream {
    let callees = function.mentions.calls.iter().map(|Call { function, alias, .. }| {
        quote_spanned!(function.span()=> #alias::SHADERS_KNOW_NO_RECURSION_WRITE_A_LOOP;)
    });
    quote_spanned! {function.name.span()=>
        #[doc(hidden)]
        pub const SHADERS_KNOW_NO_RECURSION_WRITE_A_LOOP: () = { #(#callees)* };
    }
}

fn native(function: &Function, real: &TokenStream) -> TokenStream {
    let native = format_ident!("native_{}", real.to_string());
    let arguments = function.arguments.iter().map(|argument| {
        let name = &argument.name;
        match &argument.role {
            Role::Parameters(type_) => {
                let type_ = native_parameters(type_, real);
                quote!(#name: &#type_)
            }
            Role::Value(type_) => {
                let type_ = checked(&with_real(type_, real));
                quote!(#name: #type_)
            }
            _ => {
                let space = hidden("space", name.span());
                quote!(#space: ::xca_core::kernel::NativeSpace<'_, #real>)
            }
        }
    });
    let result = function.result.as_ref().map(|type_| checked(&with_real(type_, real)));
    let body = Writer::new(function, None, real.clone()).block(&function.body);
    let Generics { declared, .. } = Generics::of(function);
    quote! {
        #[doc(hidden)]
        #[inline(always)]
        pub fn #native #declared (#(#arguments),*) -> #result #body
    }
}
