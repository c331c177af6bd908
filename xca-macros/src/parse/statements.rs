//! Blocks and statements.

use super::refusals::{macro_call, refuse_attributes};
use super::scope::{Binding, Scope};
use crate::ast::{ArgumentNumber, Block, Expression, FunctionKind, LoopKind, Statement, TuplePart};
use syn::spanned::Spanned;
use syn::{Error, Expr, Pat, PatTuple, Result, Stmt, Type};

/// What an expression in the place of a statement turned out to be.
#[expect(clippy::large_enum_variant, reason = "made one at a time, and taken apart at once")]
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
                Ok(Some(Item::Statement(statement))) => block.statements.push(statement),
                Ok(Some(Item::Value(value))) => block.value = Some(Box::new(value)),
                // `;` alone.
                Ok(None) => {}
                Err(error) => self.keep(error),
            }
        }
        Ok(block)
    }

    fn statement(&mut self, statement: &Stmt, last: bool) -> Result<Option<Item>> {
        match statement {
            Stmt::Local(local) => self.local(local).map(|statement| Some(Item::Statement(statement))),
            Stmt::Item(item) => Err(Error::new_spanned(
                item,
                "a process has no items of its own; move constants and helpers out, beside it",
            )),
            Stmt::Macro(call) => Err(macro_call(&call.mac)),
            Stmt::Expr(Expr::Verbatim(nothing), _) if nothing.is_empty() => Ok(None),
            Stmt::Expr(expression, semicolon) => match self.item(expression)? {
                Item::Value(value) if semicolon.is_some() || !last => {
                    Ok(Some(Item::Statement(Statement::Expression(value))))
                }
                item => Ok(Some(item)),
            },
        }
    }

    fn local(&mut self, local: &syn::Local) -> Result<Statement> {
        let attributes = refuse_attributes(&local.attrs);
        let (pattern, type_) = match &local.pat {
            Pat::Type(typed) => (&*typed.pat, Some((*typed.ty).clone())),
            other => (other, None),
        };
        self.mentions.types.extend(type_.clone());
        if let Pat::Tuple(pattern) = pattern {
            return self.local_tuple(local, pattern, type_);
        }
        let Pat::Ident(pattern) = pattern else {
            return Err(Error::new_spanned(
                pattern,
                "bind names: `let name = value;`, or `let (a, b) = pair;`",
            ));
        };
        if pattern.by_ref.is_some() || pattern.subpat.is_some() {
            return Err(Error::new_spanned(pattern, "bind a plain name: `let name = value;`"));
        }
        let name = pattern.ident.clone();
        let value = self.initial(local);
        // Bound even after an error, so that one mistake does not make others of its uses.
        let binding = match value {
            Ok(Initial::Neighbour(argument, _)) => Binding::Neighbour(argument),
            _ => Binding::Value,
        };
        self.bind(&name, binding);
        attributes?;
        Ok(match value? {
            Initial::Neighbour(_, index) => Statement::LetNeighbour { name, index },
            Initial::Value(value) => {
                Statement::Let { name, mutable: pattern.mutability.is_some(), type_, value }
            }
        })
    }

    /// What a variable starts with.
    fn initial(&mut self, local: &syn::Local) -> Result<Initial> {
        match &local.init {
            None => Err(Error::new_spanned(
                local,
                "give the variable a value: `let mut name = value;`, or `let name = if … { a } else { b };`",
            )),
            Some(init) => match &init.diverge {
                Some((token, _)) => {
                    Err(Error::new_spanned(token, "`let … else` is not part of a process; compare with `if`"))
                }
                None => self.initial_value(&init.expr),
            },
        }
    }

    /// `let (a, b) = value;`
    fn local_tuple(
        &mut self,
        local: &syn::Local,
        pattern: &PatTuple,
        type_: Option<Type>,
    ) -> Result<Statement> {
        let value = self.initial(local);
        let mut parts = Vec::new();
        for part in &pattern.elems {
            match part {
                Pat::Wild(_) => parts.push(TuplePart { name: None, mutable: false }),
                Pat::Ident(part) if part.by_ref.is_none() && part.subpat.is_none() => {
                    self.bind(&part.ident, Binding::Value);
                    parts.push(TuplePart {
                        name: Some(part.ident.clone()),
                        mutable: part.mutability.is_some(),
                    });
                }
                other => {
                    return Err(Error::new_spanned(
                        other,
                        "the parts of a tuple are bound to plain names: `let (a, mut b, _) = value;`",
                    ));
                }
            }
        }
        match value? {
            Initial::Value(value) => Ok(Statement::LetTuple { parts, type_, value }),
            Initial::Neighbour(..) => {
                Err(Error::new_spanned(pattern, "a neighbour is no tuple: `let other = cell.neighbour(n);`"))
            }
        }
    }

    fn initial_value(&mut self, value: &Expr) -> Result<Initial> {
        if let Expr::MethodCall(call) = xca_spelling::strip(value)
            && call.method == "neighbour"
            && let Some(argument) = self.cell_argument(&call.receiver)
        {
            return Ok(Initial::Neighbour(argument, self.neighbour_index(argument, call)?));
        }
        self.expression(value).map(Initial::Value)
    }

    /// An expression in the place of a statement, or at the end of a block.
    pub(super) fn item(&mut self, expression: &Expr) -> Result<Item> {
        let statement = match expression {
            Expr::Assign(assign) => {
                self.assignment(&assign.left, None, &assign.right, assign.eq_token.span())?
            }
            Expr::Binary(binary) if let Some(operator) = super::plain_operator(&binary.op) => {
                self.assignment(&binary.left, Some(operator), &binary.right, binary.op.span())?
            }
            Expr::While(while_) => self.while_loop(while_)?,
            Expr::Loop(loop_) => self.endless_loop(loop_)?,
            Expr::ForLoop(for_) => self.for_loop(for_)?,
            Expr::Break(break_) => {
                if let Some(value) = &break_.expr {
                    return Err(Error::new_spanned(
                        value,
                        "`break` carries no value in a process; assign it to a variable before",
                    ));
                }
                self.check_in_loop(break_.label.as_ref(), break_.span())?;
                Statement::Break(break_.label.clone(), break_.span())
            }
            Expr::Continue(continue_) => {
                self.check_in_loop(continue_.label.as_ref(), continue_.span())?;
                Statement::Continue(continue_.label.clone(), continue_.span())
            }
            Expr::Return(return_) => {
                let value = return_.expr.as_deref().map(|value| self.expression(value)).transpose()?;
                if value.is_some() && matches!(self.kind, FunctionKind::Cells | FunctionKind::Items) {
                    return Err(Error::new_spanned(
                        return_,
                        "an elementary process has no value; assign it to a substate, then write `return;`",
                    ));
                }
                Statement::Return(value, return_.span())
            }
            Expr::Tuple(nothing) if nothing.elems.is_empty() => {
                Statement::Expression(Expression::Block(Block { statements: Vec::new(), value: None }))
            }
            Expr::MethodCall(call) if call.method == "fault" && self.is_subject(&call.receiver) => {
                let usage = "write `fault(code, value);`: a code of your choice, a u32, and a value to report, a Real";
                let [code, value] = self.arguments(call, usage)?;
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
}

/// What a variable starts with.
enum Initial {
    /// A neighbour with this index, as this struct of the cell sees it.
    Neighbour(ArgumentNumber, Expression),
    Value(Expression),
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
        Some(Statement::Loop(loop_)) => matches!(loop_.kind, LoopKind::Forever),
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
