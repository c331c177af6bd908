//! The body in one precision.

use super::labels::{Unrolled, hidden_label};
use super::mates::Mates;
use super::names::{hidden, own_name};
use crate::access::{Access, GroupOf, Uses};
use crate::ast::{Block, Expression, Function, FunctionKind, Place, PlaceRoot, Projection, Statement};
use crate::fields::with_real;
use proc_macro2::{Ident, Span, TokenStream};
use quote::{quote, quote_spanned};
use syn::{BinOp, Lifetime};

/// Writes a body as Rust of one precision.
pub(super) struct Writer<'a> {
    pub(super) function: &'a Function,
    /// The substates that a process uses; nothing for a helper.
    uses: Option<&'a Uses>,
    pub(super) real: TokenStream,
    /// How many lists of found items the body needs.
    pub(super) searches: usize,
    /// The marks that loops over the others in the cell need.
    pub(super) mates: Vec<Mates>,
    /// How many loops have been written.
    pub(super) loops: usize,
    /// The loop whose turns are being written out.
    pub(super) unrolled: Option<Unrolled>,
    /// How many draws have been written.
    pub(super) draws: usize,
    /// Whether variables hold the values of the other item, which is that of a lane.
    pub(super) others_in_lanes: bool,
}

impl<'a> Writer<'a> {
    pub(super) fn new(function: &'a Function, uses: Option<&'a Uses>, real: TokenStream) -> Self {
        Self {
            function,
            uses,
            real,
            searches: 0,
            mates: Vec::new(),
            loops: 0,
            unrolled: None,
            draws: 0,
            others_in_lanes: false,
        }
    }

    /// How the process uses a substate.
    pub(super) fn access(&self, group: GroupOf, field: &Ident) -> Option<&'a Access> {
        let accesses = &self.uses?.accesses;
        accesses.iter().find(|access| access.group == group && access.field == *field)
    }

    pub(super) fn name(&self, name: &str) -> Ident {
        hidden(name, self.function.name.span())
    }

    pub(super) fn list(&self, number: usize) -> Ident {
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

    pub(super) fn block(&mut self, Block { statements, value }: &Block) -> TokenStream {
        self.statements(statements.iter(), value.as_deref())
    }

    pub(super) fn statements<'s>(
        &mut self,
        statements: impl Iterator<Item = &'s Statement>,
        value: Option<&Expression>,
    ) -> TokenStream {
        let statements: Vec<TokenStream> = statements.map(|statement| self.statement(statement)).collect();
        let value = value.map(|value| self.expression(value));
        quote!({ #(#statements)* #value })
    }

    pub(super) fn statement(&mut self, statement: &Statement) -> TokenStream {
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
            Statement::LetTuple { parts, type_, value } => {
                let value = self.expression(value);
                let parts = parts.iter().map(|part| match &part.name {
                    Some(name) => {
                        let mutable = part.mutable.then(|| quote!(mut));
                        quote!(#mutable #name)
                    }
                    None => quote!(_),
                });
                let type_ = type_.as_ref().map(|type_| {
                    let type_ = with_real(type_, &self.real);
                    quote!(: #type_)
                });
                quote!(let (#(#parts),*) #type_ = #value;)
            }
            Statement::LetNeighbour { name, index } => {
                let offset = self.offset(index);
                quote!(let #name = #offset;)
            }
            Statement::Assign { place, operator, value, span } => {
                let value = self.expression(value);
                let place = self.place(place);
                match operator {
                    None => quote_spanned!(*span=> #place = #value;),
                    Some(operator) => {
                        let operator = compound(operator, *span);
                        quote_spanned!(*span=> #place #operator #value;)
                    }
                }
            }
            Statement::Expression(expression) => {
                let expression = self.expression(expression);
                quote!(#expression;)
            }
            Statement::Loop(loop_) => self.loop_(loop_),
            Statement::Break(label, span) => {
                let label = self.leaves(label.as_ref(), true).or_else(|| label.as_ref().map(hidden_label));
                quote_spanned!(*span=> break #label;)
            }
            Statement::Continue(label, span) => match self.leaves(label.as_ref(), false) {
                Some(turn) => quote_spanned!(*span=> break #turn;),
                None => {
                    let label = label.as_ref().map(hidden_label);
                    quote_spanned!(*span=> continue #label;)
                }
            },
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

    /// What a `break` (of the whole loop) or `continue` leaves where the turns of its loop are written out.
    fn leaves(&self, label: Option<&Lifetime>, whole: bool) -> Option<Lifetime> {
        self.unrolled.as_ref()?.leaves(label, whole)
    }

    pub(super) fn offset(&mut self, index: &Expression) -> TokenStream {
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
}

/// The operator of a compound assignment, from the plain one. The value is computed before the place is read.
fn compound(operator: &BinOp, span: Span) -> TokenStream {
    match operator {
        BinOp::Add(_) => quote_spanned!(span=> +=),
        BinOp::Sub(_) => quote_spanned!(span=> -=),
        BinOp::Mul(_) => quote_spanned!(span=> *=),
        BinOp::Div(_) => quote_spanned!(span=> /=),
        BinOp::Rem(_) => quote_spanned!(span=> %=),
        BinOp::BitAnd(_) => quote_spanned!(span=> &=),
        BinOp::BitOr(_) => quote_spanned!(span=> |=),
        BinOp::BitXor(_) => quote_spanned!(span=> ^=),
        BinOp::Shl(_) => quote_spanned!(span=> <<=),
        BinOp::Shr(_) => quote_spanned!(span=> >>=),
        other => quote!(#other),
    }
}
