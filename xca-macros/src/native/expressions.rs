//! Expressions in one precision.

use super::body::Writer;
use super::names::{hidden, other_name, own_name, read_name};
use super::types::{native_type, operation};
use crate::access::GroupOf;
use crate::ast::{ArgumentNumber, Arm, Builtin, Expression, FunctionKind, Pattern};
use crate::checked::checked_value;
use crate::fields::with_real;
use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote, quote_spanned};
use syn::BinOp;
use syn::spanned::Spanned;
use xca_methods::Meaning;

/// What only some cells compute.
#[derive(Default)]
struct Branch {
    code: TokenStream,
    /// Whether it draws a random number.
    draws: bool,
}

impl Branch {
    /// The block beside another one.
    fn beside(&self, other: &Self) -> TokenStream {
        let (code, rare) = (&self.code, rare());
        if other.draws && !self.draws { quote!({ #rare #code }) } else { code.clone() }
    }
}

/// The mark of a branch without a draw beside one with a draw. Compilers take both for equally frequent, and
/// would not vectorise the loop, as if only few cells computed the numbers.
fn rare() -> TokenStream {
    quote!(::core::hint::cold_path();)
}

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
            Expression::OfCell { argument, field } => {
                let (read, column) = (self.read_of(*argument, field), self.name("column"));
                quote!(#read.here(#column))
            }
            Expression::Neighbour { argument, index, field } => {
                let (read, column) = (self.read_of(*argument, field), self.name("column"));
                let offset = self.offset(index);
                quote!(#read.at(#column, #offset))
            }
            Expression::NamedNeighbour { argument, name, field } => {
                let (read, column) = (self.read_of(*argument, field), self.name("column"));
                quote!(#read.at(#column, #name))
            }
            Expression::Other { argument, field, .. } if self.others_in_lanes => {
                let other = other_name(GroupOf::Argument(*argument), field);
                quote!(#other)
            }
            Expression::Other { argument, name, field } => {
                let (read, type_) = (self.read_of(*argument, field), self.type_of(*argument, field));
                quote!(::xca_core::kernel::load::<#type_>(#read[#name]))
            }
            Expression::OtherLabel(name) => {
                let row = self.name("row");
                quote!(#row.label(#name))
            }
            Expression::Parameter { argument, field } => quote!(#argument.#field),
            Expression::Parameters(argument) => quote!(#argument),
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
                let left = self.expression(left);
                let Branch { code: right, draws } = self.branch(|writer| writer.expression(right));
                let rare = rare();
                match operator {
                    BinOp::And(_) if draws => quote!((if #left { #right } else { #rare false })),
                    BinOp::Or(_) if draws => quote!((if #left { #rare true } else { #right })),
                    _ => quote!((#left #operator #right)),
                }
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
                    Meaning::Operation(_) => operation(name),
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
            Expression::Element(array, index) => self.element(array, index),
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
                let condition = self.expression(condition);
                let then = self.branch(|writer| writer.block(then));
                let otherwise =
                    otherwise.as_ref().map(|otherwise| self.branch(|writer| writer.block(otherwise)));
                let otherwise = otherwise.unwrap_or_default();
                let [then, otherwise] = [then.beside(&otherwise), otherwise.beside(&then)];
                let otherwise = (!otherwise.is_empty()).then(|| quote!(else #otherwise));
                quote_spanned!(*span=> if #condition #then #otherwise)
            }
            Expression::Match { value, arms, span } => self.match_(value, arms, *span),
            Expression::Block(block) => self.block(block),
        }
    }

    /// Writes what only some cells compute.
    fn branch(&mut self, write: impl FnOnce(&mut Self) -> TokenStream) -> Branch {
        let draws = self.draws;
        let code = write(self);
        Branch { code, draws: self.draws > draws }
    }

    /// What a substate of a struct is read from.
    fn read_of(&self, argument: ArgumentNumber, field: &Ident) -> Ident {
        read_name(GroupOf::Argument(argument), field)
    }

    fn type_of(&self, argument: ArgumentNumber, field: &Ident) -> TokenStream {
        native_type(GroupOf::Argument(argument), field, self.function, &self.real)
    }

    /// An element of the value in the cell itself.
    fn element_here(&mut self, argument: ArgumentNumber, field: &Ident, index: &Expression) -> TokenStream {
        let (read, column) = (self.read_of(argument, field), self.name("column"));
        let index = self.expression(index);
        quote!(#read.element_here(#column, #index))
    }

    /// An element of an array: of one that stands in memory, without loading the others.
    fn element(&mut self, array: &Expression, index: &Expression) -> TokenStream {
        let column = self.name("column");
        match array {
            Expression::Own(field)
                if self.function.kind == FunctionKind::Cells
                    && self.access(GroupOf::SUBJECT, field).is_some_and(|access| !access.write) =>
            {
                self.element_here(ArgumentNumber::SUBJECT, field, index)
            }
            Expression::OfCell { argument, field } => self.element_here(*argument, field, index),
            Expression::Neighbour { argument, index: neighbour, field } => {
                let read = self.read_of(*argument, field);
                let (offset, index) = (self.offset(neighbour), self.expression(index));
                quote!(#read.element(#column, #offset, #index))
            }
            Expression::NamedNeighbour { argument, name, field } => {
                let (read, index) = (self.read_of(*argument, field), self.expression(index));
                quote!(#read.element(#column, #name, #index))
            }
            Expression::Other { argument, name, field } => {
                let (read, type_) = (self.read_of(*argument, field), self.type_of(*argument, field));
                let index = self.expression(index);
                quote!(::xca_core::kernel::load_element::<#type_>(&#read[#name], #index))
            }
            // At the start of a statement the brackets would be a statement of their own.
            block @ (Expression::If { .. } | Expression::Match { .. } | Expression::Block(_)) => {
                let (block, index) = (self.expression(block), self.expression(index));
                quote!((#block)[#index])
            }
            other => {
                let (other, index) = (self.expression(other), self.expression(index));
                quote!(#other[#index])
            }
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
        let [row, x, item, offsets, directions, space, draws] =
            ["row", "x", "item", "offsets", "directions", "space", "draws"].map(|name| self.name(name));
        let cells = self.function.kind == FunctionKind::Cells;
        let real = &self.real;
        self.draws += usize::from(matches!(builtin, Builtin::Random | Builtin::RandomBits));
        match builtin {
            Builtin::NeighbourCount => quote!(#offsets.count()),
            Builtin::Opposite => quote_spanned!(span=> #directions.opposite(#(#arguments,)* #row, #x)),
            Builtin::Displacement => {
                quote_spanned!(span=> #directions.displacement(#(#arguments,)* #row, #x))
            }
            Builtin::Exists => quote_spanned!(span=> #directions.exists(#(#arguments,)* #row, #x)),
            Builtin::Index => quote!(#row.index(#x)),
            Builtin::Label => quote!(#row.label(#item)),
            Builtin::Random if cells => quote_spanned!(span=> #draws.of_cell::<#real>(#x, #(#arguments),*)),
            Builtin::Random => {
                quote_spanned!(span=> #draws.of_item::<#real>(#row.label(#item), #(#arguments),*))
            }
            Builtin::RandomBits if cells => quote_spanned!(span=> #draws.bits_of_cell(#x, #(#arguments),*)),
            Builtin::RandomBits => {
                quote_spanned!(span=> #draws.bits_of_item(#row.label(#item), #(#arguments),*))
            }
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
