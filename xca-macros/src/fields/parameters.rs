//! `derive(Parameters)`.

use super::{field_type, fields, schema, value};
use crate::checked::checked;
use proc_macro2::{Span, TokenStream};
use quote::{format_ident, quote};
use syn::{DeriveInput, Error, Ident, Result};
use xca_fields::Wanted;

pub(crate) fn parameters(item: &DeriveInput) -> Result<TokenStream> {
    let fields = fields(item, Wanted::Parameter)?;
    if let Some(field) = fields.iter().find(|field| field.position) {
        return Err(Error::new_spanned(&field.name, "only a substate of items can be the position"));
    }
    let name = &item.ident;
    let schema = schema(item, &fields);
    let native_name = format_ident!("{}InKernel", name, span = Span::call_site());
    let names: Vec<&Ident> = fields.iter().map(|field| &field.name).collect();
    let field_types: Vec<TokenStream> = fields.iter().map(field_type).collect();
    let types = fields.iter().map(|field| checked(&field.type_));
    let values = fields.iter().map(value);
    let indices: Vec<usize> = (0..fields.len()).collect();
    Ok(quote! {
        #[allow(clippy::type_complexity)]
        const _: () = {
            #schema

            #[doc(hidden)]
            #[derive(Clone, Copy)]
            #[allow(dead_code, missing_debug_implementations)]
            pub struct #native_name<R: ::xca_core::Float> {
                #(pub #names: #field_types::Native<R>,)*
                __xca_real: ::core::marker::PhantomData<R>,
            }

            #[automatically_derived]
            #[diagnostic::do_not_recommend]
            impl ::xca_core::Parameters for #name {
                const SCHEMA: &'static ::xca_core::Schema = __XCA_SCHEMA;
                type Native<R: ::xca_core::Float> = #native_name<R>;

                fn native<R: ::xca_core::Float>(&self) -> #native_name<R> {
                    #native_name {
                        #(#names: #field_types::native::<R>(self.#names),)*
                        __xca_real: ::core::marker::PhantomData,
                    }
                }

                fn value(&self, field: usize) -> ::xca_core::ParameterValue {
                    let value_type = __XCA_SCHEMA.fields[field].value_type;
                    match field {
                        #(#indices => ::xca_core::ParameterValue::new(value_type, #values),)*
                        _ => ::xca_core::ParameterValue::new(value_type, 0.0),
                    }
                }

                fn set_value(&mut self, field: usize, value: &::xca_core::ParameterValue) {
                    match field {
                        #(#indices => self.#names = value.to::<#types>(),)*
                        _ => {}
                    }
                }
            }
        };
    })
}
