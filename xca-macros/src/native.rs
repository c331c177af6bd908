//! The native side: a type for the model to hold, the kernels, and a copy of the function for the compiler to
//! check.

mod attributes;
mod batches;
mod blocks;
mod body;
mod check;
mod company;
mod expressions;
mod fetches;
mod generics;
mod helper;
mod kernels;
mod labels;
mod local_sums;
mod loops;
mod mates;
mod names;
mod plain;
mod sums;
mod types;
mod unrolled;
mod work;

use crate::access::{Uses, structs};
use crate::ast::{Function, FunctionKind, Role};
use attributes::{conditions, lints};
use generics::Generics;
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;
use syn::Result;
use syn::ext::IdentExt;
use types::{parameters, struct_of, substate};

/// The most substates of a process: a row marks those that it has handed out in so many bits.
const MOST_SUBSTATES: usize = 128;

pub(crate) fn expand(function: &Function, original: &syn::ItemFn) -> Result<TokenStream> {
    match function.kind {
        FunctionKind::Helper => helper::expand(function, original),
        _ => process(function, original),
    }
}

fn process(function: &Function, original: &syn::ItemFn) -> Result<TokenStream> {
    let data = crate::data::function(function)?;
    let uses = Uses::of(function);
    if uses.accesses.len() > MOST_SUBSTATES {
        return Err(syn::Error::new(
            function.name.span(),
            format!("a process uses at most {MOST_SUBSTATES} substates; join some into arrays"),
        ));
    }
    let (name, visibility) = (&function.name, &function.visibility);
    let kept = function
        .attributes
        .iter()
        .filter(|attribute| ["doc", "cfg", "deprecated"].iter().any(|word| attribute.path().is_ident(word)));
    let lints = lints(&function.attributes);
    let conditions: Vec<_> = conditions(function).collect();
    // A process that is deprecated may be mentioned in its own code.
    let deprecated = function.attributes.iter().any(|attribute| attribute.path().is_ident("deprecated"));
    let allow = deprecated.then(|| quote!(#[allow(deprecated)]));
    let description = description(function, &uses, &data);
    let Generics { declared, given } = Generics::of(function);
    let (check, aliases) = (check::check(function, original), check::aliases(function));
    Ok(quote! {
        #(#kept)*
        #(#lints)*
        #[allow(non_camel_case_types)]
        #[derive(Clone, Copy, Debug)]
        #visibility struct #name #declared;

        #(#conditions)*
        #allow
        const _: () = {
            #check

            #[automatically_derived]
            impl #declared ::xca_core::ElementaryProcess for #name #given {
                fn process() -> ::xca_core::Process {
                    #description
                }
            }

            #aliases
        };
    })
}

/// What the process is called, `update<0>` where it is generic.
fn process_name(function: &Function) -> TokenStream {
    let name = function.name.unraw().to_string();
    if function.constants.is_empty() {
        quote!(#name)
    } else {
        quote!(::xca_core::checks::name_of::<Self>(#name))
    }
}

/// The `xca_core::Process`.
fn description(function: &Function, uses: &Uses, data: &TokenStream) -> TokenStream {
    let name = process_name(function);
    let kind = match function.kind {
        FunctionKind::Cells => quote!(Cells),
        FunctionKind::Items => quote!(Items),
        FunctionKind::Migration | FunctionKind::Helper => quote!(Migration),
    };
    let substates = structs(function).map(|role| {
        let (type_, holds) = (struct_of(role), if matches!(role, Role::Cell(_)) { "Cells" } else { "Items" });
        let holds = Ident::new(holds, Span::call_site());
        quote! {
            ::xca_core::Argument {
                type_id: ::core::any::TypeId::of::<#type_>,
                schema: <#type_ as ::xca_core::Substates>::SCHEMA,
                holds: ::xca_core::Holds::#holds,
            }
        }
    });
    let parameters = parameters(function).map(|(_, type_)| {
        quote! {
            ::xca_core::ParametersArgument {
                type_id: ::core::any::TypeId::of::<#type_>,
                schema: <#type_ as ::xca_core::Parameters>::SCHEMA,
            }
        }
    });
    let accesses = uses.accesses.iter().map(|access| {
        let substate = substate(access.group, &access.field, function);
        let argument = access.group.argument().0;
        let (centre, others, write) = (access.centre, access.others, access.write);
        quote! {
            ::xca_core::kernel::Access {
                argument: #argument,
                field: #substate::INDEX,
                centre: #centre,
                others: #others,
                write: #write,
            }
        }
    });
    let (neighbours, opposites, step) = (uses.neighbours, uses.opposites, uses.step);
    let [row_f32, row_f64] = [quote!(f32), quote!(f64)].map(|real| kernels::row(function, uses, &real));
    quote! {
        const __XCA_ACCESS: &[::xca_core::kernel::Access] = &[#(#accesses),*];
        ::xca_core::Process {
            name: #name,
            module: ::core::module_path!(),
            kind: ::xca_core::ProcessKind::#kind,
            every: 1,
            substates: &[#(#substates),*],
            parameters: &[#(#parameters),*],
            local_interaction: #neighbours,
            uses_opposite: #opposites,
            uses_step: #step,
            access: __XCA_ACCESS,
            body: || #data,
            row_f32: #row_f32,
            row_f64: #row_f64,
        }
    }
}
