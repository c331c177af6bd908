//! `derive(Substates)` and `derive(Parameters)`: the fields of a struct.

mod parameters;
mod substates;

use crate::checked::{self, checked};
pub(crate) use parameters::parameters;
use proc_macro2::{Literal, TokenStream};
use quote::{quote, quote_spanned};
pub(crate) use substates::substates;
use syn::ext::IdentExt;
use syn::spanned::Spanned;
use syn::{Data, DeriveInput, Error, Fields, Ident, Result, Type, Visibility};
use xca_fields::{About, Wanted, check_type, is_position, marked};
pub(crate) use xca_fields::{is_value_type, may_be_states, meant, with_real};

/// A field of a struct that is derived from.
struct Field {
    name: Ident,
    visibility: Visibility,
    type_: Type,
    position: bool,
    documentation: Vec<syn::Attribute>,
    about: About,
}

/// The number by which the macros find a field of a struct that they cannot see: FNV-1a of its name.
pub(crate) fn name_number(name: &str) -> Literal {
    let hash = name.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    });
    Literal::u64_suffixed(hash)
}

/// The name under which the position is found.
pub(crate) const POSITION: &str = "#position";

fn fields(item: &DeriveInput, wanted: Wanted) -> Result<Vec<Field>> {
    if !item.generics.params.is_empty() {
        return Err(Error::new_spanned(
            &item.generics,
            "this struct cannot be generic; write `Real` for the floating type, which the run chooses",
        ));
    }
    let needed = "derive this for a struct with named fields: `struct Heat { temperature: Real }`";
    let Data::Struct(data) = &item.data else { return Err(Error::new_spanned(&item.ident, needed)) };
    let Fields::Named(named) = &data.fields else { return Err(Error::new_spanned(&item.ident, needed)) };
    let mut fields: Vec<Field> = Vec::new();
    for field in &named.named {
        let Some(name) = field.ident.clone() else { continue };
        let twin = fields.iter().find(|other| handle(&other.name) == handle(&name));
        if let Some(twin) = twin {
            let twin = &twin.name;
            return Err(Error::new_spanned(
                &name,
                format!("`{name}` and `{twin}` are one word in capitals; choose another name"),
            ));
        }
        check_type(&field.ty)?;
        let position = field.attrs.iter().any(|attribute| attribute.path().is_ident("position"));
        if position && !is_position(&field.ty) {
            return Err(Error::new_spanned(&field.ty, "a position is a `Vector3<Real>`"));
        }
        if let (true, Some(other)) = (position, fields.iter().find(|field| field.position)) {
            let other = &other.name;
            return Err(Error::new_spanned(
                &name,
                format!("`{other}` is the position already; there can be one only"),
            ));
        }
        let documentation =
            field.attrs.iter().filter(|attribute| attribute.path().is_ident("doc")).cloned().collect();
        fields.push(Field {
            name,
            visibility: field.vis.clone(),
            type_: field.ty.clone(),
            position,
            documentation,
            about: About::of(field, wanted)?,
        });
    }
    if fields.is_empty() {
        return Err(Error::new_spanned(&item.ident, needed));
    }
    Ok(fields)
}

/// The name in capitals, without `r#`.
fn handle(name: &Ident) -> String {
    name.unraw().to_string().to_uppercase()
}

/// A constant that has a value only where the types of all fields are what their words say: all else goes
/// through it, so that one mistake gives one message (`xca_core::checks`).
fn proof(fields: &[Field]) -> TokenStream {
    let name = checked::name();
    let proofs = fields.iter().map(|field| {
        let (type_, marked) = (&field.type_, marked(&field.type_));
        // The type has a name, so that a mistake is shown at the word and not at the type.
        let limited = field.about.limited_by().map(|word| {
            let proof =
                quote_spanned!(word.span()=> let () = <Limited as ::xca_core::field_type::Ranged>::RANGED;);
            quote!({ type Limited = #marked; #proof })
        });
        quote_spanned! {type_.span()=>
            let _: fn(#type_) -> <#marked as ::xca_core::field_type::FieldType>::Host = |value| value;
            #limited
        }
    });
    quote! {
        #[allow(clippy::type_complexity, clippy::items_after_statements)]
        const #name: bool = { #(#proofs)* true };
    }
}

/// `<T as FieldType>` of a field.
fn field_type(field: &Field) -> TokenStream {
    let checked = checked(&marked(&field.type_));
    quote!(<#checked as ::xca_core::field_type::FieldType>)
}

/// The value of a field, where the proof holds.
fn value(field: &Field) -> TokenStream {
    let name = &field.name;
    checked::checked_value(&quote!(self.#name))
}

fn schema(item: &DeriveInput, fields: &[Field]) -> TokenStream {
    let struct_name = item.ident.to_string();
    let descriptions = fields.iter().map(|field| {
        let (name, field_type) = (field.name.unraw().to_string(), field_type(field));
        let documentation = xca_fields::documentation(&field.documentation);
        let about = field.about.tokens();
        quote! {
            ::xca_core::Field { name: #name, value_type: #field_type::TYPE, documentation: #documentation, #about }
        }
    });
    let position = match fields.iter().position(|field| field.position) {
        Some(index) => quote!(::core::option::Option::Some(#index)),
        None => quote!(::core::option::Option::None),
    };
    let proof = proof(fields);
    quote! {
        #proof

        const __XCA_SCHEMA: &::xca_core::Schema = &::xca_core::Schema {
            name: #struct_name,
            fields: &[#(#descriptions),*],
            position: #position,
        };
    }
}
