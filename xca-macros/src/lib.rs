//! The macros of xca: one Rust function becomes a native row kernel and the data that a shader is written from.
//!
//! Use them through `xca_core`, whose documentation explains the accepted subset of Rust.

mod access;
mod ast;
mod data;
mod fields;
mod native;
mod parse;

use parse::Wanted;
use proc_macro::TokenStream;

/// Makes an elementary process of a function. See the guide in `xca_core`.
#[proc_macro_attribute]
pub fn elementary_process(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand(attribute, item, Wanted::Process)
}

/// Makes a migration of a function: it says to which cell an item of a population belongs.
#[proc_macro_attribute]
pub fn migration(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand(attribute, item, Wanted::Migration)
}

/// Makes a function callable from processes, on every engine. It stays callable from ordinary code.
#[proc_macro_attribute]
pub fn helper(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand(attribute, item, Wanted::Helper)
}

/// Makes a struct the substates of a cell or of an item.
#[proc_macro_derive(Substates, attributes(position))]
pub fn substates(item: TokenStream) -> TokenStream {
    let item = syn::parse_macro_input!(item as syn::DeriveInput);
    fields::substates(&item).unwrap_or_else(|error| error.to_compile_error()).into()
}

/// Makes a struct the parameters of a model.
#[proc_macro_derive(Parameters)]
pub fn parameters(item: TokenStream) -> TokenStream {
    let item = syn::parse_macro_input!(item as syn::DeriveInput);
    fields::parameters(&item).unwrap_or_else(|error| error.to_compile_error()).into()
}

fn expand(attribute: TokenStream, item: TokenStream, wanted: Wanted) -> TokenStream {
    let attribute = proc_macro2::TokenStream::from(attribute);
    let function = syn::parse_macro_input!(item as syn::ItemFn);
    let expanded = if attribute.is_empty() {
        parse::function(&function, wanted).and_then(|parsed| native::expand(&parsed, &function))
    } else {
        Err(syn::Error::new_spanned(
            attribute,
            "this attribute takes no arguments; what the process runs for follows from its first argument",
        ))
    };
    expanded.unwrap_or_else(|error| fallback(&error, &function, wanted)).into()
}

/// After an error: the messages, and enough of the item that its uses elsewhere make no errors of their own.
fn fallback(error: &syn::Error, function: &syn::ItemFn, wanted: Wanted) -> proc_macro2::TokenStream {
    let messages = error.to_compile_error();
    let (visibility, name) = (&function.vis, &function.sig.ident);
    if wanted == Wanted::Helper {
        return quote::quote! { #messages };
    }
    quote::quote! {
        #messages
        #[allow(non_camel_case_types, missing_docs)]
        #visibility struct #name;
        impl ::xca_core::ElementaryProcess for #name {
            fn process() -> ::xca_core::Process {
                ::core::unreachable!()
            }
        }
    }
}
