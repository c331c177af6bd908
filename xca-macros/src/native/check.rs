//! A copy of the function for the compiler to check, against the words that the user wrote it in.
//!
//! It stands in a constant that has a value only if the copy is without errors; see `xca_core::checks`.

use crate::access::groups;
use crate::ast::Function;
use proc_macro2::{Ident, Span, TokenStream};
use quote::{quote, quote_spanned};
use syn::spanned::Spanned;
use syn::visit_mut::VisitMut;

/// The name of the constant.
pub(super) fn name() -> Ident {
    Ident::new("__XCA_CHECKED", Span::call_site())
}

/// The constant, and the names by which helpers are called.
pub(super) fn check(function: &Function, original: &syn::ItemFn) -> TokenStream {
    let name = name();
    let aliases = aliases(function);
    let callable = function.mentions.calls.iter().map(|call| {
        let alias = &call.alias;
        quote_spanned!(alias.span()=> ::xca_core::checks::callable::<#alias>();)
    });
    let constants = function.mentions.constants.iter().map(|path| {
        quote_spanned!(path.span()=> ::xca_core::ir::ConstantValue::constant(&#path);)
    });
    let patterns = function
        .mentions
        .patterns
        .iter()
        .map(|path| quote_spanned!(path.span()=> ::xca_core::checks::pattern(&#path);));
    let position = function.mentions.search.map(|span| {
        let (subject, _) = groups(function);
        quote_spanned!(span=> ::xca_core::checks::position::<#subject>();)
    });
    let copy = copy(original);
    quote! {
        #aliases

        const #name: bool = {
            #(#callable)*
            #position
            let _ = || {
                #(#constants)*
                #(#patterns)*
            };
            #copy
            true
        };
    }
}

/// Names for the helpers that are called: of the helper's own type, or, where the function is no helper and has no such type,
/// of one that says so.
fn aliases(function: &Function) -> TokenStream {
    let calls = &function.mentions.calls;
    if calls.is_empty() {
        return TokenStream::new();
    }
    let plain = calls.iter().map(|call| {
        let alias = &call.alias;
        quote!(pub type #alias = ::xca_core::checks::PlainFunction;)
    });
    let imports = calls.iter().map(|call| {
        let (function, alias) = (&call.function, &call.alias);
        quote!(#[allow(unused_imports)] use #function as #alias;)
    });
    // What is imported by name goes before what is imported by `*`.
    quote! {
        #[allow(non_camel_case_types)]
        mod __xca_plain_functions {
            #(#plain)*
        }
        #[allow(unused_imports)]
        use __xca_plain_functions::*;
        #(#imports)*
    }
}

/// The function as a closure, which belongs to the constant's own body.
fn copy(original: &syn::ItemFn) -> TokenStream {
    let mut block = original.block.clone();
    SpellOut.visit_block_mut(&mut block);
    let inputs = &original.sig.inputs;
    let output = match &original.sig.output {
        syn::ReturnType::Default => quote!(-> ()),
        written @ syn::ReturnType::Type(..) => quote!(#written),
    };
    let lints = super::lints(&original.attrs);
    quote! {
        #(#lints)*
        #[allow(clippy::all, clippy::pedantic, clippy::nursery, clippy::restriction)]
        let _ = |#inputs| #output #block;
    }
}

/// Writes `a += b` as `a = a + b`: the fields of a cell are reached through `DerefMut`, and in a compound assignment of vectors that
/// would borrow the cell while the right-hand side reads it.
struct SpellOut;

impl VisitMut for SpellOut {
    fn visit_expr_mut(&mut self, expression: &mut syn::Expr) {
        syn::visit_mut::visit_expr_mut(self, expression);
        let syn::Expr::Binary(binary) = expression else { return };
        let Some(operator) = crate::parse::plain_operator(&binary.op) else { return };
        let (left, right) = (&binary.left, &binary.right);
        let span = binary.op.span();
        let sum = quote_spanned!(span=> #left #operator (#right));
        *expression = syn::Expr::Verbatim(quote_spanned!(span=> #left = #sum));
    }
}
