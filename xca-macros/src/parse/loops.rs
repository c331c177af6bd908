//! `for` loops.

use super::expressions::strip;
use super::refusals::refuse_label;
use super::scope::{Binding, Scope};
use crate::ast::{ArgumentNumber, Block, FunctionKind, Reach, Statement};
use syn::spanned::Spanned;
use syn::{Error, Expr, ExprForLoop, ExprMethodCall, Ident, Pat, RangeLimits, Result};

impl Scope {
    pub(super) fn for_loop(&mut self, for_: &ExprForLoop) -> Result<Statement> {
        refuse_label(for_.label.as_ref())?;
        let variable = variable(&for_.pat)?;
        match strip(&for_.expr) {
            Expr::Range(range) => {
                let (Some(from), Some(to)) = (&range.start, &range.end) else {
                    return Err(Error::new_spanned(range, "give both ends of the range: `0..n`"));
                };
                let inclusive = matches!(range.limits, RangeLimits::Closed(_));
                let (from, to) = (self.expression(from), self.expression(to));
                let body = self.loop_body(&variable, Binding::Value, &for_.body)?;
                Ok(Statement::ForRange { variable, from: from?, to: to?, inclusive, body })
            }
            Expr::MethodCall(call) if self.is_subject(&call.receiver) => {
                let (reach, radius) = self.search(call)?;
                let body = self.loop_body(&variable, Binding::Other(ArgumentNumber::SUBJECT), &for_.body)?;
                Ok(Statement::ForOthers { variable, reach, radius, body })
            }
            Expr::MethodCall(call) => Err(Error::new_spanned(&call.method, method_of_range(call))),
            slots @ Expr::Path(_) if let Some(Binding::Slots(argument)) = self.named(slots) => {
                let body = self.loop_body(&variable, Binding::Other(argument), &for_.body)?;
                Ok(Statement::ForItems { variable, body })
            }
            Expr::Reference(reference) if matches!(self.named(&reference.expr), Some(Binding::Slots(_))) => {
                Err(Error::new_spanned(reference, "it is a reference already: leave out the `&`"))
            }
            other => Err(Error::new_spanned(
                other,
                "a `for` runs over a range (`for i in 0..n`), over other items (`for other in me.others_within(radius)`) or over \
                 the items of a cell (`for item in slots`); go through an array by index",
            )),
        }
    }

    /// A search for other items: where, and within which radius.
    fn search(&mut self, call: &ExprMethodCall) -> Result<(Reach, Option<crate::ast::Expression>)> {
        let (reach, within) = match call.method.to_string().as_str() {
            "others" => (Reach::All, false),
            "others_in_cell" => (Reach::Cell, false),
            "others_in_neighbours" => (Reach::Neighbours, false),
            "others_within" => (Reach::All, true),
            "others_in_cell_within" => (Reach::Cell, true),
            "others_in_neighbours_within" => (Reach::Neighbours, true),
            "neighbours" | "neighbour_count" if self.over_cells() => {
                return Err(Error::new_spanned(
                    &call.method,
                    "neighbours have numbers: `for n in 1..cell.neighbour_count() { … cell.neighbour(n).substate … }`",
                ));
            }
            _ if self.over_cells() => {
                return Err(Error::new_spanned(&call.method, "a `for` runs over a range: `for i in 0..n`"));
            }
            _ => {
                return Err(Error::new_spanned(
                    &call.method,
                    "a `for` runs over a range (`for i in 0..n`) or over other items: others(), others_in_cell(), \
                     others_in_neighbours(), others_within(radius), others_in_cell_within(radius), \
                     others_in_neighbours_within(radius)",
                ));
            }
        };
        match self.kind {
            FunctionKind::Items => {}
            FunctionKind::Migration => {
                return Err(Error::new_spanned(
                    &call.method,
                    "a migration looks at its own item only; search for others in an elementary process, and keep what it finds in \
                     a substate",
                ));
            }
            FunctionKind::Cells | FunctionKind::Helper => {
                return Err(Error::new_spanned(
                    &call.method,
                    "only a process over items searches for other items: `fn name(me: &mut Slot<…>)`; a process over cells \
                     goes through the items of its cell with an argument `slots: &Slots<…>`",
                ));
            }
        }
        if !within {
            let [] =
                self.arguments(call, "this search takes no radius; the one that does ends in `_within`")?;
            return Ok((reach, None));
        }
        let [radius] = self.arguments(call, "give the radius, in metres")?;
        Ok((reach, Some(radius)))
    }

    fn loop_body(&mut self, variable: &Ident, binding: Binding, body: &syn::Block) -> Result<Block> {
        self.nested(|scope| {
            scope.bind(variable, binding);
            scope.in_loop(|scope| scope.block(body))
        })
    }
}

fn variable(pattern: &Pat) -> Result<Ident> {
    match pattern {
        Pat::Ident(pattern)
            if pattern.by_ref.is_none() && pattern.mutability.is_none() && pattern.subpat.is_none() =>
        {
            Ok(pattern.ident.clone())
        }
        Pat::Wild(underscore) => Ok(Ident::new("_unused", underscore.span())),
        other => Err(Error::new_spanned(other, "the variable of a `for` is a plain name: `for i in 0..n`")),
    }
}

fn method_of_range(call: &ExprMethodCall) -> String {
    match call.method.to_string().as_str() {
        "rev" => {
            "a range runs upwards; compute the index: `for k in 0..n { let i = n - 1 - k; … }`".to_owned()
        }
        "step_by" => {
            "a range runs by ones; compute the index: `for k in 0..n { let i = step * k; … }`".to_owned()
        }
        "iter" | "into_iter" | "iter_mut" | "enumerate" => {
            "go through an array by index: `for i in 0..3 { … values[i] … }`".to_owned()
        }
        method => format!("a `for` runs over a range, `for i in 0..n`, without `.{method}(…)`"),
    }
}
