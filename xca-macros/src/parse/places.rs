//! What is assigned to.

use super::expressions::both;
use super::refusals::{WRITE_BY_INDEX, cannot_write, is_component, no_component};
use super::scope::{Binding, Scope};
use crate::ast::{ArgumentNumber, FunctionKind, Place, PlaceRoot, Projection, Statement};
use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{BinOp, Error, Expr, ExprUnary, Ident, Member, Result, UnOp};
use xca_spelling::strip;

impl Scope {
    pub(super) fn assignment(
        &mut self,
        left: &Expr,
        operator: Option<BinOp>,
        right: &Expr,
        span: Span,
    ) -> Result<Statement> {
        let (place, value) = both(self.place(left), self.expression(right))?;
        Ok(Statement::Assign { place, operator, value, span })
    }

    fn place(&mut self, left: &Expr) -> Result<Place> {
        let mut path = Vec::new();
        let mut here = strip(left);
        loop {
            match here {
                Expr::Path(expression) if let Some(name) = expression.path.get_ident() => {
                    let root = PlaceRoot::Local(self.variable(name)?);
                    path.reverse();
                    return Ok(Place { root, path });
                }
                Expr::Field(field) => {
                    let Member::Named(member) = &field.member else {
                        return Err(Error::new_spanned(
                            &field.member,
                            "take the tuple apart and write a variable: `let (mut a, b) = pair;`",
                        ));
                    };
                    match self.named(&field.base) {
                        Some(Binding::Subject) if self.kind != FunctionKind::Migration => {
                            path.reverse();
                            return Ok(Place { root: PlaceRoot::Own(member.clone()), path });
                        }
                        Some(binding) if !binding.is_value() => {
                            return Err(Error::new_spanned(left, cannot_write(binding, self.kind)));
                        }
                        _ => {}
                    }
                    if let Expr::MethodCall(call) = strip(&field.base)
                        && call.method == "neighbour"
                    {
                        let neighbour = Binding::Neighbour(ArgumentNumber::SUBJECT);
                        return Err(Error::new_spanned(left, cannot_write(neighbour, self.kind)));
                    }
                    if !is_component(member) {
                        return Err(no_component(member));
                    }
                    path.push(Projection::Component(member.clone()));
                    here = strip(&field.base);
                }
                Expr::Index(index) => {
                    path.push(Projection::Element(self.expression(&index.index)?));
                    here = strip(&index.expr);
                }
                other => {
                    let advice = match other {
                        Expr::Unary(ExprUnary { op: UnOp::Deref(_), expr, .. }) if !self.is_subject(expr) => {
                            WRITE_BY_INDEX
                        }
                        _ => "assign to a variable or to a substate of the own cell: `cell.substate = …`",
                    };
                    return Err(Error::new_spanned(other, advice));
                }
            }
        }
    }

    /// The variable with this name, to be written.
    fn variable(&self, name: &Ident) -> Result<Ident> {
        let message = match self.binding(name) {
            Some(Binding::Value) => return Ok(name.clone()),
            Some(Binding::Argument) => {
                format!("an argument cannot be changed; begin with `let mut {name} = {name};`")
            }
            Some(Binding::Subject) => format!("assign to a substate: `{name}.substate = …`"),
            Some(binding) => cannot_write(binding, self.kind).to_owned(),
            None => match self.similar_name(name) {
                Some(similar) => {
                    format!("there is no variable `{name}` to assign to; did you mean `{similar}`?")
                }
                None => {
                    format!("there is no variable `{name}` to assign to; write `let mut {name} = …;` before")
                }
            },
        };
        Err(Error::new_spanned(name, message))
    }
}

/// The operator of a compound assignment.
pub(crate) fn plain_operator(operator: &BinOp) -> Option<BinOp> {
    let span = operator.span();
    Some(match operator {
        BinOp::AddAssign(_) => BinOp::Add(syn::Token![+](span)),
        BinOp::SubAssign(_) => BinOp::Sub(syn::Token![-](span)),
        BinOp::MulAssign(_) => BinOp::Mul(syn::Token![*](span)),
        BinOp::DivAssign(_) => BinOp::Div(syn::Token![/](span)),
        BinOp::RemAssign(_) => BinOp::Rem(syn::Token![%](span)),
        BinOp::BitAndAssign(_) => BinOp::BitAnd(syn::Token![&](span)),
        BinOp::BitOrAssign(_) => BinOp::BitOr(syn::Token![|](span)),
        BinOp::BitXorAssign(_) => BinOp::BitXor(syn::Token![^](span)),
        BinOp::ShlAssign(_) => BinOp::Shl(syn::token::Shl { spans: [span; 2] }),
        BinOp::ShrAssign(_) => BinOp::Shr(syn::token::Shr { spans: [span; 2] }),
        _ => return None,
    })
}
