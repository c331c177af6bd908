//! A copy of the function for the compiler to check, against the words that the user wrote it in.
//!
//! It stands in a constant that has a value only if the copy is without errors; see `xca_core::checks`.

use super::attributes::lints;
use super::types::operation;
use crate::ast::{Call, Function, Mentions};
use crate::checked::{self, checked};
use proc_macro2::{Ident, Span, TokenStream};
use quote::{quote, quote_spanned};
use syn::spanned::Spanned;
use syn::visit_mut::VisitMut;
use xca_methods::{Meaning, Method};

/// The constant.
pub(super) fn check(function: &Function, original: &syn::ItemFn) -> TokenStream {
    let name = checked::name();
    let mentions = &function.mentions;
    let constants = mentions.constants.iter().map(|path| {
        quote_spanned!(path.span()=> ::core::mem::drop(::xca_core::ir::ConstantValue::constant(&#path));)
    });
    let patterns = mentions
        .patterns
        .iter()
        .map(|path| quote_spanned!(path.span()=> ::xca_core::checks::PatternConstant::pattern(&#path);));
    let substates = mentions
        .substates
        .iter()
        .map(|type_| quote_spanned!(type_.span()=> let _ = <#type_ as ::xca_core::Substates>::SCHEMA;));
    let parameters = mentions
        .parameters
        .iter()
        .map(|type_| quote_spanned!(type_.span()=> let _ = <#type_ as ::xca_core::Parameters>::SCHEMA;));
    // A word may be an alias of another type: then the kernels would not be what the body says as data.
    let types = mentions.types.iter().map(|type_| {
        let meant = crate::fields::meant(type_);
        quote_spanned!(type_.span()=> let _: fn(#type_) -> #meant = |value| value;)
    });
    let copy = copy(function, original);
    // Of a generic function each of its kernels checks them.
    let arrays =
        mentions.arrays.iter().enumerate().filter(|_| function.constants.is_empty()).map(|(last, array)| {
            let sizes = mentions.arrays[..=last].iter().map(|array| &array.bytes);
            quote_spanned!(array.span=> ::xca_core::checks::arrays_fit(0 #(+ #sizes)*);)
        });
    let generic: TokenStream = function.constants.iter().map(representative).collect();
    quote! {
        #[allow(clippy::type_complexity)]
        const #name: bool = {
            #generic
            #(#arrays)*
            let _ = || {
                #(#types)*
                #(#substates)*
                #(#parameters)*
                #(#constants)*
                #(#patterns)*
            };
            #copy
            true
        };
    }
}

/// A constant that the function is generic in, with a value for the check: any that is no length of an array
/// by chance.
fn representative(constant: &syn::ConstParam) -> TokenStream {
    let (name, type_) = (&constant.ident, &constant.ty);
    let value = if quote!(#type_).to_string() == "bool" { quote!(false) } else { quote!(61) };
    quote! {
        #[allow(dead_code)]
        const #name: #type_ = #value;
    }
}

/// The function as a closure, which belongs to the constant's own body.
fn copy(function: &Function, original: &syn::ItemFn) -> TokenStream {
    let mut block = original.block.clone();
    SpellOut(&function.mentions).visit_block_mut(&mut block);
    let inputs = &original.sig.inputs;
    let output = match &original.sig.output {
        syn::ReturnType::Default => quote!(-> ()),
        written @ syn::ReturnType::Type(..) => quote!(#written),
    };
    let lints = lints(&original.attrs);
    // A constant that the function is generic in has another value here.
    let generic =
        (!function.constants.is_empty()).then(|| quote!(#[allow(arithmetic_overflow, unconditional_panic)]));
    quote! {
        #(#lints)*
        #generic
        #[allow(clippy::all, clippy::pedantic, clippy::nursery, clippy::restriction)]
        let _ = |#inputs| #output #block;
    }
}

/// Writes `a += b` as `a = a + b`: the fields of a cell are reached through `DerefMut`, and in a compound
/// assignment of vectors that would borrow the cell while the right-hand side reads it. For the same reason
/// an index of what is assigned to gets a name before. Methods become the functions that they mean, which
/// take literals of any type. And each call of a function checks that it is a helper. An iterator over a
/// substate goes through a copy, so that the cell can be written meanwhile.
struct SpellOut<'a>(&'a Mentions);

/// Gives names to the indices of a place, outermost last, but for numbers and names.
fn name_indices(place: &mut syn::Expr, names: &mut Vec<TokenStream>) {
    match place {
        syn::Expr::Index(index) => {
            name_indices(&mut index.expr, names);
            if !matches!(*index.index, syn::Expr::Lit(_) | syn::Expr::Path(_)) {
                let expression = &index.index;
                let name = quote::format_ident!("__xca_index_{}", names.len(), span = Span::mixed_site());
                names.push(quote_spanned!(expression.span()=> let #name = #expression;));
                *index.index = syn::parse_quote!(#name);
            }
        }
        syn::Expr::Field(field) => name_indices(&mut field.base, names),
        syn::Expr::Paren(paren) => name_indices(&mut paren.expr, names),
        _ => {}
    }
}

/// An assignment after the names that it needs.
fn with(names: &[TokenStream], assignment: &TokenStream) -> TokenStream {
    if names.is_empty() { assignment.clone() } else { quote!({ #(#names)* #assignment }) }
}

impl VisitMut for SpellOut<'_> {
    fn visit_expr_mut(&mut self, expression: &mut syn::Expr) {
        syn::visit_mut::visit_expr_mut(self, expression);
        match expression {
            syn::Expr::Binary(binary) => {
                let Some(operator) = crate::parse::plain_operator(&binary.op) else { return };
                let mut names = Vec::new();
                name_indices(&mut binary.left, &mut names);
                let (left, right) = (&binary.left, &binary.right);
                let span = binary.op.span();
                let sum = quote_spanned!(span=> #left #operator (#right));
                *expression = syn::Expr::Verbatim(with(&names, &quote_spanned!(span=> #left = #sum)));
            }
            syn::Expr::Assign(assign) => {
                let mut names = Vec::new();
                name_indices(&mut assign.left, &mut names);
                *expression = syn::Expr::Verbatim(with(&names, &quote!(#assign)));
            }
            syn::Expr::Call(call) => {
                let syn::Expr::Path(path) = &*call.func else { return };
                let mut function = path.path.clone();
                if let Some(last) = function.segments.last_mut() {
                    last.arguments = syn::PathArguments::None;
                }
                let text = quote!(#function).to_string();
                let helper = self.0.calls.iter().find(|call| {
                    let function = &call.function;
                    quote!(#function).to_string() == text
                });
                if let Some(Call { import, .. }) = helper {
                    let import = Ident::new(&import.to_string(), function.span());
                    *expression = syn::Expr::Verbatim(
                        quote_spanned!(function.span()=> <#import as ::xca_core::checks::Callable<_>>::result(#call)),
                    );
                }
            }
            syn::Expr::MethodCall(call) => {
                if call.method == "iter" {
                    copy_substate(&mut call.receiver);
                }
                if let Some(function) = as_function(call, &self.0.references) {
                    *expression = function;
                }
            }
            syn::Expr::Reference(reference) => copy_substate(&mut reference.expr),
            _ => {}
        }
    }
}

fn copy_substate(values: &mut syn::Expr) {
    if matches!(values, syn::Expr::Field(_)) {
        *values = syn::Expr::Verbatim(quote_spanned!(values.span()=> { #values }));
    }
}

/// A helper as ordinary code: its methods are those of a process, so that it computes the same everywhere. In
/// a constant function they are those of Rust.
pub(super) fn ordinary(function: &Function, original: &syn::ItemFn) -> syn::ItemFn {
    let mut ordinary = original.clone();
    if original.sig.constness.is_none() {
        Methods(&function.mentions.references).visit_block_mut(&mut ordinary.block);
    }
    ordinary
}

/// With the names that are references.
struct Methods<'a>(&'a [Ident]);

impl VisitMut for Methods<'_> {
    fn visit_expr_mut(&mut self, expression: &mut syn::Expr) {
        syn::visit_mut::visit_expr_mut(self, expression);
        if let syn::Expr::MethodCall(call) = expression
            && let Some(function) = as_function(call, self.0)
        {
            *expression = function;
        }
    }
}

/// The call of the function that a method means.
fn as_function(call: &syn::ExprMethodCall, references: &[Ident]) -> Option<syn::Expr> {
    let method = Method::named(&call.method.to_string())?;
    // As an argument it needs no parentheses.
    let receiver = match &*call.receiver {
        syn::Expr::Paren(paren) => &paren.expr,
        receiver => receiver,
    };
    let receiver = match receiver {
        // In Rust a method is found through references too.
        syn::Expr::Path(path) if path.path.get_ident().is_some_and(|name| references.contains(name)) => {
            quote_spanned!(path.span()=> ::xca_core::methods::by_value(#path))
        }
        receiver => quote!(#receiver),
    };
    let (arguments, span) = (&call.args, call.method.span());
    Some(syn::Expr::Verbatim(match method.meaning {
        Meaning::Operation(_) => {
            let function = operation(&call.method);
            quote_spanned!(span=> #function(#receiver, #arguments))
        }
        Meaning::Function(function) => {
            let function = Ident::new(function, span);
            let receiver = quote_spanned!(span=> ::xca_core::methods::real(#receiver));
            quote_spanned!(span=> ::xca_core::math::#function(#receiver, #arguments))
        }
    }))
}

/// Names for the helpers that are called: of the helper's own type, or, where the function is no helper and
/// has no such type, of one that says so.
///
/// It comes after everything that the user wrote: its macros exist only so that there is something to import
/// where the user calls a function that does not exist, and must not be seen from there.
pub(super) fn aliases(function: &Function) -> TokenStream {
    let calls = &function.mentions.calls;
    if calls.is_empty() {
        return TokenStream::new();
    }
    let plain = calls.iter().map(|call| {
        let import = &call.import;
        quote!(pub type #import = ::xca_core::checks::PlainFunction;)
    });
    let imports = calls.iter().map(|call| {
        let Call { function, import, alias } = call;
        let checked = checked(import);
        let fallback = function.get_ident().map(|name| {
            quote! {
                #[allow(unused_macros)]
                macro_rules! #name { () => {}; }
            }
        });
        quote! {
            #fallback
            #[allow(unused_imports)]
            use #function as #import;
            #[allow(non_camel_case_types)]
            type #alias = #checked;
        }
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
