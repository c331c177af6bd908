//! The constants that a function is generic in.

use crate::ast::Function;
use proc_macro2::TokenStream;
use quote::quote;

/// The constants that a function is generic in.
pub(super) struct Generics {
    /// `<const N: usize>`
    pub(super) declared: TokenStream,
    /// `<N>`
    pub(super) given: TokenStream,
}

impl Generics {
    pub(super) fn of(function: &Function) -> Self {
        if function.constants.is_empty() {
            return Self { declared: TokenStream::new(), given: TokenStream::new() };
        }
        let (constants, names) =
            (&function.constants, function.constants.iter().map(|constant| &constant.ident));
        Self { declared: quote!(<#(#constants),*>), given: quote!(<#(#names),*>) }
    }
}
