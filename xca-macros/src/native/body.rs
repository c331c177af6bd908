//! The body in one precision.

use super::hidden;
use crate::access::GroupOf;
use crate::ast::{
    Block, Builtin, Expression, Function, FunctionKind, Pattern, Place, PlaceRoot, Projection, Reach,
    Statement,
};
use crate::fields::with_real;
use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote, quote_spanned};

/// The variable that holds an own substate while the body runs.
pub(super) fn own_name(field: &Ident) -> Ident {
    hidden(&format!("own_{field}"), field.span())
}

/// The argument from which a substate is read.
pub(super) fn read_name(group: GroupOf, field: &Ident) -> Ident {
    let prefix = match group {
        GroupOf::Subject => "read",
        GroupOf::Companion => "companion",
        GroupOf::Position => "search",
    };
    hidden(&format!("{prefix}_{field}"), field.span())
}

/// The argument to which a substate is written.
pub(super) fn write_name(field: &Ident) -> Ident {
    hidden(&format!("write_{field}"), field.span())
}

/// Writes a body as Rust of one precision.
pub(super) struct Writer<'a> {
    function: &'a Function,
    real: TokenStream,
    /// How many lists of found items the body needs.
    searches: usize,
}

impl<'a> Writer<'a> {
    pub(super) fn new(function: &'a Function, real: TokenStream) -> Self {
        Self { function, real, searches: 0 }
    }

    fn name(&self, name: &str) -> Ident {
        hidden(name, self.function.name.span())
    }

    fn list(&self, number: usize) -> Ident {
        self.name(&format!("found_{number}"))
    }

    /// Takes the lists that searches fill.
    pub(super) fn lists(&self) -> TokenStream {
        let row = self.name("row");
        (0..self.searches)
            .map(|number| {
                let list = self.list(number);
                quote!(let mut #list = #row.found();)
            })
            .collect()
    }

    pub(super) fn block(&mut self, block: &Block) -> TokenStream {
        let statements: Vec<TokenStream> =
            block.statements.iter().map(|statement| self.statement(statement)).collect();
        let value = block.value.as_ref().map(|value| self.expression(value));
        quote!({ #(#statements)* #value })
    }

    fn statement(&mut self, statement: &Statement) -> TokenStream {
        match statement {
            Statement::Let { name, mutable, type_, value } => {
                let value = self.expression(value);
                let mutable = mutable.then(|| quote!(mut));
                let type_ = type_.as_ref().map(|type_| {
                    let type_ = with_real(type_, &self.real);
                    quote!(: #type_)
                });
                quote!(let #mutable #name #type_ = #value;)
            }
            Statement::LetNeighbour { name, index } => {
                let offset = self.offset(index);
                quote!(let #name: isize = #offset;)
            }
            Statement::Assign { place, operator, value, span } => {
                let value = self.expression(value);
                let place = self.place(place);
                match operator {
                    None => quote_spanned!(*span=> #place = #value;),
                    Some(operator) => quote_spanned!(*span=> #place = #place #operator #value;),
                }
            }
            Statement::Expression(expression) => {
                let expression = self.expression(expression);
                quote!(#expression;)
            }
            Statement::While { condition, body } => {
                let (condition, body) = (self.expression(condition), self.block(body));
                quote!(while #condition #body)
            }
            Statement::Loop { body } => {
                let body = self.block(body);
                quote!(loop #body)
            }
            Statement::ForRange { variable, from, to, inclusive, body } => {
                let (from, to) = (self.expression(from), self.expression(to));
                let body = self.block(body);
                let dots = if *inclusive { quote!(..=) } else { quote!(..) };
                quote!(for #variable in #from #dots #to #body)
            }
            Statement::ForOthers { variable, reach, radius, body } => {
                self.for_others(variable, *reach, radius.as_ref(), body)
            }
            Statement::ForItems { variable, body } => {
                let (row, x) = (self.name("row"), self.name("x"));
                let body = self.block(body);
                quote!(for #variable in #row.items(#x) #body)
            }
            Statement::Break(span) => quote_spanned!(*span=> break;),
            Statement::Continue(span) => quote_spanned!(*span=> continue;),
            Statement::Return(value, span) => {
                let value = value.as_ref().map(|value| self.expression(value));
                if self.function.kind == FunctionKind::Helper {
                    quote_spanned!(*span=> return #value;)
                } else {
                    quote_spanned!(*span=> break 'body #value;)
                }
            }
            Statement::Fault { code, value } => {
                let (row, x) = (self.name("row"), self.name("x"));
                let label = if self.function.kind == FunctionKind::Cells {
                    quote!(::core::option::Option::None)
                } else {
                    let item = self.name("item");
                    quote!(::core::option::Option::Some(#row.label(#item)))
                };
                let (code, value, real) = (self.expression(code), self.expression(value), &self.real);
                quote!(#row.report::<#real>(#x, #label, #code, #value);)
            }
        }
    }

    fn for_others(
        &mut self,
        variable: &Ident,
        reach: Reach,
        radius: Option<&Expression>,
        body: &Block,
    ) -> TokenStream {
        let [row, x, item] = ["row", "x", "item"].map(|name| self.name(name));
        let number = match reach {
            Reach::Cell => quote!(0),
            Reach::Neighbours => quote!(1),
            Reach::All => quote!(2),
        };
        if reach == Reach::Cell && radius.is_none() {
            let body = self.block(body);
            return quote! {
                for #variable in #row.items(#x) {
                    if #variable == #item {
                        continue;
                    }
                    #body
                }
            };
        }
        let list = self.list(self.searches);
        self.searches += 1;
        let search = match radius {
            None => quote!(#row.others::<#number>(#x, #item, &mut #list.items);),
            Some(radius) => {
                let radius = self.expression(radius);
                let positions = read_name(GroupOf::Position, &Ident::new("position", Span::call_site()));
                quote!(#row.others_within::<_, #number>(#x, #item, #positions[#item], #radius, #positions, &mut #list.items);)
            }
        };
        let body = self.block(body);
        let index = self.name("index");
        quote! {
            #search
            for #index in 0..#list.items.len() {
                let #variable = #list.items[#index] as usize;
                #body
            }
        }
    }

    fn offset(&mut self, index: &Expression) -> TokenStream {
        let [offsets, row, x] = ["offsets", "row", "x"].map(|name| self.name(name));
        let index = self.expression(index);
        quote!(#offsets.at(#index, #row, #x))
    }

    fn place(&mut self, place: &Place) -> TokenStream {
        let mut tokens = match &place.root {
            PlaceRoot::Local(name) => quote!(#name),
            PlaceRoot::Own(field) => {
                let own = own_name(field);
                quote!(#own)
            }
        };
        for projection in &place.path {
            tokens = match projection {
                Projection::Component(component) => quote!(#tokens.#component),
                Projection::Element(index) => {
                    let index = self.expression(index);
                    quote!(#tokens[#index])
                }
            };
        }
        tokens
    }

    fn expressions(&mut self, expressions: &[Expression]) -> Vec<TokenStream> {
        expressions.iter().map(|expression| self.expression(expression)).collect()
    }

    fn expression(&mut self, expression: &Expression) -> TokenStream {
        match expression {
            Expression::Bool(value) => quote!(#value),
            Expression::Integer(value) => quote!(#value),
            Expression::Float(value) => quote!(#value),
            Expression::Local(name) => quote!(#name),
            Expression::Constant(path) => {
                let real = &self.real;
                quote!(::xca_core::kernel::constant::<#real, _>(#path))
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
                let parameters = self.name_at("parameters", field.span());
                quote!(#parameters.#field)
            }
            Expression::Parameters(span) => {
                let parameters = self.name_at("parameters", *span);
                quote!(#parameters)
            }
            Expression::Space(span) => {
                let space = self.name_at("space", *span);
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
            Expression::Call { function, arguments } => {
                let arguments = self.expressions(arguments);
                let precision = &self.real;
                let native = format_ident!("native_{}", precision.to_string());
                quote!(#function::#native(#(#arguments),*))
            }
            Expression::Method { method, receiver, arguments } => {
                let receiver = self.expression(receiver);
                let arguments = self.expressions(arguments);
                let ordered = match method.to_string().as_str() {
                    "min" => "ordered_min",
                    "max" => "ordered_max",
                    "clamp" => "ordered_clamp",
                    _ => return quote!(#receiver.#method(#(#arguments),*)),
                };
                let ordered = Ident::new(ordered, method.span());
                quote!(::xca_core::kernel::Ordered::#ordered(#receiver, #(#arguments),*))
            }
            Expression::Component(value, component) => {
                let value = self.expression(value);
                quote!(#value.#component)
            }
            Expression::Element(array, index) => {
                let (array, index) = (self.expression(array), self.expression(index));
                quote!(#array[#index])
            }
            Expression::Array(elements, span) => {
                let elements = self.expressions(elements);
                quote_spanned!(*span=> [#(#elements),*])
            }
            Expression::Repeat(value, length) => {
                let value = self.expression(value);
                quote!([#value; #length])
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
            Expression::Match { value, arms, span } => {
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
                quote_spanned!(*span=> match #value { #(#arms)* })
            }
            Expression::Block(block) => self.block(block),
        }
    }

    fn name_at(&self, name: &str, span: Span) -> Ident {
        hidden(name, span)
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
