//! `derive(Substates)`.

use super::{POSITION, field_type, fields, handle, name_number, schema, value};
use crate::checked::checked;
use proc_macro2::TokenStream;
use quote::{format_ident, quote};
use syn::ext::IdentExt;
use syn::{DeriveInput, Ident, Result};
use xca_fields::Wanted;

pub(crate) fn substates(item: &DeriveInput) -> Result<TokenStream> {
    let fields = fields(item, Wanted::Substate)?;
    let name = &item.ident;
    let schema = schema(item, &fields);
    let mut named = TokenStream::new();
    let mut handles = TokenStream::new();
    for (index, field) in fields.iter().enumerate() {
        let field_type = field_type(field);
        let mut names = vec![field.name.unraw().to_string()];
        if field.position {
            names.push(POSITION.to_owned());
        }
        for key in names {
            let number = name_number(&key);
            named.extend(quote! {
                #[automatically_derived]
                impl ::xca_core::HasSubstate<#number> for #name {
                    type Native<R: ::xca_core::Float> = #field_type::Native<R>;
                    const INDEX: usize = #index;
                }
            });
        }
        let handle = format_ident!("{}", handle(&field.name), span = field.name.span());
        let (visibility, documentation) = (&field.visibility, &field.documentation);
        let type_ = checked(&field.type_);
        let about = format!("The name of the substate `{}` for the host.", field.name.unraw());
        let about =
            if documentation.is_empty() { quote!(#[doc = #about]) } else { quote!(#(#documentation)*) };
        handles.extend(quote! {
            #about
            #[allow(dead_code, clippy::type_complexity)]
            #visibility const #handle: ::xca_core::Substate<#name, #type_> = ::xca_core::Substate::from_index(#index);
        });
    }
    let position = fields
        .iter()
        .any(|field| field.position)
        .then(|| quote!(#[automatically_derived] impl ::xca_core::checks::HasPosition for #name {}));
    let indices: Vec<usize> = (0..fields.len()).collect();
    let names: Vec<&Ident> = fields.iter().map(|field| &field.name).collect();
    let values = fields.iter().map(value);
    let types = fields.iter().map(|field| checked(&field.type_));
    Ok(quote! {
        #[allow(clippy::type_complexity)]
        const _: () = {
            #schema

            impl #name {
                #handles
            }

            #named
            #position

            #[automatically_derived]
            #[diagnostic::do_not_recommend]
            impl ::xca_core::Substates for #name {
                const SCHEMA: &'static ::xca_core::Schema = __XCA_SCHEMA;

                fn encode(&self, field: usize, precision: ::xca_core::Precision, out: &mut [u8]) {
                    let stored = __XCA_SCHEMA.fields[field].value_type.stored(precision);
                    match field {
                        #(#indices => ::xca_core::HostValue::encode(&#values, stored, out),)*
                        _ => {}
                    }
                }

                fn decode<'a>(precision: ::xca_core::Precision, mut field: impl FnMut(usize) -> &'a [u8]) -> Self {
                    let stored = |index: usize| __XCA_SCHEMA.fields[index].value_type.stored(precision);
                    Self { #(#names: <#types as ::xca_core::HostValue>::decode(stored(#indices), field(#indices)),)* }
                }
            }
        };
    })
}
