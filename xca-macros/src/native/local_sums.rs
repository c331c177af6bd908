//! Local variables to which the loops at the beginning of a body only add. A kernel keeps their values for
//! all items of a row.

use super::body::Writer;
use super::names::hidden;
use super::work::{Argument, LIFE, Typed};
use crate::ast::{Expression, Statement};
use crate::fields::with_real;
use proc_macro2::{Ident, TokenStream};
use quote::{ToTokens, quote};
use syn::Type;
use syn::ext::IdentExt;

/// A local variable that begins with a literal.
#[derive(Clone, Copy)]
pub(super) struct LocalSum<'a> {
    pub(super) name: &'a Ident,
    /// Its declaration.
    pub(super) statement: &'a Statement,
    value: &'a Expression,
    type_: SumType<'a>,
}

/// The type of a sum.
#[derive(Clone, Copy)]
enum SumType<'a> {
    Real,
    VectorOfReal,
    Declared(&'a Type),
}

impl<'a> LocalSum<'a> {
    /// `None` if the type is not known from the declaration, or if a known variable has the same name.
    pub(super) fn of(statement: &'a Statement, known: &[LocalSum<'_>]) -> Option<Self> {
        let Statement::Let { name, mutable: true, type_, value } = statement else { return None };
        let is_new = known.iter().all(|known| known.name != name);
        let type_ = match (type_, value) {
            (Some(type_), value) if has_sums(type_) && is_literal(value) => SumType::Declared(type_),
            (None, Expression::Float(_)) => SumType::Real,
            (None, Expression::Splat(type_, value)) if type_ == "Vector3" && is_float(value) => {
                SumType::VectorOfReal
            }
            (None, Expression::Vector(type_, parts)) if type_ == "Vector3" && parts.iter().all(is_float) => {
                SumType::VectorOfReal
            }
            _ => return None,
        };
        is_new.then_some(Self { name, statement, value, type_ })
    }

    pub(super) fn native_type(&self, real: &TokenStream) -> TokenStream {
        match self.type_ {
            SumType::Real => real.clone(),
            SumType::VectorOfReal => quote!(::xca_core::Vector3<#real>),
            SumType::Declared(type_) => with_real(type_, real).to_token_stream(),
        }
    }

    /// The variable with the values of all items of a row.
    pub(super) fn values(&self) -> Ident {
        hidden(&format!("sums_{}", self.name.unraw()), self.name.span())
    }

    /// Makes room for these values.
    pub(super) fn room(&self, writer: &mut Writer<'_>) -> TokenStream {
        let (values, type_) = (self.values(), self.native_type(&writer.real));
        let (value, count) = (writer.expression(self.value), writer.name("count"));
        quote!(let mut #values = ::std::vec![::xca_core::kernel::store::<#type_>(#value); #count];)
    }

    /// Takes the value of an item.
    pub(super) fn load(&self, writer: &Writer<'_>) -> TokenStream {
        let (values, type_) = (self.values(), self.native_type(&writer.real));
        let (name, number) = (self.name, writer.name("number"));
        quote!(let mut #name = ::xca_core::kernel::load::<#type_>(#values[#number]);)
    }

    /// The values as an argument of a kernel's work.
    pub(super) fn argument(&self, real: &TokenStream) -> Argument {
        let (name, type_) = (self.values(), self.native_type(real));
        let type_ = quote!(&#LIFE mut [<#type_ as ::xca_core::kernel::KernelValue>::Memory]);
        let value = quote!(&mut *#name);
        Argument { name, written: true, row: Typed { type_, value }, block: None }
    }
}

/// Whether numbers of this type can be added.
fn has_sums(type_: &Type) -> bool {
    let type_ = type_.to_token_stream().to_string().replace(' ', "");
    ["Real", "u32", "i32", "Vector3<Real>"].contains(&type_.as_str())
}

fn is_float(value: &Expression) -> bool {
    matches!(value, Expression::Float(_))
}

fn is_literal(value: &Expression) -> bool {
    match value {
        Expression::Float(_) | Expression::Integer(_) => true,
        Expression::Splat(_, value) => is_literal(value),
        Expression::Vector(_, parts) => parts.iter().all(is_literal),
        _ => false,
    }
}
