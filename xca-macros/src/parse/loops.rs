//! Loops.

use super::expressions::both;
use super::refusals::WRITE_BY_INDEX;
use super::scope::{Binding, Scope};
use crate::ast::{ArgumentNumber, FunctionKind, Loop, LoopKind, Range, Reach, Statement};
use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{
    Error, Expr, ExprForLoop, ExprLit, ExprLoop, ExprMethodCall, ExprWhile, Ident, Label, Lifetime, Lit, Pat,
    RangeLimits, Result,
};
use xca_spelling::strip;

impl Scope {
    pub(super) fn while_loop(&mut self, while_: &ExprWhile) -> Result<Statement> {
        let label = self.new_label(while_.label.as_ref());
        let condition = self.expression(&while_.cond)?;
        let body = self.in_loop(lifetime(&while_.label), |scope| scope.block(&while_.body))?;
        Ok(Statement::Loop(Loop { label: label?, kind: LoopKind::While(condition), body }))
    }

    pub(super) fn endless_loop(&mut self, loop_: &ExprLoop) -> Result<Statement> {
        let label = self.new_label(loop_.label.as_ref());
        let body = self.in_loop(lifetime(&loop_.label), |scope| scope.block(&loop_.body))?;
        Ok(Statement::Loop(Loop { label: label?, kind: LoopKind::Forever, body }))
    }

    pub(super) fn for_loop(&mut self, for_: &ExprForLoop) -> Result<Statement> {
        let label = self.new_label(for_.label.as_ref());
        let variable = variable(&for_.pat)?;
        let (kind, binding) = self.run_of(variable.clone(), strip(&for_.expr));
        let body = self.nested(|scope| {
            scope.bind(&variable, binding);
            scope.in_loop(lifetime(&for_.label), |scope| scope.block(&for_.body))
        })?;
        Ok(Statement::Loop(Loop { label: label?, kind: kind?, body }))
    }

    /// What a `for` runs over, and what its variable stands for.
    fn run_of(&mut self, variable: Ident, over: &Expr) -> (Result<LoopKind>, Binding) {
        match over {
            Expr::Range(_) => (self.range(variable, over), Binding::Value),
            Expr::MethodCall(call) if self.is_subject(&call.receiver) => {
                let kind =
                    self.search(call).map(|(reach, radius)| LoopKind::Others { variable, reach, radius });
                (kind, Binding::Other(ArgumentNumber::SUBJECT))
            }
            Expr::MethodCall(call) if call.method == "rev" || call.method == "step_by" => {
                (self.range(variable, over), Binding::Value)
            }
            Expr::MethodCall(call) if call.method == "iter_mut" => {
                (Err(Error::new_spanned(&call.method, WRITE_BY_INDEX)), Binding::Value)
            }
            Expr::Path(_) if let Some(Binding::Slots(argument)) = self.named(over) => {
                (Ok(LoopKind::Items { variable }), Binding::Other(argument))
            }
            Expr::Reference(reference)
                if let Some(Binding::Slots(argument)) = self.named(&reference.expr) =>
            {
                let advice = "it is a reference already: leave out the `&`";
                (Err(Error::new_spanned(reference, advice)), Binding::Other(argument))
            }
            Expr::Reference(reference) if reference.mutability.is_some() => {
                (Err(Error::new_spanned(reference, WRITE_BY_INDEX)), Binding::Value)
            }
            Expr::Reference(reference) => {
                let kind =
                    self.expression(&reference.expr).map(|array| LoopKind::Elements { variable, array });
                (kind, Binding::Value)
            }
            Expr::Lit(literal) => {
                let advice =
                    "a `for` runs over a range (`for i in 0..n`) or an array (`for value in values`)";
                (Err(Error::new_spanned(literal, advice)), Binding::Value)
            }
            array => {
                let kind = self.expression(array).map(|array| LoopKind::Elements { variable, array });
                (kind, Binding::Value)
            }
        }
    }

    /// `a..b`, `(a..b).rev()`, `(a..b).step_by(k)`, `(a..b).rev().step_by(k)`.
    fn range(&mut self, variable: Ident, over: &Expr) -> Result<LoopKind> {
        let (over, step) = match strip(over) {
            Expr::MethodCall(call) if call.method == "step_by" => {
                let [step] = self.arguments(call, "`step_by` takes the step: `(0..n).step_by(2)`")?;
                check_step(strip(&call.args[0]))?;
                (strip(&call.receiver), Some(step))
            }
            over => (over, None),
        };
        let (over, reversed) = match over {
            Expr::MethodCall(call) if call.method == "rev" => {
                let [] = self.arguments(call, "`rev()` takes no arguments")?;
                (strip(&call.receiver), true)
            }
            over => (over, false),
        };
        let Expr::Range(range) = over else {
            let advice = match over {
                Expr::MethodCall(call) if reversed && call.method == "step_by" => {
                    "turn the range first: `(0..n).rev().step_by(k)`, which begins at the end"
                }
                _ if step.is_some() || reversed => {
                    "only ranges run backwards or in steps: `for i in (0..values.len()).rev() { … values[i] … }`"
                }
                _ => "a `for` runs over a range, `for i in 0..n`",
            };
            return Err(Error::new_spanned(over, advice));
        };
        let (Some(from), Some(to)) = (&range.start, &range.end) else {
            return Err(Error::new_spanned(range, "give both ends of the range: `0..n`"));
        };
        let inclusive = matches!(range.limits, RangeLimits::Closed(_));
        let (from, to) = both(self.expression(from), self.expression(to))?;
        Ok(LoopKind::Range { variable, range: Range { from, to, inclusive, reversed, step } })
    }

    /// The label of a loop, which no loop around it has.
    fn new_label(&self, label: Option<&Label>) -> Result<Option<Lifetime>> {
        let Some(label) = label else { return Ok(None) };
        let name = label.name.ident.to_string();
        if self.labels().any(|known| known == name) {
            return Err(Error::new_spanned(
                &label.name,
                format!("a loop around this one is `'{name}` already; choose another label"),
            ));
        }
        Ok(Some(label.name.clone()))
    }

    /// That there is a loop for a `break` or a `continue`.
    pub(super) fn check_in_loop(&self, label: Option<&Lifetime>, span: Span) -> Result<()> {
        if !self.inside_loop() {
            return Err(Error::new(span, "there is no loop around this"));
        }
        let Some(label) = label else { return Ok(()) };
        let name = label.ident.to_string();
        if self.labels().any(|known| known == name) {
            return Ok(());
        }
        let message = match super::similar::similar(&name, self.labels()) {
            Some(similar) => format!("no loop around this is `'{name}`; did you mean `'{similar}`?"),
            None => {
                format!("no loop around this is `'{name}`; write `'{name}: for …` where that loop begins")
            }
        };
        Err(Error::new_spanned(label, message))
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
}

/// Refuses a step that is written as 0 or as a float.
fn check_step(step: &Expr) -> Result<()> {
    let Expr::Lit(ExprLit { lit, .. }) = step else { return Ok(()) };
    let is_none = match lit {
        Lit::Int(number) => number.base10_digits() == "0",
        Lit::Float(_) => true,
        _ => false,
    };
    let advice = "the step of a range is a whole number of at least 1";
    if is_none { Err(Error::new_spanned(step, advice)) } else { Ok(()) }
}

fn lifetime(label: &Option<Label>) -> Option<&Lifetime> {
    label.as_ref().map(|label| &label.name)
}

fn variable(pattern: &Pat) -> Result<Ident> {
    match pattern {
        Pat::Ident(pattern)
            if pattern.by_ref.is_none() && pattern.mutability.is_none() && pattern.subpat.is_none() =>
        {
            Ok(pattern.ident.clone())
        }
        Pat::Wild(underscore) => Ok(Ident::new("_unused", underscore.span())),
        other => Err(Error::new_spanned(
            other,
            "the variable of a `for` is a plain name: `for i in 0..n`; only `enumerate` gives pairs",
        )),
    }
}
