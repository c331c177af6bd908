//! Blocks and statements.

use super::scope::{Binding, Scope};
use crate::ast::{Block, Expression, FunctionKind, Place, PlaceRoot, Projection, Reach, Statement};
use syn::spanned::Spanned;
use syn::{BinOp, Error, Expr, ExprForLoop, Member, Pat, RangeLimits, Result, Stmt};

/// What an expression in the place of a statement turned out to be.
pub(super) enum Item {
    Statement(Statement),
    /// An expression with a value.
    Value(Expression),
}

impl Scope {
    pub(super) fn block(&mut self, block: &syn::Block) -> Result<Block> {
        self.nested(|scope| scope.statements(&block.stmts))
    }

    fn statements(&mut self, statements: &[Stmt]) -> Result<Block> {
        let mut block = Block { statements: Vec::new(), value: None };
        let last = statements.len().saturating_sub(1);
        for (position, statement) in statements.iter().enumerate() {
            match self.statement(statement, position == last) {
                Ok(Item::Statement(statement)) => block.statements.push(statement),
                Ok(Item::Value(value)) => block.value = Some(Box::new(value)),
                Err(error) => self.keep(error),
            }
        }
        Ok(block)
    }

    fn statement(&mut self, statement: &Stmt, last: bool) -> Result<Item> {
        match statement {
            Stmt::Local(local) => self.local(local).map(Item::Statement),
            Stmt::Item(item) => Err(Error::new_spanned(
                item,
                "items cannot stand in a process; move constants and helpers beside it",
            )),
            Stmt::Macro(call) => Err(macro_call(&call.mac)),
            Stmt::Expr(expression, semicolon) => match self.item(expression)? {
                Item::Value(value) if semicolon.is_some() || !last => {
                    Ok(Item::Statement(Statement::Expression(value)))
                }
                item => Ok(item),
            },
        }
    }

    fn local(&mut self, local: &syn::Local) -> Result<Statement> {
        let (pattern, type_) = match &local.pat {
            Pat::Type(typed) => (&*typed.pat, Some((*typed.ty).clone())),
            other => (other, None),
        };
        let Pat::Ident(pattern) = pattern else {
            return Err(Error::new_spanned(pattern, "bind one name at a time: `let name = value;`"));
        };
        if pattern.by_ref.is_some() || pattern.subpat.is_some() {
            return Err(Error::new_spanned(pattern, "bind a plain name: `let name = value;`"));
        }
        let name = pattern.ident.clone();
        let Some(init) = &local.init else {
            return Err(Error::new_spanned(local, "give the variable a value: `let name = value;`"));
        };
        if let Some((token, _)) = &init.diverge {
            return Err(Error::new_spanned(token, "`let … else` is not part of a process; use `if`"));
        }
        if let Expr::MethodCall(call) = &*init.expr
            && call.method == "neighbour"
            && self.is_subject(&call.receiver)
        {
            let index = self.neighbour_index(call)?;
            self.bind(&name, Binding::Neighbour);
            return Ok(Statement::LetNeighbour { name, index });
        }
        let value = self.expression(&init.expr);
        // Bound even after an error, so that one mistake does not make others of its uses.
        self.bind(&name, Binding::Value);
        Ok(Statement::Let { name, mutable: pattern.mutability.is_some(), type_, value: value? })
    }

    /// An expression in the place of a statement, or at the end of a block.
    pub(super) fn item(&mut self, expression: &Expr) -> Result<Item> {
        let statement = match expression {
            Expr::Assign(assign) => {
                let value = self.expression(&assign.right);
                let place = self.place(&assign.left)?;
                Statement::Assign { place, operator: None, value: value?, span: assign.eq_token.span() }
            }
            Expr::Binary(binary) if let Some(operator) = plain_operator(&binary.op) => {
                let value = self.expression(&binary.right);
                let place = self.place(&binary.left)?;
                Statement::Assign { place, operator: Some(operator), value: value?, span: binary.op.span() }
            }
            Expr::While(while_) => {
                refuse_label(while_.label.as_ref())?;
                let condition = self.expression(&while_.cond)?;
                let body = self.in_loop(|scope| scope.block(&while_.body))?;
                Statement::While { condition, body }
            }
            Expr::Loop(loop_) => {
                refuse_label(loop_.label.as_ref())?;
                Statement::Loop { body: self.in_loop(|scope| scope.block(&loop_.body))? }
            }
            Expr::ForLoop(for_) => self.for_loop(for_)?,
            Expr::Break(break_) => {
                if let Some(label) = &break_.label {
                    return Err(Error::new_spanned(
                        label,
                        "loops have no labels in a process; use a variable that ends the outer loop",
                    ));
                }
                if let Some(value) = &break_.expr {
                    return Err(Error::new_spanned(
                        value,
                        "`break` carries no value in a process; assign it to a variable first",
                    ));
                }
                self.check_in_loop(break_.span())?;
                Statement::Break(break_.span())
            }
            Expr::Continue(continue_) => {
                if let Some(label) = &continue_.label {
                    return Err(Error::new_spanned(
                        label,
                        "loops have no labels in a process; use a variable that ends the outer loop",
                    ));
                }
                self.check_in_loop(continue_.span())?;
                Statement::Continue(continue_.span())
            }
            Expr::Return(return_) => {
                let value = return_.expr.as_deref().map(|value| self.expression(value)).transpose()?;
                if value.is_some() && matches!(self.kind, FunctionKind::Cells | FunctionKind::Items) {
                    return Err(Error::new_spanned(return_, "a process returns nothing; write `return;`"));
                }
                Statement::Return(value, return_.span())
            }
            Expr::MethodCall(call) if call.method == "fault" && self.is_subject(&call.receiver) => {
                if call.args.len() != 2 {
                    return Err(Error::new_spanned(call, "write `fault(code, value)`: a u32 and a Real"));
                }
                let code = self.expression(&call.args[0])?;
                let value = self.expression(&call.args[1])?;
                Statement::Fault { code, value }
            }
            other => {
                let value = self.expression(other)?;
                return Ok(if has_value(&value) {
                    Item::Value(value)
                } else {
                    Item::Statement(Statement::Expression(value))
                });
            }
        };
        Ok(Item::Statement(statement))
    }

    fn check_in_loop(&self, span: proc_macro2::Span) -> Result<()> {
        if self.inside_loop() { Ok(()) } else { Err(Error::new(span, "there is no loop around this")) }
    }

    fn for_loop(&mut self, for_: &ExprForLoop) -> Result<Statement> {
        refuse_label(for_.label.as_ref())?;
        let variable = match &*for_.pat {
            Pat::Ident(pattern)
                if pattern.by_ref.is_none() && pattern.mutability.is_none() && pattern.subpat.is_none() =>
            {
                pattern.ident.clone()
            }
            Pat::Ident(pattern) => {
                return Err(Error::new_spanned(pattern, "the variable of a `for` is a plain name"));
            }
            // `for _ in 0..3`
            Pat::Path(_) | Pat::Rest(_) => {
                return Err(Error::new_spanned(&for_.pat, "the variable of a `for` is a plain name"));
            }
            other => {
                if quote::quote!(#other).to_string() != "_" {
                    return Err(Error::new_spanned(other, "the variable of a `for` is a plain name"));
                }
                syn::Ident::new("_unused", other.span())
            }
        };
        match strip(&for_.expr) {
            Expr::Range(range) => {
                let (Some(from), Some(to)) = (&range.start, &range.end) else {
                    return Err(Error::new_spanned(range, "give both ends of the range: `0..n`"));
                };
                let inclusive = matches!(range.limits, RangeLimits::Closed(_));
                let (from, to) = (self.expression(from)?, self.expression(to)?);
                let body = self.loop_body(&variable, Binding::Value, &for_.body)?;
                Ok(Statement::ForRange { variable, from, to, inclusive, body })
            }
            Expr::MethodCall(call) if self.is_subject(&call.receiver) => {
                let (reach, within) = match call.method.to_string().as_str() {
                    "others" => (Reach::All, false),
                    "others_in_cell" => (Reach::Cell, false),
                    "others_in_neighbours" => (Reach::Neighbours, false),
                    "others_within" => (Reach::All, true),
                    "others_in_cell_within" => (Reach::Cell, true),
                    "others_in_neighbours_within" => (Reach::Neighbours, true),
                    _ => return Err(not_a_loop(&call.method)),
                };
                if self.kind == FunctionKind::Cells || self.kind == FunctionKind::Migration {
                    return Err(Error::new_spanned(
                        &call.method,
                        "searches for other items belong in a process over items: `#[elementary_process] fn name(me: &mut Slot<…>)`",
                    ));
                }
                let radius = match (within, call.args.first()) {
                    (true, Some(radius)) if call.args.len() == 1 => Some(self.expression(radius)?),
                    (false, None) => None,
                    (true, _) => return Err(Error::new_spanned(call, "give one radius, in metres")),
                    (false, Some(extra)) => {
                        return Err(Error::new_spanned(
                            extra,
                            "this search takes no radius; its name with `_within` does",
                        ));
                    }
                };
                let body = self.loop_body(&variable, Binding::Other, &for_.body)?;
                Ok(Statement::ForOthers { variable, reach, radius, body })
            }
            Expr::Path(path)
                if path.path.get_ident().is_some_and(|name| self.binding(name) == Some(Binding::Slots)) =>
            {
                let body = self.loop_body(&variable, Binding::Other, &for_.body)?;
                Ok(Statement::ForItems { variable, body })
            }
            other => Err(not_a_loop(other)),
        }
    }

    fn loop_body(&mut self, variable: &syn::Ident, binding: Binding, body: &syn::Block) -> Result<Block> {
        self.nested(|scope| {
            scope.bind(variable, binding);
            scope.in_loop(|scope| scope.block(body))
        })
    }

    fn place(&mut self, left: &Expr) -> Result<Place> {
        let mut path = Vec::new();
        let mut here = strip(left);
        loop {
            match here {
                Expr::Path(expression) if let Some(name) = expression.path.get_ident() => {
                    return match self.binding(name) {
                        Some(Binding::Value) => {
                            path.reverse();
                            Ok(Place { root: PlaceRoot::Local(name.clone()), path })
                        }
                        Some(_) => {
                            Err(Error::new_spanned(name, "assign to a substate of it: `cell.substate = …`"))
                        }
                        None => Err(Error::new_spanned(
                            name,
                            format!(
                                "there is no variable `{name}` to assign to; write `let mut {name} = …;` first"
                            ),
                        )),
                    };
                }
                Expr::Field(field) => {
                    let Member::Named(member) = &field.member else {
                        return Err(Error::new_spanned(&field.member, "tuples are not part of a process"));
                    };
                    if let Some(binding) =
                        self.named(&field.base).filter(|binding| *binding != Binding::Value)
                    {
                        if binding == Binding::Subject && self.kind != FunctionKind::Migration {
                            path.reverse();
                            return Ok(Place { root: PlaceRoot::Own(member.clone()), path });
                        }
                        return Err(Error::new_spanned(left, cannot_write(binding, self.kind)));
                    }
                    if let Expr::MethodCall(call) = strip(&field.base)
                        && call.method == "neighbour"
                    {
                        return Err(Error::new_spanned(left, cannot_write(Binding::Neighbour, self.kind)));
                    }
                    if !is_component(member) {
                        return Err(Error::new_spanned(
                            member,
                            "the components of a vector are x, y, z and w",
                        ));
                    }
                    path.push(Projection::Component(member.clone()));
                    here = strip(&field.base);
                }
                Expr::Index(index) => {
                    path.push(Projection::Element(self.expression(&index.index)?));
                    here = strip(&index.expr);
                }
                other => {
                    return Err(Error::new_spanned(
                        other,
                        "assign to a variable or to a substate of the own cell: `cell.substate = …`",
                    ));
                }
            }
        }
    }
}

fn cannot_write(binding: Binding, kind: FunctionKind) -> &'static str {
    match binding {
        Binding::Neighbour => {
            "a process writes only its own cell, not a neighbour; let each cell compute what it receives, from what it reads of its neighbours"
        }
        Binding::Other => {
            "a process writes only its own item, not another; let each item compute the effect on itself"
        }
        Binding::CellOfItem => {
            "a process over items cannot write the cell; a process over cells with a `&Slots<…>` argument can sum up its items"
        }
        Binding::Parameters => {
            "parameters are the same in all cells; only steering changes them, between steps"
        }
        Binding::Subject if kind == FunctionKind::Migration => {
            "a migration only says where the item goes; change its substates in an elementary process"
        }
        _ => "this cannot be written in a process",
    }
}

fn not_a_loop(tokens: impl quote::ToTokens) -> Error {
    Error::new_spanned(
        tokens,
        "a `for` runs over a range (`0..n`), over other items (`me.others_within(radius)`, `me.others_in_cell()`, …) or over `&Slots<…>`",
    )
}

pub(super) fn macro_call(call: &syn::Macro) -> Error {
    Error::new_spanned(
        call,
        "macros cannot be called in a process; to report an impossible state use `cell.fault(code, value)`",
    )
}

fn refuse_label(label: Option<&syn::Label>) -> Result<()> {
    match label {
        Some(label) => Err(Error::new_spanned(
            label,
            "loops have no labels in a process; use a variable that ends the outer loop",
        )),
        None => Ok(()),
    }
}

pub(super) fn is_component(name: &syn::Ident) -> bool {
    name == "x" || name == "y" || name == "z" || name == "w"
}

/// Without parentheses and invisible groups.
pub(super) fn strip(expression: &Expr) -> &Expr {
    match expression {
        Expr::Paren(paren) => strip(&paren.expr),
        Expr::Group(group) => strip(&group.expr),
        other => other,
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
        BinOp::ShlAssign(_) => BinOp::Shl({
            let token = syn::Token![<<](span);
            token
        }),
        BinOp::ShrAssign(_) => BinOp::Shr({
            let token = syn::Token![>>](span);
            token
        }),
        _ => return None,
    })
}

/// Whether an expression that may stand for statements has a value.
fn has_value(expression: &Expression) -> bool {
    match expression {
        Expression::If { then, otherwise, .. } => {
            then.value.is_some() || otherwise.as_ref().is_some_and(|block| block.value.is_some())
        }
        Expression::Match { arms, .. } => arms.iter().any(|arm| arm.body.value.is_some()),
        Expression::Block(block) => block.value.is_some(),
        _ => true,
    }
}

/// Whether the last statement leaves the function on every path.
pub(super) fn ends_in_return(block: &Block) -> bool {
    match block.statements.last() {
        Some(Statement::Return(..)) => true,
        Some(Statement::Loop { .. }) => true,
        Some(Statement::Expression(Expression::If { then, otherwise: Some(otherwise), .. })) => {
            ends_in_return(then) && ends_in_return(otherwise)
        }
        Some(Statement::Expression(Expression::Match { arms, .. })) => {
            arms.iter().all(|arm| ends_in_return(&arm.body))
        }
        Some(Statement::Expression(Expression::Block(block))) => ends_in_return(block),
        _ => false,
    }
}
