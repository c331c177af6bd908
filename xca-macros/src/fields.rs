//! `derive(Substates)` and `derive(Parameters)`.

use proc_macro2::{Literal, Span, TokenStream};
use quote::{format_ident, quote, quote_spanned};
use syn::ext::IdentExt;
use syn::spanned::Spanned;
use syn::{
    Data, DeriveInput, Error, Fields, GenericArgument, Ident, PathArguments, Result, Type, Visibility,
};

struct Field {
    name: Ident,
    visibility: Visibility,
    type_: Type,
    position: bool,
    documentation: Vec<syn::Attribute>,
}

/// The scalars that a field can hold.
const SCALARS: [&str; 7] = ["bool", "u8", "i32", "u32", "f32", "f64", "Real"];

/// Types that are no enum of states, whatever the user may think.
const OTHER_TYPES: [&str; 16] = [
    "usize", "isize", "i8", "i16", "i64", "i128", "u16", "u64", "u128", "char", "str", "String", "Vec", "Option",
    "Box", "HashMap",
];

/// The number by which the macros find a field of a struct that they cannot see: FNV-1a of its name.
pub(crate) fn name_number(name: &str) -> Literal {
    let hash = name.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    });
    Literal::u64_suffixed(hash)
}

/// Whether the word is a type of values, not a struct of the user.
pub(crate) fn is_value_type(word: &str) -> bool {
    SCALARS.contains(&word) || OTHER_TYPES.contains(&word) || VECTORS.contains(&word)
}

/// Whether the word may be the name of an enum of states.
pub(crate) fn may_be_states(word: &str) -> bool {
    !is_value_type(word)
}

const VECTORS: [&str; 3] = ["Vector2", "Vector3", "Vector4"];

/// The name under which the position is found.
pub(crate) const POSITION: &str = "#position";

fn fields(item: &DeriveInput) -> Result<Vec<Field>> {
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

/// Whether the words of a type are those of a substate or parameter. What they mean is proved by the code that the derive writes.
fn check_type(type_: &Type) -> Result<()> {
    if let Type::Array(array) = type_ {
        if let Type::Array(inner) = &*array.elem {
            return Err(Error::new_spanned(inner, "an array has one index; multiply the lengths: `[Real; 3 * 4]`"));
        }
        return check_type(&array.elem);
    }
    let unsupported = || {
        Error::new_spanned(
            type_,
            "a substate or parameter is a bool, u8, i32, u32, f32, f64, Real, a Vector2, Vector3, Vector4 of a number, an enum \
             that derives `States`, or an array of these",
        )
    };
    let Type::Path(path) = type_ else { return Err(unsupported()) };
    let segment = path.path.segments.last().ok_or_else(unsupported)?;
    let word = segment.ident.to_string();
    match &segment.arguments {
        PathArguments::None if SCALARS.contains(&&*word) || may_be_states(&word) => Ok(()),
        PathArguments::AngleBracketed(arguments) if VECTORS.contains(&&*word) => match arguments.args.first() {
            Some(GenericArgument::Type(Type::Path(lane)))
                if lane
                    .path
                    .get_ident()
                    .is_some_and(|lane| lane != "bool" && SCALARS.iter().any(|scalar| lane == scalar)) =>
            {
                Ok(())
            }
            _ => Err(unsupported()),
        },
        _ => Err(unsupported()),
    }
}

fn is_position(type_: &Type) -> bool {
    let text = quote!(#type_).to_string().replace(' ', "");
    text.ends_with("Vector3<Real>")
}

/// The type with the word `Real` marked, by which `xca_core::field_type` knows all about it.
fn marked(type_: &Type) -> TokenStream {
    with_real(type_, &quote!(::xca_core::field_type::RealWord))
}

/// Fails to compile where the words of a type mean something else than they should.
fn proof(field: &Field) -> TokenStream {
    let (type_, marked) = (&field.type_, marked(&field.type_));
    quote_spanned!(type_.span()=> const _: fn(#type_) -> <#marked as ::xca_core::field_type::FieldType>::Host = |value| value;)
}

fn schema(item: &DeriveInput, fields: &[Field]) -> TokenStream {
    let struct_name = item.ident.to_string();
    let descriptions = fields.iter().map(|field| {
        let (name, marked) = (field.name.unraw().to_string(), marked(&field.type_));
        quote! {
            ::xca_core::Field {
                name: #name,
                value_type: <#marked as ::xca_core::field_type::FieldType>::TYPE,
            }
        }
    });
    let position = match fields.iter().position(|field| field.position) {
        Some(index) => quote!(::core::option::Option::Some(#index)),
        None => quote!(::core::option::Option::None),
    };
    let proofs = fields.iter().map(proof);
    quote! {
        #(#proofs)*

        const __XCA_SCHEMA: &::xca_core::Schema = &::xca_core::Schema {
            name: #struct_name,
            fields: &[#(#descriptions),*],
            position: #position,
        };
    }
}

/// A type of the user with `Real` replaced by another type.
pub(crate) fn with_real(type_: &Type, real: &TokenStream) -> TokenStream {
    let mut type_ = type_.clone();
    syn::visit_mut::visit_type_mut(&mut ReplaceReal(real), &mut type_);
    ReplaceReal(real).replace(&mut type_);
    quote!(#type_)
}

struct ReplaceReal<'a>(&'a TokenStream);

impl ReplaceReal<'_> {
    fn replace(&self, type_: &mut Type) {
        if let Type::Path(path) = type_
            && path.path.segments.last().is_some_and(|last| last.ident == "Real")
        {
            *type_ = Type::Verbatim(self.0.clone());
        }
    }
}

impl syn::visit_mut::VisitMut for ReplaceReal<'_> {
    fn visit_type_mut(&mut self, type_: &mut Type) {
        syn::visit_mut::visit_type_mut(self, type_);
        self.replace(type_);
    }
}

pub(crate) fn substates(item: &DeriveInput) -> Result<TokenStream> {
    let fields = fields(item)?;
    let name = &item.ident;
    let schema = schema(item, &fields);
    let mut named = TokenStream::new();
    let mut handles = TokenStream::new();
    for (index, field) in fields.iter().enumerate() {
        let marked = marked(&field.type_);
        let mut names = vec![field.name.unraw().to_string()];
        if field.position {
            names.push(POSITION.to_owned());
        }
        for key in names {
            let number = name_number(&key);
            named.extend(quote! {
                #[automatically_derived]
                impl ::xca_core::HasSubstate<#number> for #name {
                    type Native<R: ::xca_core::Float> = <#marked as ::xca_core::field_type::FieldType>::Native<R>;
                    const INDEX: usize = #index;
                }
            });
        }
        let handle = format_ident!("{}", handle(&field.name), span = field.name.span());
        let (visibility, type_, documentation) = (&field.visibility, &field.type_, &field.documentation);
        let about = format!("The name of the substate `{}` for the host.", field.name.unraw());
        let about =
            if documentation.is_empty() { quote!(#[doc = #about]) } else { quote!(#(#documentation)*) };
        handles.extend(quote! {
            #about
            #[allow(dead_code)]
            #visibility const #handle: ::xca_core::Substate<#name, #type_> = ::xca_core::Substate::from_index(#index);
        });
    }
    let position = fields
        .iter()
        .any(|field| field.position)
        .then(|| quote!(#[automatically_derived] impl ::xca_core::checks::HasPosition for #name {}));
    let indices: Vec<usize> = (0..fields.len()).collect();
    let names: Vec<&Ident> = fields.iter().map(|field| &field.name).collect();
    Ok(quote! {
        impl #name {
            #handles
        }

        const _: () = {
            #schema
            #named
            #position

            #[automatically_derived]
            #[diagnostic::do_not_recommend]
            impl ::xca_core::Substates for #name {
                const SCHEMA: &'static ::xca_core::Schema = __XCA_SCHEMA;

                fn encode(&self, field: usize, precision: ::xca_core::Precision, out: &mut [u8]) {
                    let stored = __XCA_SCHEMA.fields[field].value_type.stored(precision);
                    match field {
                        #(#indices => ::xca_core::HostValue::encode(&self.#names, stored, out),)*
                        _ => {}
                    }
                }

                fn decode<'a>(precision: ::xca_core::Precision, mut field: impl FnMut(usize) -> &'a [u8]) -> Self {
                    let stored = |index: usize| __XCA_SCHEMA.fields[index].value_type.stored(precision);
                    Self { #(#names: ::xca_core::HostValue::decode(stored(#indices), field(#indices)),)* }
                }
            }
        };
    })
}

pub(crate) fn parameters(item: &DeriveInput) -> Result<TokenStream> {
    let fields = fields(item)?;
    if let Some(field) = fields.iter().find(|field| field.position) {
        return Err(Error::new_spanned(&field.name, "only a substate of items can be the position"));
    }
    let name = &item.ident;
    let schema = schema(item, &fields);
    let native_name = format_ident!("{}InKernel", name, span = Span::call_site());
    let names: Vec<&Ident> = fields.iter().map(|field| &field.name).collect();
    let marked: Vec<TokenStream> = fields.iter().map(|field| marked(&field.type_)).collect();
    let indices: Vec<usize> = (0..fields.len()).collect();
    Ok(quote! {
        const _: () = {
            #[doc(hidden)]
            #[derive(Clone, Copy)]
            #[allow(dead_code, missing_debug_implementations)]
            pub struct #native_name<R: ::xca_core::Float> {
                #(pub #names: <#marked as ::xca_core::field_type::FieldType>::Native<R>,)*
                __xca_real: ::core::marker::PhantomData<R>,
            }

            #schema

            #[automatically_derived]
            #[diagnostic::do_not_recommend]
            impl ::xca_core::Parameters for #name {
                const SCHEMA: &'static ::xca_core::Schema = __XCA_SCHEMA;
                type Native<R: ::xca_core::Float> = #native_name<R>;

                fn native<R: ::xca_core::Float>(&self) -> #native_name<R> {
                    #native_name {
                        #(#names: <#marked as ::xca_core::field_type::FieldType>::native::<R>(self.#names),)*
                        __xca_real: ::core::marker::PhantomData,
                    }
                }

                fn value(&self, field: usize) -> ::xca_core::ParameterValue {
                    let value_type = __XCA_SCHEMA.fields[field].value_type;
                    match field {
                        #(#indices => ::xca_core::ParameterValue::new(value_type, self.#names),)*
                        _ => ::xca_core::ParameterValue::new(value_type, 0.0),
                    }
                }

                fn set_value(&mut self, field: usize, value: &::xca_core::ParameterValue) {
                    match field {
                        #(#indices => self.#names = value.to(),)*
                        _ => {}
                    }
                }
            }
        };
    })
}
