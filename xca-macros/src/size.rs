//! What arrays take, roughly: eight bytes for each number.

use crate::ast::Expression;
use proc_macro2::TokenStream;
use quote::quote;

/// The bytes of a value, as an expression of type `usize`.
pub(crate) fn bytes(value: &Expression) -> TokenStream {
    match value {
        Expression::Repeat(element, length) => {
            let element = bytes(element);
            quote!((#length) * (#element))
        }
        Expression::Array(parts, _) | Expression::Tuple(parts, _) | Expression::Vector(_, parts) => {
            let parts = parts.iter().map(bytes);
            quote!(0 #(+ #parts)*)
        }
        Expression::Splat(type_, _) => {
            let lanes: usize = match type_.to_string().as_str() {
                "Vector2" => 2,
                "Vector3" => 3,
                _ => 4,
            };
            quote!(8 * #lanes)
        }
        _ => quote!(8),
    }
}
