//! What a process will read of its neighbours' arrays, asked for before it is needed.
//!
//! A process that streams reads one element of each neighbour, from as many places in memory as there are
//! elements. A processor foresees a few of them. So a kernel asks for what the next block of cells will need.
//! Nothing depends on it but time: what is not foreseen here is read when it is needed, and what is foreseen
//! wrongly is not read.

use crate::access::GroupOf;
use crate::ast::{ArgumentNumber, Block, Builtin, Expression, Function, LoopKind, Range, Statement};
use proc_macro2::{Ident, TokenStream};
use quote::quote;
use syn::BinOp;

/// The most turns of a loop that are foreseen: as many as Moore's neighbourhood has cells.
const MOST: usize = 27;

/// What a kernel calls things.
pub(super) struct Names {
    pub(super) columns: Ident,
    pub(super) offsets: Ident,
    pub(super) directions: Ident,
    /// The argument from which a substate is read.
    pub(super) read: fn(GroupOf, &Ident) -> Ident,
}

/// What every cell reads, wherever it is.
pub(super) fn fetches(function: &Function, names: &Names) -> TokenStream {
    let mut fetches = Fetches { names, neighbours: Vec::new(), turns: None };
    fetches.block(&function.body)
}

struct Fetches<'a> {
    names: &'a Names,
    /// The neighbours with names.
    neighbours: Vec<(&'a Ident, &'a Expression)>,
    /// The variable of the loop.
    turns: Option<&'a Ident>,
}

impl<'a> Fetches<'a> {
    fn block(&mut self, block: &'a Block) -> TokenStream {
        let statements = block.statements.iter().map(|statement| self.statement(statement));
        statements.collect()
    }

    fn statement(&mut self, statement: &'a Statement) -> TokenStream {
        match statement {
            Statement::Let { value, .. }
            | Statement::LetTuple { value, .. }
            | Statement::Assign { value, .. }
            | Statement::Expression(value) => self.expression(value),
            Statement::LetNeighbour { name, index } => {
                self.neighbours.push((name, index));
                TokenStream::new()
            }
            Statement::Loop(turns) => match &turns.kind {
                LoopKind::Range { variable, range } if self.turns.is_none() => {
                    self.range(variable, range, &turns.body)
                }
                _ => TokenStream::new(),
            },
            _ => TokenStream::new(),
        }
    }

    /// What a loop reads in all its turns.
    fn range(&mut self, variable: &'a Ident, range: &'a Range, body: &'a Block) -> TokenStream {
        let (Some(from), Some(to)) = (self.number(&range.from), self.number(&range.to)) else {
            return TokenStream::new();
        };
        self.turns = Some(variable);
        let body = self.block(body);
        self.turns = None;
        if body.is_empty() {
            return body;
        }
        let over = if range.inclusive { quote!(#from..=#to) } else { quote!(#from..#to) };
        let most = proc_macro2::Literal::usize_unsuffixed(MOST);
        quote!(for #variable in (#over).take(#most) { #body })
    }

    /// What an expression reads, if it is computed at all.
    fn expression(&self, expression: &Expression) -> TokenStream {
        match expression {
            Expression::Element(array, element) => match &**array {
                Expression::Neighbour { argument, index, field } => {
                    self.fetch(*argument, field, index, element)
                }
                Expression::NamedNeighbour { argument, name, field } => {
                    let known = self.neighbours.iter().rfind(|(known, _)| *known == name);
                    known.map_or_else(TokenStream::new, |(_, index)| {
                        self.fetch(*argument, field, index, element)
                    })
                }
                other => self.expression(other),
            },
            Expression::Unary(_, value) | Expression::Cast(value, _) | Expression::Component(value, _) => {
                self.expression(value)
            }
            Expression::Binary(_, left, right) => {
                [left, right].map(|side| self.expression(side)).into_iter().collect()
            }
            Expression::Call { arguments, .. }
            | Expression::Array(arguments, _)
            | Expression::Vector(_, arguments) => self.expressions(arguments),
            Expression::Method { receiver, arguments, .. } => {
                [self.expression(receiver), self.expressions(arguments)].into_iter().collect()
            }
            _ => TokenStream::new(),
        }
    }

    fn expressions(&self, expressions: &[Expression]) -> TokenStream {
        expressions.iter().map(|expression| self.expression(expression)).collect()
    }

    /// An element of a neighbour's array, where both are known before the cell is.
    fn fetch(
        &self,
        argument: ArgumentNumber,
        field: &Ident,
        neighbour: &Expression,
        element: &Expression,
    ) -> TokenStream {
        let Names { columns, offsets, read, .. } = self.names;
        let read = read(GroupOf::Argument(argument), field);
        let known = self.number(neighbour).zip(self.number(element));
        known.map_or_else(
            TokenStream::new,
            |(neighbour, element)| quote!(#read.fetch(&#columns, #offsets.foreseen(#neighbour), #element);),
        )
    }

    /// A number that is the same in all cells.
    fn number(&self, expression: &Expression) -> Option<TokenStream> {
        match expression {
            Expression::Integer(value) => Some(quote!(#value)),
            Expression::Constant(path) => Some(quote!(#path)),
            Expression::Local(name) => (self.turns == Some(name)).then(|| quote!(#name)),
            Expression::Binary(operator, left, right) => {
                let (left, right) = (self.number(left)?, self.number(right)?);
                match operator {
                    BinOp::Add(_) => Some(quote!(usize::wrapping_add(#left, #right))),
                    BinOp::Sub(_) => Some(quote!(usize::wrapping_sub(#left, #right))),
                    BinOp::Mul(_) => Some(quote!(usize::wrapping_mul(#left, #right))),
                    _ => None,
                }
            }
            Expression::Builtin(Builtin::Opposite, arguments, _) => {
                let directions = &self.names.directions;
                let [index] = &**arguments else { return None };
                self.number(index).map(|index| quote!(#directions.opposite_foreseen(#index)))
            }
            _ => None,
        }
    }
}
