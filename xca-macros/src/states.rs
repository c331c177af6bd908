//! `derive(States)`.

use proc_macro2::TokenStream;
use quote::quote;
use syn::ext::IdentExt;
use syn::{Data, DeriveInput, Error, Fields, Ident, Result};

/// A state is stored in a byte.
const MOST_STATES: usize = 256;

pub(crate) fn states(item: &DeriveInput) -> Result<TokenStream> {
    let needed = "derive this for an enum without fields: `enum Ground { Rock, Soil, Water }`";
    if !item.generics.params.is_empty() {
        return Err(Error::new_spanned(&item.generics, "an enum of states cannot be generic"));
    }
    let Data::Enum(data) = &item.data else { return Err(Error::new_spanned(&item.ident, needed)) };
    for variant in &data.variants {
        if !matches!(variant.fields, Fields::Unit) {
            return Err(Error::new_spanned(
                &variant.fields,
                "a state has no fields; what belongs to it is a substate of its own",
            ));
        }
        if let Some((_, number)) = &variant.discriminant {
            return Err(Error::new_spanned(
                number,
                "states are numbered in their order, from 0: leave out the number",
            ));
        }
    }
    let states: Vec<&Ident> = data.variants.iter().map(|variant| &variant.ident).collect();
    let Some(first) = states.first() else { return Err(Error::new_spanned(&item.ident, needed)) };
    if states.len() > MOST_STATES {
        let message = format!("an enum of states has at most {MOST_STATES} of them");
        return Err(Error::new_spanned(&item.ident, message));
    }
    let name = &item.ident;
    let text = name.unraw().to_string();
    let texts = states.iter().map(|state| state.unraw().to_string());
    let numbers = (0..states.len()).map(|number| number as u8);
    Ok(quote! {
        #[automatically_derived]
        impl ::xca_core::States for #name {
            const NAMES: &'static ::xca_core::StateNames =
                &::xca_core::StateNames { name: #text, states: &[#(#texts),*] };

            #[inline(always)]
            fn number(self) -> u8 {
                self as u8
            }

            #[inline(always)]
            fn from_number(number: u8) -> Self {
                match number {
                    #(#numbers => Self::#states,)*
                    #[allow(unreachable_patterns)]
                    _ => Self::#first,
                }
            }
        }
    })
}
