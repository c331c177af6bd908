//! The native side: a type for the model to hold, the kernels, and a copy of the function for the compiler to
//! check.

mod blocks;
mod body;
mod check;
mod expressions;
mod fetches;
mod helper;
mod kernels;
mod loops;
mod unrolled;
mod work;

use crate::access::{GroupOf, Uses, structs};
use crate::ast::{Function, FunctionKind, Role};
use crate::fields::{POSITION, name_number};
use proc_macro2::{Ident, Span, TokenStream};
use quote::{ToTokens, format_ident, quote, quote_spanned};
use syn::ext::IdentExt;
use syn::spanned::Spanned;
use syn::{Attribute, Meta, Result, Type};

/// The most substates of a process: a row marks those that it has handed out in so many bits.
const MOST_SUBSTATES: usize = 128;

/// A name of the generated code that no name of the user can meet.
fn hidden(name: &str, span: Span) -> Ident {
    format_ident!("__xca_{name}", span = Span::mixed_site().located_at(span))
}

pub(crate) fn expand(function: &Function, original: &syn::ItemFn) -> Result<TokenStream> {
    match function.kind {
        FunctionKind::Helper => helper::expand(function, original),
        _ => process(function, original),
    }
}

/// A type of the user, or one that is unknown to the compiler where the check of the function has found an
/// error.
pub(crate) fn checked(type_: &impl ToTokens) -> Type {
    let check = check::name();
    Type::Verbatim(quote!(<::xca_core::checks::Checked<#check> as ::xca_core::checks::Then<#type_>>::Type))
}

/// A value of the user, likewise.
pub(crate) fn checked_value(value: &TokenStream) -> TokenStream {
    let check = check::name();
    quote!(<::xca_core::checks::Checked<#check> as ::xca_core::checks::Then<_>>::pass(#value))
}

/// The name of the constant that has a value only where all is right.
pub(crate) fn check_name() -> Ident {
    check::name()
}

/// The function behind a method that is an operation.
fn operation(name: &Ident) -> TokenStream {
    quote_spanned!(name.span()=> ::xca_core::methods::#name)
}

/// The attributes that everything made from the function needs.
fn conditions(function: &Function) -> impl Iterator<Item = &Attribute> {
    function.attributes.iter().filter(|attribute| attribute.path().is_ident("cfg"))
}

/// The attributes that set lints. What the user expects may come true in one part of what the function
/// becomes and not in another.
fn lints(attributes: &[Attribute]) -> Vec<Attribute> {
    let levels = ["allow", "expect", "warn", "deny"];
    let mut lints: Vec<Attribute> = attributes
        .iter()
        .filter(|attribute| levels.iter().any(|word| attribute.path().is_ident(word)))
        .cloned()
        .collect();
    for attribute in &mut lints {
        if let Meta::List(list) = &mut attribute.meta
            && list.path.is_ident("expect")
        {
            list.path = Ident::new("allow", list.path.span()).into();
        }
    }
    lints
}

/// `<S as HasSubstate<…>>` for a substate.
fn substate(group: GroupOf, field: &Ident, function: &Function) -> TokenStream {
    let type_ = structs(function).nth(group.argument().0).map(struct_of);
    let key = match group {
        GroupOf::Position => name_number(POSITION),
        _ => name_number(&field.unraw().to_string()),
    };
    let span = field.span();
    quote_spanned!(span=> <#type_ as ::xca_core::HasSubstate<#key>>)
}

/// The type of a substate in a kernel.
fn native_type(group: GroupOf, field: &Ident, function: &Function, real: &TokenStream) -> TokenStream {
    let substate = substate(group, field, function);
    quote!(#substate::Native<#real>)
}

/// What a kernel sees of the parameters.
fn native_parameters(type_: &Type, real: &TokenStream) -> TokenStream {
    quote!(<#type_ as ::xca_core::Parameters>::Native<#real>)
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

/// The constants that a function is generic in.
struct Generics {
    /// `<const N: usize>`
    declared: TokenStream,
    /// `<N>`
    given: TokenStream,
}

impl Generics {
    fn of(function: &Function) -> Self {
        if function.constants.is_empty() {
            return Self { declared: TokenStream::new(), given: TokenStream::new() };
        }
        let (constants, names) =
            (&function.constants, function.constants.iter().map(|constant| &constant.ident));
        Self { declared: quote!(<#(#constants),*>), given: quote!(<#(#names),*>) }
    }
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

/// The type of a struct of substates.
fn struct_of(role: &Role) -> Option<&Type> {
    match role {
        Role::Cell(type_) | Role::Slot(type_) | Role::Slots(type_) => Some(type_),
        Role::Parameters(_) | Role::Space | Role::Value(_) => None,
    }
}

/// The structs of parameters, with the names of their arguments.
fn parameters(function: &Function) -> impl Iterator<Item = (&Ident, &Type)> {
    function.arguments.iter().filter_map(|argument| match &argument.role {
        Role::Parameters(type_) => Some((&argument.name, type_)),
        _ => None,
    })
}
