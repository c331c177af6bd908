//! The words of a process: types, literals, operators, methods.

use crate::ast::Builtin;
use proc_macro2::{Span, TokenStream};
use quote::quote;
use syn::ext::IdentExt;
use syn::spanned::Spanned;
use syn::{BinOp, Error, Expr, GenericArgument, Ident, LitFloat, LitInt, PathArguments, Result, Type, UnOp};

/// The types that a process can use, for messages.
const SUPPORTED: &str = "a process can use bool, u8, i32, u32, f32, f64, Real, \
                         Vector2, Vector3 and Vector4 of a number, enums that derive `States`, arrays [T; N] and \
                         tuples of these, and usize as an index";

/// A name without `r#`.
pub(super) fn text(name: &Ident) -> String {
    name.unraw().to_string()
}

/// `::std::vec![…]` of what the closure makes of each.
pub(super) fn each<T>(items: &[T], mut make: impl FnMut(&T) -> Result<TokenStream>) -> Result<TokenStream> {
    let made = items.iter().map(&mut make).collect::<Result<Vec<_>>>()?;
    Ok(quote!(::std::vec![#(#made),*]))
}

/// `Some(…)` of what the closure makes, or `None`.
pub(super) fn optional<T>(
    item: Option<T>,
    make: impl FnOnce(T) -> Result<TokenStream>,
) -> Result<TokenStream> {
    Ok(match item.map(make).transpose()? {
        Some(made) => quote!(::core::option::Option::Some(#made)),
        None => quote!(::core::option::Option::None),
    })
}

pub(super) fn bool_literal(literal: &syn::LitBool) -> TokenStream {
    let value = literal.value;
    quote!(::xca_core::ir::Literal::Bool(#value))
}

pub(super) fn integer_literal(literal: &LitInt) -> Result<TokenStream> {
    let suffix = suffix(literal.suffix(), literal.span())?;
    if let "f32" | "f64" = literal.suffix() {
        let digits = literal.base10_digits();
        return Ok(quote!(::xca_core::ir::Literal::Float(#digits, #suffix)));
    }
    let value = literal.base10_parse::<u64>()?;
    Ok(quote!(::xca_core::ir::Literal::Integer(#value, #suffix)))
}

pub(super) fn float_literal(literal: &LitFloat) -> Result<TokenStream> {
    let digits = literal.base10_digits();
    let suffix = suffix(literal.suffix(), literal.span())?;
    Ok(quote!(::xca_core::ir::Literal::Float(#digits, #suffix)))
}

fn suffix(suffix: &str, span: Span) -> Result<TokenStream> {
    if suffix.is_empty() {
        return Ok(quote!(::core::option::Option::None));
    }
    let scalar = scalar(suffix).ok_or_else(|| {
        Error::new(
            span,
            format!("numbers of a process are u8, i32, u32, usize, f32 or f64; `{suffix}` is none of these"),
        )
    })?;
    Ok(quote!(::core::option::Option::Some(#scalar)))
}

fn scalar(name: &str) -> Option<TokenStream> {
    let variant = match name {
        "u8" => quote!(U8),
        "i32" => quote!(I32),
        // An index; numbers of elements fit into 32 bits on every engine.
        "u32" | "usize" => quote!(U32),
        "f32" => quote!(F32),
        "f64" => quote!(F64),
        "Real" => quote!(Real),
        _ => return None,
    };
    Some(quote!(::xca_core::ScalarType::#variant))
}

/// A type as the user wrote it.
pub(super) fn type_(written: &Type) -> Result<TokenStream> {
    match written {
        Type::Group(inner) => type_(&inner.elem),
        Type::Paren(inner) => type_(&inner.elem),
        Type::Array(array) => {
            let element = type_(&array.elem)?;
            let length = known_length(&array.len);
            Ok(quote!(::xca_core::ir::Type::Array(::std::boxed::Box::new(#element), #length)))
        }
        Type::Tuple(tuple) if tuple.elems.len() > 1 => {
            let parts = tuple.elems.iter().map(type_).collect::<Result<Vec<_>>>()?;
            Ok(quote!(::xca_core::ir::Type::Tuple(::std::vec![#(#parts),*])))
        }
        Type::Path(path) if path.qself.is_none() => match path.path.segments.last() {
            Some(last) => named_type(written, &last.ident, &last.arguments),
            None => Err(unsupported(written)),
        },
        _ => Err(unsupported(written)),
    }
}

/// The length of an array.
pub(super) fn known_length(length: &Expr) -> TokenStream {
    match length {
        Expr::Lit(literal) => quote!(#literal),
        // Where it is no `usize`, the check of the function says so.
        other => crate::checked::checked_value(&quote!(#other)),
    }
}

fn named_type(written: &Type, name: &Ident, arguments: &PathArguments) -> Result<TokenStream> {
    let text = name.to_string();
    let PathArguments::AngleBracketed(arguments) = arguments else {
        if let Some(scalar) = scalar(&text) {
            return Ok(quote!(::xca_core::ir::Type::Scalar(#scalar)));
        }
        return match text.as_str() {
            "bool" => Ok(quote!(::xca_core::ir::Type::Bool)),
            "Destination" => Ok(quote!(::xca_core::ir::Type::Destination)),
            word if crate::fields::may_be_states(word) => {
                let states = crate::checked::checked(written);
                Ok(quote!(::xca_core::ir::Type::State(<#states as ::xca_core::States>::NAMES)))
            }
            _ => Err(unsupported(written)),
        };
    };
    let lanes = lanes(name).map_err(|_| unsupported(written))?;
    let [GenericArgument::Type(Type::Path(component))] = &arguments.args.iter().collect::<Vec<_>>()[..]
    else {
        return Err(unsupported(written));
    };
    let scalar = component.path.segments.last().and_then(|last| scalar(&last.ident.to_string()));
    match scalar {
        Some(scalar) => Ok(quote!(::xca_core::ir::Type::Vector(#scalar, #lanes))),
        None => Err(unsupported(written)),
    }
}

fn unsupported(written: &Type) -> Error {
    let name = quote!(#written).to_string().replace(' ', "");
    Error::new(written.span(), format!("`{name}` cannot be used here: {SUPPORTED}"))
}

/// The number of lanes of `Vector2`, `Vector3`, `Vector4`.
pub(super) fn lanes(name: &Ident) -> Result<u8> {
    match name.to_string().as_str() {
        "Vector2" => Ok(2),
        "Vector3" => Ok(3),
        "Vector4" => Ok(4),
        other => {
            Err(Error::new(name.span(), format!("`{other}` is no vector: use Vector2, Vector3 or Vector4")))
        }
    }
}

/// The number of the lane that a component names.
pub(super) fn lane(name: &Ident) -> Result<u8> {
    match name.to_string().as_str() {
        "x" => Ok(0),
        "y" => Ok(1),
        "z" => Ok(2),
        "w" => Ok(3),
        other => {
            Err(Error::new(name.span(), format!("a vector has the components x, y, z and w, not `{other}`")))
        }
    }
}

pub(super) fn builtin(builtin: Builtin) -> TokenStream {
    match builtin {
        Builtin::NeighbourCount => quote!(NeighbourCount),
        Builtin::Opposite => quote!(Opposite),
        Builtin::Displacement => quote!(Displacement),
        Builtin::Exists => quote!(Exists),
        Builtin::Index => quote!(Index),
        Builtin::Label => quote!(Label),
        Builtin::Random => quote!(Random),
        Builtin::RandomBits => quote!(RandomBits),
        Builtin::Side => quote!(Side),
        Builtin::Extents => quote!(Extents),
        Builtin::Step => quote!(Step),
        Builtin::NearestImage => quote!(NearestImage),
        Builtin::Wrapped => quote!(Wrapped),
        Builtin::CellContaining => quote!(CellContaining),
        Builtin::Stay => quote!(Stay),
        Builtin::Outside => quote!(Outside),
    }
}

pub(super) fn unary_operator(operator: &UnOp) -> Result<TokenStream> {
    let variant = match operator {
        UnOp::Neg(_) => quote!(Negate),
        UnOp::Not(_) => quote!(Not),
        other => {
            return Err(Error::new(
                other.span(),
                "this operator cannot be used in a process; use `-` or `!`",
            ));
        }
    };
    Ok(quote!(::xca_core::ir::UnaryOperator::#variant))
}

/// An operator, whether it stands alone or in a compound assignment.
pub(super) fn binary_operator(operator: &BinOp, span: Span) -> Result<TokenStream> {
    let variant = match operator {
        BinOp::Add(_) | BinOp::AddAssign(_) => quote!(Add),
        BinOp::Sub(_) | BinOp::SubAssign(_) => quote!(Subtract),
        BinOp::Mul(_) | BinOp::MulAssign(_) => quote!(Multiply),
        BinOp::Div(_) | BinOp::DivAssign(_) => quote!(Divide),
        BinOp::Rem(_) | BinOp::RemAssign(_) => quote!(Remainder),
        BinOp::And(_) => quote!(And),
        BinOp::Or(_) => quote!(Or),
        BinOp::BitAnd(_) | BinOp::BitAndAssign(_) => quote!(BitAnd),
        BinOp::BitOr(_) | BinOp::BitOrAssign(_) => quote!(BitOr),
        BinOp::BitXor(_) | BinOp::BitXorAssign(_) => quote!(BitXor),
        BinOp::Shl(_) | BinOp::ShlAssign(_) => quote!(ShiftLeft),
        BinOp::Shr(_) | BinOp::ShrAssign(_) => quote!(ShiftRight),
        BinOp::Eq(_) => quote!(Equal),
        BinOp::Ne(_) => quote!(NotEqual),
        BinOp::Lt(_) => quote!(Less),
        BinOp::Le(_) => quote!(LessEqual),
        BinOp::Gt(_) => quote!(Greater),
        BinOp::Ge(_) => quote!(GreaterEqual),
        _ => return Err(Error::new(span, "this operator cannot be used in a process")),
    };
    Ok(quote!(::xca_core::ir::BinaryOperator::#variant))
}
