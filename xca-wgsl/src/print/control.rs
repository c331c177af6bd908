//! Branches. `match` becomes a chain of `if`: in a `switch`, WGSL's `break` would mean the switch.

use super::expression::is_simple;
use super::text::{Level, Text};
use super::writer::{Target, Writer};
use crate::error::Problem;
use xca_core::ir::{Arm, Block, Expression, Literal, Pattern, Statement};

impl Writer<'_, '_> {
    pub(super) fn if_into(
        &mut self,
        condition: &Expression,
        then: &Block,
        otherwise: Option<&Block>,
        target: Target<'_>,
    ) -> Result<(), Problem> {
        let mut text = self.expression(condition)?;
        self.line(&format!("if {} {{", text.plain()));
        self.inside(|writer| writer.block_into(then, target))?;
        let mut rest = otherwise;
        let mut depth = 0;
        while let Some(block) = rest {
            let next = match lone_if(block) {
                Some((condition, then, otherwise)) => {
                    if self.hoists(condition) {
                        self.line("} else {");
                        self.indent += 1;
                        self.shared.names.open();
                        depth += 1;
                        text = self.expression(condition)?;
                        self.line(&format!("if {} {{", text.plain()));
                    } else {
                        text = self.expression(condition)?;
                        self.line(&format!("}} else if {} {{", text.plain()));
                    }
                    self.inside(|writer| writer.block_into(then, target))?;
                    otherwise
                }
                None => {
                    self.line("} else {");
                    self.inside(|writer| writer.block_into(block, target))?;
                    None
                }
            };
            rest = next;
        }
        self.line("}");
        self.close(depth);
        Ok(())
    }

    fn close(&mut self, depth: usize) {
        for _ in 0..depth {
            self.shared.names.close();
            self.indent -= 1;
            self.line("}");
        }
    }

    pub(super) fn match_into(
        &mut self,
        value: &Expression,
        arms: &[Arm],
        target: Target<'_>,
    ) -> Result<(), Problem> {
        let type_ = self.type_of(value);
        if !type_.is_discrete() {
            return Err(Problem::unsupported("`match`", "only integers, bool and states are matched"));
        }
        let text = self.expression(value)?;
        let guards_change_it =
            arms.iter().any(|arm| arm.guard.as_ref().is_some_and(|guard| self.hoists(guard)));
        let matched = if is_simple(value) && (self.stable(value) || !guards_change_it) {
            text
        } else {
            self.keep("matched", &type_, &text)
        };
        let mut depth = 0;
        let mut open = false;
        for (position, arm) in arms.iter().enumerate() {
            // Rust has checked that the arms leave nothing out.
            let last = position + 1 == arms.len();
            let mut condition =
                if last && arm.guard.is_none() { None } else { self.patterns(arm, &matched)? };
            if let Some(guard) = &arm.guard {
                if self.hoists(guard) {
                    if open {
                        self.line("} else {");
                        self.indent += 1;
                        self.shared.names.open();
                        depth += 1;
                        open = false;
                    }
                    condition = Some(self.guarded(condition, guard)?);
                } else {
                    let guard = self.expression(guard)?;
                    condition = Some(match condition {
                        Some(condition) => Text::joined(&condition, "&&", &guard, Level::And),
                        None => guard,
                    });
                }
            }
            let opening = match (&condition, open) {
                (Some(condition), false) => format!("if {} {{", condition.plain()),
                (Some(condition), true) => format!("}} else if {} {{", condition.plain()),
                (None, false) => "{".to_owned(),
                (None, true) => "} else {".to_owned(),
            };
            self.line(&opening);
            open = true;
            self.inside(|writer| writer.block_into(&arm.body, target))?;
            if condition.is_none() {
                break;
            }
        }
        if open {
            self.line("}");
        }
        self.close(depth);
        Ok(())
    }

    /// A guard that needs statements is computed only where the pattern fits.
    fn guarded(&mut self, condition: Option<Text>, guard: &Expression) -> Result<Text, Problem> {
        let Some(condition) = condition else { return self.expression(guard) };
        let name = self.shared.names.local("condition");
        self.line(&format!("var {name}: bool = {};", condition.plain()));
        self.line(&format!("if {name} {{"));
        self.inside(|writer| {
            let guard = writer.expression(guard)?;
            writer.line(&format!("{name} = {};", guard.plain()));
            Ok(())
        })?;
        self.line("}");
        Ok(Text::primary(name))
    }

    /// The condition under which one of the patterns fits; nothing where one of them is `_`.
    fn patterns(&mut self, arm: &Arm, matched: &Text) -> Result<Option<Text>, Problem> {
        let mut any: Option<Text> = None;
        for pattern in &arm.patterns {
            let one = match pattern {
                Pattern::Any => return Ok(None),
                Pattern::Value(Expression::Literal(Literal::Bool(true))) => matched.clone(),
                Pattern::Value(Expression::Literal(Literal::Bool(false))) => matched.inverted("!"),
                Pattern::Value(value) => {
                    let value = self.expression(value)?;
                    Text::joined(matched, "==", &value, Level::Relational)
                }
                Pattern::Range(from, to) => {
                    let (from, to) = (self.expression(from)?, self.expression(to)?);
                    let above = Text::joined(matched, ">=", &from, Level::Relational);
                    let below = Text::joined(matched, "<=", &to, Level::Relational);
                    Text::joined(&above, "&&", &below, Level::And)
                }
            };
            any = Some(match any {
                Some(before) => Text::joined(&before, "||", &one, Level::Or),
                None => one,
            });
        }
        Ok(any)
    }
}

/// A block that is nothing but an `if`: it continues a chain.
fn lone_if(block: &Block) -> Option<(&Expression, &Block, Option<&Block>)> {
    let only = match (block.statements.as_slice(), &block.value) {
        ([], Some(value)) => &**value,
        ([Statement::Expression(value)], None) => value,
        _ => return None,
    };
    match only {
        Expression::If { condition, then, otherwise } => Some((condition, then, otherwise.as_ref())),
        _ => None,
    }
}
