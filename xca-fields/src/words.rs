//! The words of types: which a field can have, and what they mean.

use proc_macro2::TokenStream;
use quote::quote;
use syn::{Error, GenericArgument, Ident, PathArguments, Result, Type};

/// The scalars that a field can hold.
const SCALARS: [&str; 7] = ["bool", "u8", "i32", "u32", "f32", "f64", "Real"];

/// Types that are no enum of states, whatever the user may think.
const OTHER_TYPES: [&str; 16] = [
    "usize", "isize", "i8", "i16", "i64", "i128", "u16", "u64", "u128", "char", "str", "String", "Vec",
    "Option", "Box", "HashMap",
];

/// Whether the word is a type of values, not a struct of the user.
pub fn is_value_type(word: &str) -> bool {
    SCALARS.contains(&word) || OTHER_TYPES.contains(&word) || VECTORS.contains(&word)
}

/// Whether the word may be the name of an enum of states.
pub fn may_be_states(word: &str) -> bool {
    !is_value_type(word)
}

const VECTORS: [&str; 3] = ["Vector2", "Vector3", "Vector4"];

/// Whether the words of a type are those of a substate or parameter. What they mean is proved by the code
/// that the derive writes.
pub fn check_type(type_: &Type) -> Result<()> {
    let type_ = bare(type_);
    if let Type::Array(array) = type_ {
        if let Type::Array(inner) = bare(&array.elem) {
            return Err(Error::new_spanned(
                inner,
                "an array has one index; multiply the lengths: `[Real; 3 * 4]`",
            ));
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
        PathArguments::AngleBracketed(arguments) if VECTORS.contains(&&*word) => {
            let Some(GenericArgument::Type(lane)) = arguments.args.first() else {
                return Err(unsupported());
            };
            let Type::Path(lane) = bare(lane) else { return Err(unsupported()) };
            let is_number = |lane: &Ident| lane != "bool" && SCALARS.iter().any(|scalar| lane == scalar);
            if lane.path.get_ident().is_some_and(is_number) { Ok(()) } else { Err(unsupported()) }
        }
        _ => Err(unsupported()),
    }
}

/// The type without parentheses, which are invisible around the `$type:ty` of a macro.
fn bare(type_: &Type) -> &Type {
    match type_ {
        Type::Group(group) => bare(&group.elem),
        Type::Paren(paren) => bare(&paren.elem),
        _ => type_,
    }
}

/// Whether a type is that of a position: `Vector3<Real>`.
pub fn is_position(type_: &Type) -> bool {
    let text = quote!(#type_).to_string().replace(' ', "");
    text.ends_with("Vector3<Real>")
}

/// The type with the word `Real` marked, by which `xca_core::field_type` knows all about it.
pub fn marked(type_: &Type) -> TokenStream {
    with_real(type_, &quote!(::xca_core::field_type::RealWord))
}

/// A type of the user with `Real` replaced by another type.
pub fn with_real(type_: &Type, real: &TokenStream) -> TokenStream {
    let mut type_ = type_.clone();
    syn::visit_mut::visit_type_mut(&mut ReplaceReal(real), &mut type_);
    ReplaceReal(real).replace(&mut type_);
    quote!(#type_)
}

/// The type that the words of a type mean, whatever they are aliases of.
pub fn meant(type_: &Type) -> TokenStream {
    match type_ {
        Type::Array(array) => {
            let (element, length) = (meant(&array.elem), &array.len);
            quote!([#element; #length])
        }
        Type::Tuple(tuple) => {
            let parts = tuple.elems.iter().map(meant);
            quote!((#(#parts,)*))
        }
        Type::Group(group) => meant(&group.elem),
        Type::Paren(paren) => meant(&paren.elem),
        Type::Path(path) => {
            let Some(last) = path.path.segments.last() else { return quote!(#type_) };
            let word = &last.ident;
            match &last.arguments {
                PathArguments::None if word == "Real" => quote!(f64),
                PathArguments::None if word == "usize" || SCALARS.iter().any(|scalar| word == scalar) => {
                    quote!(::core::primitive::#word)
                }
                PathArguments::AngleBracketed(arguments) if VECTORS.iter().any(|vector| word == vector) => {
                    let lanes = arguments.args.iter().map(|argument| match argument {
                        GenericArgument::Type(lane) => meant(lane),
                        other => quote!(#other),
                    });
                    quote!(::xca_core::#word<#(#lanes),*>)
                }
                _ => quote!(#type_),
            }
        }
        _ => quote!(#type_),
    }
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
