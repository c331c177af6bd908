//! Expressions.

use super::calls::SPACE_METHODS;
use super::refusals::{is_component, no_component, refused};
use super::scope::{Binding, Scope};
use super::statements::Item;
use crate::ast::{ArgumentNumber, ArraySize, Block, Builtin, Expression, FunctionKind};
use crate::size::bytes;
use syn::spanned::Spanned;
use syn::{BinOp, Error, Expr, ExprMethodCall, Ident, Lit, Member, Path, Result, UnOp};
use xca_spelling::{is_constant, strip};

const NO_SELF: &str = "a process is a free function: there is no `self`";

/// Both results, or the errors of both.
pub(super) fn both<A, B>(first: Result<A>, second: Result<B>) -> Result<(A, B)> {
    match (first, second) {
        (Ok(first), Ok(second)) => Ok((first, second)),
        (Err(mut error), Err(other)) => {
            error.combine(other);
            Err(error)
        }
        (Err(error), Ok(_)) | (Ok(_), Err(error)) => Err(error),
    }
}

impl Scope {
    pub(super) fn expression(&mut self, expression: &Expr) -> Result<Expression> {
        match strip(expression) {
            Expr::Lit(literal) => literal_expression(&literal.lit),
            Expr::Path(path) => self.path(path),
            Expr::Field(field) => self.field(field),
            Expr::MethodCall(call) => self.method_call(call),
            Expr::Call(call) => self.call(call),
            Expr::Unary(unary) => match unary.op {
                UnOp::Neg(_) | UnOp::Not(_) => {
                    Ok(Expression::Unary(unary.op, Box::new(self.expression(&unary.expr)?)))
                }
                // That it is a reference is for the compiler to say.
                _ => self.expression(&unary.expr),
            },
            Expr::Binary(binary) if super::plain_operator(&binary.op).is_some() => Err(Error::new_spanned(
                binary,
                "an assignment has no value; write it as a statement of its own",
            )),
            Expr::Binary(binary) => self.binary(binary.op, &binary.left, &binary.right),
            Expr::Cast(cast) => {
                self.mentions.types.push((*cast.ty).clone());
                Ok(Expression::Cast(Box::new(self.expression(&cast.expr)?), (*cast.ty).clone()))
            }
            Expr::Index(index) => {
                let (array, index) = both(self.expression(&index.expr), self.expression(&index.index))?;
                Ok(Expression::Element(Box::new(array), Box::new(index)))
            }
            Expr::Array(array) => {
                let elements =
                    array.elems.iter().map(|element| self.expression(element)).collect::<Result<_>>()?;
                Ok(Expression::Array(elements, array.span()))
            }
            Expr::Repeat(repeat) => {
                let outside = self.mentions.arrays.len();
                let (value, length) = both(self.expression(&repeat.expr), self.length(&repeat.len))?;
                let array = Expression::Repeat(Box::new(value), Box::new(length));
                // What it is made of is counted with it.
                self.mentions.arrays.truncate(outside);
                self.mentions.arrays.push(ArraySize { bytes: bytes(&array), span: repeat.span() });
                Ok(array)
            }
            Expr::Tuple(tuple) if tuple.elems.len() > 1 => {
                let parts = tuple.elems.iter().map(|part| self.expression(part)).collect::<Result<_>>()?;
                Ok(Expression::Tuple(parts, tuple.span()))
            }
            Expr::If(if_) => self.if_expression(if_),
            Expr::Match(match_) => self.match_expression(match_),
            Expr::Block(block) if block.label.is_none() => Ok(Expression::Block(self.block(&block.block)?)),
            other => Err(refused(other)),
        }
    }

    fn binary(&mut self, operator: BinOp, left: &Expr, right: &Expr) -> Result<Expression> {
        let (left, right) = both(self.expression(left), self.expression(right))?;
        Ok(Expression::Binary(operator, Box::new(left), Box::new(right)))
    }

    fn if_expression(&mut self, if_: &syn::ExprIf) -> Result<Expression> {
        let condition = self.expression(&if_.cond);
        let then = self.block(&if_.then_branch)?;
        let otherwise = match &if_.else_branch {
            None => None,
            Some((_, branch)) => Some(self.branch(branch)?),
        };
        Ok(Expression::If { condition: Box::new(condition?), then, otherwise, span: if_.span() })
    }

    /// The body of an `else` or of an arm: a block, or one expression.
    pub(super) fn branch(&mut self, branch: &Expr) -> Result<Block> {
        if let Expr::Block(block) = branch
            && block.label.is_none()
        {
            return self.block(&block.block);
        }
        Ok(match self.item(branch)? {
            Item::Statement(statement) => Block { statements: vec![statement], value: None },
            Item::Value(value) => Block { statements: Vec::new(), value: Some(Box::new(value)) },
        })
    }

    fn path(&mut self, path: &syn::ExprPath) -> Result<Expression> {
        if path.qself.is_some() {
            return Err(Error::new_spanned(path, "give the constant a plain path"));
        }
        if let Some(name) = path.path.get_ident() {
            match self.binding(name) {
                Some(Binding::Value | Binding::Argument) => return Ok(Expression::Local(name.clone())),
                Some(Binding::Parameters) => return Ok(Expression::Parameters(name.clone())),
                Some(Binding::Space) => return Ok(Expression::Space(name.span())),
                Some(Binding::Slots(_)) => {
                    return Err(Error::new_spanned(
                        name,
                        format!("go through the items: `for item in {name} {{ … item.substate … }}`"),
                    ));
                }
                Some(_) => {
                    return Err(Error::new_spanned(
                        name,
                        format!("`{name}` is no value by itself; use its substates: `{name}.substate`"),
                    ));
                }
                None if !is_constant(name) => return Err(self.undeclared(name)),
                None => {}
            }
        }
        self.constant(&path.path)
    }

    fn constant(&mut self, path: &Path) -> Result<Expression> {
        let words: Vec<&Ident> = path.segments.iter().map(|segment| &segment.ident).collect();
        if let [.., type_, variant] = words[..]
            && type_ == "Destination"
        {
            return match variant.to_string().as_str() {
                "Stay" => Ok(Expression::Builtin(Builtin::Stay, Vec::new(), path.span())),
                "Outside" => Ok(Expression::Builtin(Builtin::Outside, Vec::new(), path.span())),
                _ => Err(no_destination(path)),
            };
        }
        if let Some(first) = words.first().filter(|first| **first == "Self") {
            return Err(Error::new_spanned(first, NO_SELF));
        }
        self.mentions.constants.push(path.clone());
        Ok(Expression::Constant(path.clone()))
    }

    fn undeclared(&self, name: &Ident) -> Error {
        let message = match self.similar_name(name) {
            _ if name == "self" => NO_SELF.to_owned(),
            Some(similar) => format!("there is no variable `{name}` here; did you mean `{similar}`?"),
            None => format!("there is no variable `{name}` here; constants are written in capitals"),
        };
        Error::new_spanned(name, message)
    }

    /// The length of an array.
    fn length(&mut self, length: &Expr) -> Result<Expr> {
        if !self.is_known(length) {
            return Err(Error::new_spanned(
                length,
                "the length of an array is a number or a constant: `[0.0; 4]`, `[0.0; SIDES]`",
            ));
        }
        Ok(length.clone())
    }

    /// Whether an expression is made of integers and constants.
    fn is_known(&self, expression: &Expr) -> bool {
        match strip(expression) {
            Expr::Lit(literal) => matches!(literal.lit, Lit::Int(_)),
            Expr::Path(path) => {
                let last = path.path.segments.last();
                last.is_some_and(|last| is_constant(&last.ident)) && self.named(expression).is_none()
            }
            Expr::Binary(binary) => self.is_known(&binary.left) && self.is_known(&binary.right),
            _ => false,
        }
    }

    /// What the expression stands for, where it is a plain name.
    pub(super) fn named(&self, expression: &Expr) -> Option<Binding> {
        match strip(expression) {
            Expr::Path(path) => path.path.get_ident().and_then(|name| self.binding(name)),
            _ => None,
        }
    }

    pub(super) fn is_subject(&self, expression: &Expr) -> bool {
        self.named(expression) == Some(Binding::Subject)
    }

    fn field(&mut self, field: &syn::ExprField) -> Result<Expression> {
        let Member::Named(member) = &field.member else {
            return Err(Error::new_spanned(&field.member, "take the tuple apart: `let (a, b) = pair;`"));
        };
        let member = member.clone();
        if let Expr::Path(path) = strip(&field.base)
            && let Some(name) = path.path.get_ident()
        {
            match self.binding(name) {
                Some(Binding::Subject) => return Ok(Expression::Own(member)),
                Some(Binding::Cell(argument)) => return Ok(Expression::OfCell { argument, field: member }),
                Some(Binding::Parameters) => {
                    return Ok(Expression::Parameter { argument: name.clone(), field: member });
                }
                Some(Binding::Neighbour(argument)) => {
                    return Ok(Expression::NamedNeighbour { argument, name: name.clone(), field: member });
                }
                Some(Binding::Other(argument)) => {
                    return Ok(Expression::Other { argument, name: name.clone(), field: member });
                }
                Some(Binding::Slots(_)) => {
                    return Err(Error::new_spanned(
                        field,
                        format!("go through the items: `for item in {name} {{ … item.{member} … }}`"),
                    ));
                }
                Some(Binding::Space) => {
                    return Err(Error::new_spanned(member, SPACE_METHODS));
                }
                Some(Binding::Value | Binding::Argument) | None => {}
            }
        }
        if let Expr::MethodCall(call) = strip(&field.base)
            && call.method == "neighbour"
            && let Some(argument) = self.cell_argument(&call.receiver)
        {
            let index = Box::new(self.neighbour_index(argument, call)?);
            return Ok(Expression::Neighbour { argument, index, field: member });
        }
        let value = self.expression(&field.base)?;
        if let (Expression::Constant(path), false) = (&value, is_component(&member)) {
            let path = quote::quote!(#path).to_string().replace(' ', "");
            return Err(Error::new_spanned(
                &member,
                format!(
                    "constants are numbers, vectors and arrays; make one of the field: `const NAME: … = {path}.{member};`"
                ),
            ));
        }
        if !is_component(&member) {
            return Err(no_component(&member));
        }
        Ok(Expression::Component(Box::new(value), member))
    }

    /// The number of the struct of the cell, or of the item, that the name stands for.
    pub(super) fn cell_argument(&self, expression: &Expr) -> Option<ArgumentNumber> {
        match self.named(expression)? {
            Binding::Subject => Some(ArgumentNumber::SUBJECT),
            Binding::Cell(argument) => Some(argument),
            _ => None,
        }
    }

    pub(super) fn neighbour_index(
        &mut self,
        argument: ArgumentNumber,
        call: &ExprMethodCall,
    ) -> Result<Expression> {
        if self.kind != FunctionKind::Cells && argument == ArgumentNumber::SUBJECT {
            return Err(Error::new_spanned(
                &call.method,
                "an item has no neighbours; it reaches the items of the neighbouring cells by \
                 `for other in me.others_in_neighbours() { … }`",
            ));
        }
        let [index] = self.arguments(call, "give the number of the neighbour: `cell.neighbour(n)`")?;
        Ok(index)
    }
}

pub(super) fn no_destination(tokens: impl quote::ToTokens) -> Error {
    Error::new_spanned(
        tokens,
        "a destination is `Destination::Stay`, `Destination::Outside` or `space.cell_containing(position)`",
    )
}

fn literal_expression(literal: &Lit) -> Result<Expression> {
    match literal {
        Lit::Bool(value) => Ok(Expression::Bool(value.clone())),
        Lit::Int(value) if value.suffix() == "f32" || value.suffix() == "f64" => {
            Err(Error::new_spanned(value, "write the decimal point: `1.0`"))
        }
        Lit::Int(value) => Ok(Expression::Integer(value.clone())),
        Lit::Float(value) => Ok(Expression::Float(value.clone())),
        other => Err(Error::new_spanned(other, "literals in a process are numbers, true and false")),
    }
}
