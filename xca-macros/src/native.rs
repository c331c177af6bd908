//! The native side: a type for the model to hold, the kernels, and an unchanged copy of the function for the compiler to check.

mod body;
mod kernels;

use crate::access::{GroupOf, Uses, groups};
use crate::ast::{Function, FunctionKind, Role};
use crate::fields::{POSITION, name_number, with_real};
use proc_macro2::{Ident, Span, TokenStream};
use quote::{quote, quote_spanned};
use syn::Result;

/// A name of the generated code that no name of the user can meet.
fn hidden(name: &str, span: Span) -> Ident {
    Ident::new(name, Span::mixed_site().located_at(span))
}

pub(crate) fn expand(function: &Function, original: &syn::ItemFn) -> Result<TokenStream> {
    match function.kind {
        FunctionKind::Helper => helper(function, original),
        _ => process(function, original),
    }
}

/// `<S as HasSubstate<…>>` for an access.
fn substate(access: &crate::access::Access, function: &Function) -> TokenStream {
    let (subject, companion) = groups(function);
    let type_ = match access.group {
        GroupOf::Companion => companion,
        GroupOf::Subject | GroupOf::Position => subject,
    };
    let key = match access.group {
        GroupOf::Position => name_number(POSITION),
        _ => name_number(&access.field.to_string()),
    };
    let span = access.field.span();
    quote_spanned!(span=> <#type_ as ::xca_core::HasSubstate<#key>>)
}

fn process(function: &Function, original: &syn::ItemFn) -> Result<TokenStream> {
    let data = crate::data::function(function)?;
    let uses = Uses::of(function);
    let (name, visibility) = (&function.name, &function.visibility);
    let documentation: Vec<_> =
        function.attributes.iter().filter(|attribute| attribute.path().is_ident("doc")).collect();
    let text = name.to_string();
    let kind = match function.kind {
        FunctionKind::Cells => quote!(Cells),
        FunctionKind::Items => quote!(Items),
        FunctionKind::Migration | FunctionKind::Helper => quote!(Migration),
    };
    let (subject, companion) = groups(function);
    let group = |type_: &syn::Type| {
        quote! {
            ::xca_core::kernel::Group {
                type_id: ::core::any::TypeId::of::<#type_>,
                schema: <#type_ as ::xca_core::Substates>::SCHEMA,
            }
        }
    };
    let subject_group = subject.map(group);
    let companion_group = match companion.map(group) {
        Some(group) => quote!(::core::option::Option::Some(#group)),
        None => quote!(::core::option::Option::None),
    };
    let parameters = match parameters_type(function) {
        Some(type_) => quote! {
            ::core::option::Option::Some((
                ::core::any::TypeId::of::<#type_> as fn() -> ::core::any::TypeId,
                <#type_ as ::xca_core::Parameters>::SCHEMA,
            ))
        },
        None => quote!(::core::option::Option::None),
    };
    let accesses = uses.accesses.iter().map(|access| {
        let substate = substate(access, function);
        let of = if access.group == GroupOf::Companion { quote!(Companion) } else { quote!(Subject) };
        let (centre, others, write) = (access.centre, access.others, access.write);
        quote! {
            ::xca_core::kernel::Access {
                of: ::xca_core::kernel::Of::#of,
                field: #substate::INDEX,
                centre: #centre,
                others: #others,
                write: #write,
            }
        }
    });
    let neighbours = uses.neighbours;
    let row_f32 = kernels::row(function, &uses, &quote!(f32), "row_f32");
    let row_f64 = kernels::row(function, &uses, &quote!(f64), "row_f64");
    let check = check(original);
    Ok(quote! {
        #(#documentation)*
        #[allow(non_camel_case_types)]
        #visibility struct #name;

        #check

        #[automatically_derived]
        impl ::xca_core::ElementaryProcess for #name {
            fn process() -> ::xca_core::Process {
                const ACCESS: &[::xca_core::kernel::Access] = &[#(#accesses),*];
                ::xca_core::Process {
                    name: #text,
                    module: ::core::module_path!(),
                    kind: ::xca_core::ProcessKind::#kind,
                    subject: #subject_group,
                    companion: #companion_group,
                    parameters: #parameters,
                    local_interaction: #neighbours,
                    access: ACCESS,
                    body: || #data,
                    row_f32: { #row_f32 row_f32 },
                    row_f64: { #row_f64 row_f64 },
                }
            }
        }
    })
}

fn parameters_type(function: &Function) -> Option<&syn::Type> {
    function.arguments.iter().find_map(|argument| match &argument.role {
        Role::Parameters(type_) => Some(type_),
        _ => None,
    })
}

/// The function as the user wrote it, against the vocabulary types: it gives the compiler's own messages and serves editors.
fn check(original: &syn::ItemFn) -> TokenStream {
    let mut original = original.clone();
    original.vis = syn::Visibility::Inherited;
    original.attrs.retain(|attribute| !attribute.path().is_ident("doc"));
    syn::visit_mut::visit_block_mut(&mut SpellOut, &mut original.block);
    quote! {
        const _: () = {
            #[allow(dead_code, clippy::all)]
            #original
        };
    }
}

/// Writes `a += b` as `a = a + b`: the fields of a cell are reached through `DerefMut`, and in a compound assignment of vectors that
/// would borrow the cell while the right-hand side reads it.
struct SpellOut;

impl syn::visit_mut::VisitMut for SpellOut {
    fn visit_expr_mut(&mut self, expression: &mut syn::Expr) {
        syn::visit_mut::visit_expr_mut(self, expression);
        let syn::Expr::Binary(binary) = expression else { return };
        let Some(operator) = crate::parse::plain_operator(&binary.op) else { return };
        let (left, right) = (&binary.left, &binary.right);
        let span = syn::spanned::Spanned::span(&binary.op);
        let sum = quote_spanned!(span=> #left #operator (#right));
        *expression = syn::Expr::Verbatim(quote_spanned!(span=> #left = #sum));
    }
}

fn helper(function: &Function, original: &syn::ItemFn) -> Result<TokenStream> {
    let data = crate::data::function(function)?;
    let (name, visibility) = (&function.name, &function.visibility);
    let natives = [("native_f32", quote!(f32)), ("native_f64", quote!(f64))].map(|(native, real)| {
        let native = Ident::new(native, name.span());
        let arguments = function.arguments.iter().map(|argument| {
            let name = &argument.name;
            match &argument.role {
                Role::Parameters(type_) => {
                    let parameters = hidden("parameters", name.span());
                    quote!(#parameters: &<#type_ as ::xca_core::Parameters>::Native<#real>)
                }
                Role::Value(type_) => {
                    let type_ = with_real(type_, &real);
                    quote!(#name: #type_)
                }
                _ => {
                    let space = hidden("space", name.span());
                    quote!(#space: ::xca_core::kernel::NativeSpace<'_, #real>)
                }
            }
        });
        let result = function.result.as_ref().map(|type_| with_real(type_, &real));
        let body = body::Writer::new(function, real.clone()).block(&function.body);
        quote! {
            #[doc(hidden)]
            #[inline(always)]
            pub fn #native(#(#arguments),*) -> #result #body
        }
    });
    Ok(quote! {
        #[allow(dead_code)]
        #original

        #[doc(hidden)]
        #[allow(non_camel_case_types, missing_docs)]
        #visibility struct #name {}

        #[allow(warnings, clippy::all)]
        #[automatically_derived]
        impl #name {
            #(#natives)*

            #[doc(hidden)]
            pub fn body() -> ::xca_core::ir::Function {
                #data
            }
        }
    })
}
