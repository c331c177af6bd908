//! Expressions in one precision.

use super::body::{Writer, own_name, read_name};
use super::{checked_value, hidden};
use crate::access::GroupOf;
use crate::ast::{Arm, Builtin, Expression, FunctionKind, Pattern};
use crate::fields::with_real;
use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote, quote_spanned};
use syn::spanned::Spanned;
use xca_methods::Meaning;

impl Writer<'_> {
    fn expressions(&mut self, expressions: &[Expression]) -> Vec<TokenStream> {
        expressions.iter().map(|expression| self.expression(expression)).collect()
    }

    pub(super) fn expression(&mut self, expression: &Expression) -> TokenStream {
        match expression {
            Expression::Bool(value) => quote!(#value),
            Expression::Integer(value) => quote!(#value),
            Expression::Float(value) => quote!(#value),
            Expression::Local(name) => quote!(#name),
            Expression::Constant(path) => {
                let (real, value) = (&self.real, checked_value(&quote!(#path)));
                quote!(::xca_core::kernel::constant::<#real, _>(#value))
            }
            Expression::Own(field) => {
                let own = own_name(field);
                quote!(#own)
            }
            Expression::CellOfItem(field) => {
                let (read, x) = (read_name(GroupOf::Companion, field), self.name("x"));
                quote!(#read.at(#x, 0))
            }
            Expression::Neighbour { index, field } => {
                let (read, x) = (read_name(GroupOf::Subject, field), self.name("x"));
                let offset = self.offset(index);
                quote!(#read.at(#x, #offset))
            }
            Expression::NamedNeighbour { name, field } => {
                let (read, x) = (read_name(GroupOf::Subject, field), self.name("x"));
                quote!(#read.at(#x, #name))
            }
            Expression::Other { name, field } => {
                let over_cells = self.function.kind == FunctionKind::Cells;
                let read = read_name(if over_cells { GroupOf::Companion } else { GroupOf::Subject }, field);
                quote!(#read[#name])
            }
            Expression::OtherLabel(name) => {
                let row = self.name("row");
                quote!(#row.label(#name))
            }
            Expression::Parameter(field) => {
                let parameters = hidden("parameters", field.span());
                quote!(#parameters.#field)
            }
            Expression::Parameters(span) => {
                let parameters = hidden("parameters", *span);
                quote!(#parameters)
            }
            Expression::Space(span) => {
                let space = hidden("space", *span);
                quote!(#space)
            }
            Expression::Builtin(builtin, arguments, span) => self.builtin(*builtin, arguments, *span),
            Expression::Unary(operator, value) => {
                let value = self.expression(value);
                quote!((#operator #value))
            }
            Expression::Binary(operator, left, right) => {
                let (left, right) = (self.expression(left), self.expression(right));
                quote!((#left #operator #right))
            }
            Expression::Cast(value, type_) => {
                let value = self.expression(value);
                let type_ = with_real(type_, &self.real);
                quote!((#value as #type_))
            }
            Expression::Call { function, constants, arguments } => {
                let arguments = self.expressions(arguments);
                let precision = &self.real;
                let native = format_ident!("native_{}", precision.to_string());
                quote!(#function::#native #constants (#(#arguments),*))
            }
            Expression::Method { method, name, receiver, arguments } => {
                let receiver = self.expression(receiver);
                let arguments = self.expressions(arguments);
                let function = match method.meaning {
                    Meaning::Operation(_) => super::operation(name),
                    Meaning::Function(function) => {
                        let function = Ident::new(function, name.span());
                        let native = format_ident!("native_{}", self.real.to_string());
                        quote_spanned!(name.span()=> ::xca_core::math::#function::#native)
                    }
                };
                quote!(#function(#receiver #(, #arguments)*))
            }
            Expression::Component(value, component) => {
                let value = self.expression(value);
                quote!(#value.#component)
            }
            Expression::Element(array, index) => {
                let index = self.expression(index);
                let array = match &**array {
                    // At the start of a statement the brackets would be a statement of their own.
                    block @ (Expression::If { .. } | Expression::Match { .. } | Expression::Block(_)) => {
                        let block = self.expression(block);
                        quote!((#block))
                    }
                    other => self.expression(other),
                };
                quote!(#array[#index])
            }
            Expression::Array(elements, span) => {
                let elements = self.expressions(elements);
                quote_spanned!(*span=> [#(#elements),*])
            }
            Expression::Tuple(parts, span) => {
                let parts = self.expressions(parts);
                quote_spanned!(*span=> (#(#parts),*))
            }
            Expression::Repeat(value, length) => {
                let check = (!self.function.constants.is_empty()).then(|| {
                    let bytes = crate::size::bytes(expression);
                    quote_spanned!(length.span()=> const { ::xca_core::checks::arrays_fit(#bytes) };)
                });
                let value = self.expression(value);
                quote!({ #check [#value; #length] })
            }
            Expression::Vector(type_, components) => {
                let components = self.expressions(components);
                quote!(::xca_core::#type_::new(#(#components),*))
            }
            Expression::Splat(type_, value) => {
                let value = self.expression(value);
                quote!(::xca_core::#type_::splat(#value))
            }
            Expression::If { condition, then, otherwise, span } => {
                let (condition, then) = (self.expression(condition), self.block(then));
                let otherwise = otherwise.as_ref().map(|otherwise| {
                    let otherwise = self.block(otherwise);
                    quote!(else #otherwise)
                });
                quote_spanned!(*span=> if #condition #then #otherwise)
            }
            Expression::Match { value, arms, span } => self.match_(value, arms, *span),
            Expression::Block(block) => self.block(block),
        }
    }

    fn match_(&mut self, value: &Expression, arms: &[Arm], span: Span) -> TokenStream {
        let value = self.expression(value);
        let arms: Vec<TokenStream> = arms
            .iter()
            .map(|arm| {
                let patterns = arm.patterns.iter().map(pattern);
                let guard = arm.guard.as_ref().map(|guard| {
                    let guard = self.expression(guard);
                    quote!(if #guard)
                });
                let body = self.block(&arm.body);
                quote!(#(#patterns)|* #guard => #body)
            })
            .collect();
        quote_spanned!(span=> match #value { #(#arms)* })
    }

    fn builtin(&mut self, builtin: Builtin, arguments: &[Expression], span: Span) -> TokenStream {
        let arguments = self.expressions(arguments);
        let [row, x, item, offsets, space] =
            ["row", "x", "item", "offsets", "space"].map(|name| self.name(name));
        let cells = self.function.kind == FunctionKind::Cells;
        let real = &self.real;
        match builtin {
            Builtin::Neighbours => quote!(#offsets.count()),
            Builtin::Index => quote!(#row.index(#x)),
            Builtin::Label => quote!(#row.label(#item)),
            Builtin::Random if cells => quote_spanned!(span=> #row.random::<#real>(#x, #(#arguments),*)),
            Builtin::Random => quote_spanned!(span=> #row.item_random::<#real>(#item, #(#arguments),*)),
            Builtin::RandomBits if cells => quote_spanned!(span=> #row.random_bits(#x, #(#arguments),*)),
            Builtin::RandomBits => quote_spanned!(span=> #row.item_random_bits(#item, #(#arguments),*)),
            Builtin::Side => quote!(#space.side()),
            Builtin::Extents => quote!(#space.extents()),
            Builtin::Step => quote!(#space.step()),
            Builtin::NearestImage => quote_spanned!(span=> #space.nearest_image(#(#arguments),*)),
            Builtin::Wrapped => quote_spanned!(span=> #space.wrapped(#(#arguments),*)),
            Builtin::CellContaining => quote_spanned!(span=> #space.cell_containing(#(#arguments),*)),
            Builtin::Stay => quote!(::xca_core::kernel::STAY),
            Builtin::Outside => quote!(::xca_core::kernel::OUTSIDE),
        }
    }
}

fn pattern(pattern: &Pattern) -> TokenStream {
    let signed = |literal: TokenStream, negative: bool| if negative { quote!(-#literal) } else { literal };
    match pattern {
        Pattern::Any(span) => quote_spanned!(*span=> _),
        Pattern::Literal(literal, negative) => signed(quote!(#literal), *negative),
        Pattern::Constant(path) => quote!(#path),
        Pattern::Range((from, from_negative), (to, to_negative)) => {
            let (from, to) = (signed(quote!(#from), *from_negative), signed(quote!(#to), *to_negative));
            quote!(#from..=#to)
        }
    }
}
