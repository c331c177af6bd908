//! Helpers: an ordinary function, and one for each precision, found through a type of the same name.

use super::attributes::conditions;
use super::body::Writer;
use super::check;
use super::generics::Generics;
use super::names::hidden;
use super::types::native_parameters;
use crate::ast::{Function, Role};
use crate::checked::checked;
use crate::fields::with_real;
use proc_macro2::TokenStream;
use quote::{format_ident, quote};
use syn::Result;

pub(super) fn expand(function: &Function, original: &syn::ItemFn) -> Result<TokenStream> {
    let data = crate::data::function(function)?;
    let (name, visibility) = (&function.name, &function.visibility);
    let ordinary = check::ordinary(original);
    let natives = [quote!(f32), quote!(f64)].map(|real| native(function, &real));
    let (check, aliases) = (check::check(function, original), check::aliases(function));
    let conditions: Vec<_> = conditions(function).collect();
    let Generics { declared, .. } = Generics::of(function);
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
                #(#natives)*

                #[doc(hidden)]
                pub fn body #declared () -> ::xca_core::ir::Function {
                    #data
                }
            }

            #aliases
        };
    })
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
