//! Loops as data.

use super::words::{optional, text};
use super::{block, expression};
use crate::ast::{Loop, LoopKind, Range, Reach};
use proc_macro2::TokenStream;
use quote::quote;
use syn::{Lifetime, Result};

/// An expression of type `::xca_core::ir::Loop`.
pub(super) fn loop_(loop_: &Loop) -> Result<TokenStream> {
    let label = label(loop_.label.as_ref());
    let kind = kind(&loop_.kind)?;
    let body = block(&loop_.body)?;
    Ok(quote! {
        ::xca_core::ir::Loop { label: #label, kind: ::xca_core::ir::LoopKind::#kind, body: #body }
    })
}

/// The name of a label, if there is one.
pub(super) fn label(label: Option<&Lifetime>) -> TokenStream {
    match label {
        Some(label) => {
            let name = text(&label.ident);
            quote!(::core::option::Option::Some(#name))
        }
        None => quote!(::core::option::Option::None),
    }
}

fn kind(kind: &LoopKind) -> Result<TokenStream> {
    Ok(match kind {
        LoopKind::While(condition) => {
            let condition = expression(condition)?;
            quote!(While(#condition))
        }
        LoopKind::Forever => quote!(Forever),
        LoopKind::Range { variable, range } => {
            let variable = text(variable);
            let range = self::range(range)?;
            quote!(Range { variable: #variable, range: #range })
        }
        LoopKind::Elements { variable, array } => {
            let variable = text(variable);
            let array = expression(array)?;
            quote!(Elements { variable: #variable, array: #array })
        }
        LoopKind::Others { variable, reach, radius } => {
            let variable = text(variable);
            let reach = match reach {
                Reach::Cell => quote!(Cell),
                Reach::Neighbours => quote!(Neighbours),
                Reach::All => quote!(All),
            };
            let radius = optional(radius.as_ref(), expression)?;
            quote!(Others { variable: #variable, reach: ::xca_core::ir::Reach::#reach, radius: #radius })
        }
        LoopKind::Items { variable } => {
            let variable = text(variable);
            quote!(Items { variable: #variable })
        }
    })
}

fn range(range: &Range) -> Result<TokenStream> {
    let Range { from, to, inclusive, reversed, step } = range;
    let (from, to) = (expression(from)?, expression(to)?);
    let step = optional(step.as_ref(), expression)?;
    Ok(quote! {
        ::xca_core::ir::Range {
            from: #from,
            to: #to,
            inclusive: #inclusive,
            reversed: #reversed,
            step: #step,
        }
    })
}
