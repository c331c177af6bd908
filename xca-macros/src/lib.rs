//! The macros of xca: one Rust function becomes a native row kernel and the data that a shader is written
//! from.
//!
//! Use them through `xca_core`, whose documentation explains the accepted subset of Rust.

mod access;
mod ast;
mod checked;
mod data;
mod fields;
mod library;
mod native;
mod parse;
mod parts;
mod size;
mod states;

use parse::Wanted;
use proc_macro::TokenStream;

#[doc = include_str!("../docs/elementary_process.md")]
#[proc_macro_attribute]
pub fn elementary_process(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand(attribute, item, Wanted::Process)
}

#[doc = include_str!("../docs/migration.md")]
#[proc_macro_attribute]
pub fn migration(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand(attribute, item, Wanted::Migration)
}

#[doc = include_str!("../docs/helper.md")]
#[proc_macro_attribute]
pub fn helper(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand(attribute, item, Wanted::Helper)
}

/// Derives the trait `Substates` for a struct: the state of a cell or an item.
#[proc_macro_derive(Substates, attributes(position, substate, parameter))]
pub fn substates(item: TokenStream) -> TokenStream {
    let item = syn::parse_macro_input!(item as syn::DeriveInput);
    finished(fields::substates(&item))
}

/// Derives the trait `States` for an enum without fields, so that substates and parameters can have its type.
#[proc_macro_derive(States)]
pub fn states(item: TokenStream) -> TokenStream {
    let item = syn::parse_macro_input!(item as syn::DeriveInput);
    finished(states::states(&item))
}

/// Derives the trait `Parameters` for a struct: the parameters of a model.
#[proc_macro_derive(Parameters, attributes(parameter, substate))]
pub fn parameters(item: TokenStream) -> TokenStream {
    let item = syn::parse_macro_input!(item as syn::DeriveInput);
    finished(fields::parameters(&item))
}

/// What a derive has written, or its message.
fn finished(code: syn::Result<proc_macro2::TokenStream>) -> TokenStream {
    library::named(code.unwrap_or_else(|error| error.to_compile_error())).into()
}

fn expand(attribute: TokenStream, item: TokenStream, wanted: Wanted) -> TokenStream {
    let attribute = proc_macro2::TokenStream::from(attribute);
    let mut function: syn::ItemFn = match syn::parse(item.clone()) {
        Ok(function) => function,
        Err(error) => return no_function(item, wanted, &error).into(),
    };
    xca_spelling::spell_out_matches(&mut function);
    let expanded = if attribute.is_empty() {
        parse::function(xca_spelling::spell_out(&function), wanted)
            .and_then(|parsed| native::expand(&parsed, &function))
    } else {
        Err(syn::Error::new_spanned(
            attribute,
            format!(
                "{} takes no arguments; what the function works on follows from its arguments",
                wanted.attribute()
            ),
        ))
    };
    library::named(expanded.unwrap_or_else(|error| fallback(&error, &function, wanted))).into()
}

/// After an error: the messages, and enough of the item that its uses elsewhere make no errors of their own.
fn fallback(error: &syn::Error, function: &syn::ItemFn, wanted: Wanted) -> proc_macro2::TokenStream {
    let messages = error.to_compile_error();
    let (visibility, name) = (&function.vis, &function.sig.ident);
    if function.sig.receiver().is_some() {
        return messages;
    }
    if wanted == Wanted::Helper {
        // The function for ordinary code, and for processes a type that is unknown to the compiler because of
        // the error.
        let mut ordinary = function.clone();
        *ordinary.block = syn::parse_quote!({ ::core::unreachable!() });
        return quote::quote! {
            #[allow(warnings)]
            #ordinary

            #[allow(non_camel_case_types, dead_code)]
            #[doc(hidden)]
            #visibility type #name = <::xca_core::checks::Checked<{ #messages true }> as ::xca_core::checks::Then<()>>::Type;
        };
    }
    // A process can be generic in constants; what else is generic has a message.
    let mut generics = function.sig.generics.clone();
    generics.params = generics
        .params
        .into_iter()
        .filter(|parameter| matches!(parameter, syn::GenericParam::Const(_)))
        .collect();
    let (declared, given, _) = generics.split_for_impl();
    quote::quote! {
        #messages

        #[allow(non_camel_case_types, missing_docs)]
        #visibility struct #name #declared;

        #[automatically_derived]
        impl #declared ::xca_core::ElementaryProcess for #name #given {
            fn process() -> ::xca_core::Process {
                ::core::unreachable!()
            }
        }
    }
}

/// The message for an item that is no function.
fn no_function(item: TokenStream, wanted: Wanted, error: &syn::Error) -> proc_macro2::TokenStream {
    match syn::parse::<syn::Item>(item) {
        Ok(item) => {
            let message = format!("{} stands on a function", wanted.attribute());
            let message = syn::Error::new_spanned(&item, message).to_compile_error();
            quote::quote! { #message #item }
        }
        Err(_) => error.to_compile_error(),
    }
}
