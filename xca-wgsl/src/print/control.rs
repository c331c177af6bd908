//! Branches and loops. `match` becomes a chain of `if`: in a `switch`, WGSL's `break` would mean the switch.

use super::expression::is_simple;
use super::range::Range;
use super::text::{Level, Text};
use super::{Target, Writer};
use crate::error::Problem;
use crate::types::Type;
use crate::visit;
use xca_core::ScalarType;
use xca_core::ir::{Arm, Block, Builtin, Expression, Literal, Pattern, Statement};

/// The largest neighbourhood over which loops are written out.
const MOST_WRITTEN_OUT: usize = 32;

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

    /// The body of a loop, without its braces.
    pub(super) fn loop_body(&mut self, flag: Option<String>, body: &Block) -> Result<(), Problem> {
        self.loops.push(flag);
        let result = self.inside(|writer| writer.block_into(body, Target::Nowhere));
        self.loops.pop();
        result
    }

    pub(super) fn while_(&mut self, condition: &Expression, body: &Block) -> Result<(), Problem> {
        if self.hoists(condition) {
            self.line("loop {");
            self.inside(|writer| {
                writer.end_after_fault();
                let text = writer.expression(condition)?;
                writer.line(&format!("if {} {{", text.inverted("!").plain()));
                writer.line("    break;");
                writer.line("}");
                writer.indent -= 1;
                let result = writer.loop_body(None, body);
                writer.indent += 1;
                result
            })?;
        } else {
            let text = self.expression(condition)?;
            self.line(&format!("while {} {{", text.plain()));
            self.long_body(true, body)?;
        }
        self.line("}");
        Ok(())
    }

    /// The indices of a loop over neighbours that is written out: where their places are known, and nothing leaves a turn of it early.
    fn written_out(
        &self,
        from: &Expression,
        to: &Expression,
        inclusive: bool,
        body: &Block,
    ) -> Option<std::ops::Range<usize>> {
        let offsets = self.shared.options.neighbour_offsets.as_ref()?;
        let over_neighbours = !inclusive && matches!(to, Expression::Builtin(Builtin::NeighbourCount, _));
        let Expression::Literal(Literal::Integer(first, _)) = from else { return None };
        let first = usize::try_from(*first).ok()?;
        (over_neighbours
            && offsets.len() <= MOST_WRITTEN_OUT
            && !visit::breaks(body)
            && !visit::continues(body))
        .then_some(first..offsets.len())
    }

    /// The body of a loop that may be a long one.
    pub(super) fn long_body(&mut self, long: bool, body: &Block) -> Result<(), Problem> {
        if long {
            self.inside(|writer| {
                writer.end_after_fault();
                Ok(())
            })?;
        }
        self.loop_body(None, body)
    }

    pub(super) fn for_range(
        &mut self,
        statement: &Statement,
        from: &Expression,
        to: &Expression,
        inclusive: bool,
        body: &Block,
    ) -> Result<(), Problem> {
        let Statement::ForRange { variable, .. } = statement else { return Ok(()) };
        let number = self.analysis.bound(statement)?;
        let type_ = self.analysis.locals[number.0].type_.clone();
        if let Some(indices) = self.written_out(from, to, inclusive, body) {
            for index in indices {
                self.line("{");
                self.shared.names.open();
                let local = self.shared.names.local(variable);
                self.locals.insert(number, local.clone());
                self.counted.insert(number, index);
                self.note_range(number, Range::only(index as i64));
                self.line(&format!("    let {local}: {} = {index}u;", type_.wgsl()));
                self.loop_body(None, body)?;
                self.shared.names.close();
                self.line("}");
            }
            self.counted.remove(&number);
            return Ok(());
        }
        let one = self.one(&type_)?;
        let texts = self.operands(&[from, to])?;
        let long = self.may_take_long(from, to);
        let range = self.counted_range(from, to, inclusive);
        self.note_range(number, range);
        let [from, to_text] = [texts[0].clone(), texts[1].clone()];
        let end = self.end(to, to_text);
        self.note_neighbour(statement, to, inclusive)?;
        let name = type_.wgsl();
        if inclusive && !below_largest(to, &type_) {
            let local = self.shared.names.local(variable);
            self.locals.insert(number, local.clone());
            // The end may be the largest number of its type, beyond which counting would begin again.
            let more = self.shared.names.local("more");
            self.line(&format!("var {local}: {name} = {};", from.plain()));
            self.line(&format!("var {more}: bool = {local} <= {end};"));
            self.line("loop {");
            self.line(&format!("    if !{more} {{"));
            self.line("        break;");
            self.line("    }");
            self.long_body(long, body)?;
            self.line("    continuing {");
            self.line(&format!("        {more} = {local} != {end};"));
            self.line(&format!("        {local} += {one};"));
            self.line("    }");
        } else {
            self.shared.names.open();
            let local = self.shared.names.local(variable);
            self.locals.insert(number, local.clone());
            let sign = if inclusive { "<=" } else { "<" };
            let from = from.plain();
            self.line(&format!(
                "for (var {local}: {name} = {from}; {local} {sign} {end}; {local} += {one}) {{"
            ));
            self.long_body(long, body)?;
            self.shared.names.close();
        }
        self.line("}");
        Ok(())
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

/// Whether the end of a range is a literal below the largest number of its type. A `u8` has room above it.
fn below_largest(to: &Expression, type_: &Type) -> bool {
    let largest = match type_ {
        Type::Scalar(ScalarType::U8) => return true,
        Type::Scalar(ScalarType::I32) => u64::from(i32::MAX.unsigned_abs()),
        _ => u64::from(u32::MAX),
    };
    matches!(to, Expression::Literal(Literal::Integer(value, _)) if *value < largest)
}
