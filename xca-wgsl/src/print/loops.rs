//! Loops. WGSL has no labels: a jump to a loop further out sets a flag and ends the loops in between, one by
//! one.

use super::expression::is_simple;
use super::frame::Frame;
use super::range::Range as Numbers;
use super::text::Text;
use super::writer::{Target, Writer};
use crate::error::Problem;
use crate::types::Type;
use crate::visit::{self, Jump};
use xca_core::ScalarType;
use xca_core::ir::{Builtin, Expression, Literal, Loop, LoopKind, Range, Statement};

/// The largest neighbourhood over which loops are written out.
const MOST_WRITTEN_OUT: usize = 32;

impl Writer<'_, '_> {
    pub(super) fn loop_(&mut self, statement: &Statement, loop_: &Loop) -> Result<(), Problem> {
        match &loop_.kind {
            LoopKind::While(condition) => self.while_(condition, loop_)?,
            LoopKind::Forever => {
                self.line("loop {");
                self.long_body(true, loop_)?;
                self.line("}");
            }
            LoopKind::Range { variable, range } => self.for_range(statement, variable, range, loop_)?,
            LoopKind::Elements { variable, array } => self.for_elements(statement, variable, array, loop_)?,
            LoopKind::Others { variable, reach, radius } => {
                self.for_others(statement, variable, *reach, radius.as_ref(), loop_)?;
            }
            LoopKind::Items { variable } => self.for_items(statement, variable, loop_)?,
        }
        self.go_on_jumping(loop_);
        Ok(())
    }

    /// The body of a loop, without its braces.
    pub(super) fn loop_body(&mut self, mut frame: Frame, loop_: &Loop) -> Result<(), Problem> {
        self.inside(|writer| {
            if visit::jumps_from_within(loop_, true) {
                frame.left = Some(writer.flag("left"));
            }
            if visit::jumps_from_within(loop_, false) {
                frame.continued = Some(writer.flag("continued"));
            }
            writer.loops.push(frame);
            let result = writer.block_into(&loop_.body, Target::Nowhere);
            writer.loops.pop();
            result
        })
    }

    /// The body of a loop that may be a long one.
    fn long_body(&mut self, long: bool, loop_: &Loop) -> Result<(), Problem> {
        if long {
            self.inside(|writer| {
                writer.end_after_fault();
                Ok(())
            })?;
        }
        self.loop_body(Frame::new(loop_, None), loop_)
    }

    fn flag(&mut self, name: &str) -> String {
        let name = self.shared.names.local(name);
        self.line(&format!("var {name}: bool = false;"));
        name
    }

    /// `break` and `continue`.
    pub(super) fn jump(&mut self, is_break: bool, label: Option<&'static str>) {
        let flag = label.and_then(|label| {
            let innermost = self.loops.last()?;
            let jump = Jump { label, is_break, stays: false };
            let outer = self.loops.iter().rev().find(|frame| frame.label == Some(label))?;
            if innermost.label == Some(label) { None } else { outer.flag(jump).cloned() }
        });
        match flag {
            Some(flag) => {
                self.line(&format!("{flag} = true;"));
                self.leave();
            }
            None if is_break => self.leave(),
            None => self.line("continue;"),
        }
    }

    /// Ends the innermost loop.
    fn leave(&mut self) {
        if let Some(ended) = self.loops.last().and_then(|frame| frame.ended.clone()) {
            self.line(&format!("{ended} = true;"));
        }
        self.line("break;");
    }

    /// After a loop that was ended by a jump to a loop further out.
    fn go_on_jumping(&mut self, loop_: &Loop) {
        let mut flags: Vec<(String, bool)> = Vec::new();
        for jump in visit::labelled(&loop_.body).filter(|jump| !jump.stays) {
            let frames = self.loops.iter().enumerate();
            let target = frames.rev().find_map(|(depth, frame)| Some((depth, frame.flag(jump)?.clone())));
            let Some((depth, flag)) = target else { continue };
            let continues = !jump.is_break && depth + 1 == self.loops.len();
            if !flags.iter().any(|(known, _)| *known == flag) {
                flags.push((flag, continues));
            }
        }
        for (flag, continues) in flags {
            self.line(&format!("if {flag} {{"));
            self.indent += 1;
            if continues {
                self.line("continue;");
            } else {
                self.leave();
            }
            self.indent -= 1;
            self.line("}");
        }
    }

    fn while_(&mut self, condition: &Expression, loop_: &Loop) -> Result<(), Problem> {
        if self.hoists(condition) {
            self.line("loop {");
            self.inside(|writer| {
                writer.end_after_fault();
                let text = writer.expression(condition)?;
                writer.line(&format!("if {} {{", text.inverted("!").plain()));
                writer.line("    break;");
                writer.line("}");
                writer.indent -= 1;
                let result = writer.loop_body(Frame::new(loop_, None), loop_);
                writer.indent += 1;
                result
            })?;
        } else {
            let text = self.expression(condition)?;
            self.line(&format!("while {} {{", text.plain()));
            self.long_body(true, loop_)?;
        }
        self.line("}");
        Ok(())
    }

    /// The indices of a loop over neighbours that is written out: where their places are known, and nothing
    /// leaves a turn of it early.
    fn written_out(&self, range: &Range, loop_: &Loop) -> Option<std::ops::Range<usize>> {
        let offsets = self.shared.options.neighbour_offsets.as_ref()?;
        let whole = !range.inclusive && !range.reversed && range.step.is_none();
        let over_neighbours = whole && matches!(range.to, Expression::Builtin(Builtin::NeighbourCount, _));
        let Expression::Literal(Literal::Integer(first, _)) = range.from else { return None };
        let first = usize::try_from(first).ok()?;
        (over_neighbours && offsets.len() <= MOST_WRITTEN_OUT && !visit::turns_end_early(loop_))
            .then_some(first..offsets.len())
    }

    fn for_range(
        &mut self,
        statement: &Statement,
        variable: &str,
        range: &Range,
        loop_: &Loop,
    ) -> Result<(), Problem> {
        let number = self.analysis.bound(statement)?;
        let type_ = self.analysis.locals[number.0].type_.clone();
        if let Some(indices) = self.written_out(range, loop_) {
            for index in indices {
                self.line("{");
                self.shared.names.open();
                let local = self.shared.names.local(variable);
                self.locals.insert(number, local.clone());
                self.counted.insert(number, index);
                self.note_range(number, Numbers::only(index as i64));
                self.line(&format!("    let {local}: {} = {index}u;", type_.wgsl()));
                self.loop_body(Frame::new(loop_, None), loop_)?;
                self.shared.names.close();
                self.line("}");
            }
            self.counted.remove(&number);
            return Ok(());
        }
        if range.reversed || range.step.is_some() {
            return self.for_counted_range(statement, variable, range, loop_);
        }
        let one = self.one(&type_)?;
        let texts = self.operands(&[&range.from, &range.to])?;
        let long = self.may_take_long(&range.from, &range.to);
        let numbers = self.counted_range(&range.from, &range.to, range.inclusive);
        self.note_range(number, numbers);
        let [from, to_text] = [texts[0].clone(), texts[1].clone()];
        let end = self.end(&range.to, to_text);
        self.note_neighbour(statement, range)?;
        let name = type_.wgsl();
        if range.inclusive && !below_largest(&range.to, &type_) {
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
            self.long_body(long, loop_)?;
            self.line("    continuing {");
            self.line(&format!("        {more} = {local} != {end};"));
            self.line(&format!("        {local} += {one};"));
            self.line("    }");
        } else {
            self.shared.names.open();
            let local = self.shared.names.local(variable);
            self.locals.insert(number, local.clone());
            let sign = if range.inclusive { "<=" } else { "<" };
            let from = from.plain();
            self.line(&format!(
                "for (var {local}: {name} = {from}; {local} {sign} {end}; {local} += {one}) {{"
            ));
            self.long_body(long, loop_)?;
            self.shared.names.close();
        }
        self.line("}");
        Ok(())
    }

    /// A range that runs backwards or in steps. It counts the turns that are left, so that no number goes
    /// beyond its type.
    fn for_counted_range(
        &mut self,
        statement: &Statement,
        variable: &str,
        range: &Range,
        loop_: &Loop,
    ) -> Result<(), Problem> {
        let number = self.analysis.bound(statement)?;
        let type_ = self.analysis.locals[number.0].type_.clone();
        let (one, name) = (self.one(&type_)?, type_.wgsl());
        let mut values = vec![&range.from, &range.to];
        values.extend(&range.step);
        let texts = self.operands(&values)?;
        let long = self.may_take_long(&range.from, &range.to);
        let numbers = self.counted_range(&range.from, &range.to, range.inclusive);
        self.note_range(number, numbers);
        let first = self.keep("first", &type_, &texts[0]);
        let end = self.keep("end", &type_, &texts[1]);
        let step = range.step.as_ref().zip(texts.get(2)).map(|(step, text)| {
            let text = if self.range(step).may_be_zero() {
                let routine = self.shared.routines.need_step();
                Text::primary(format!("{routine}({})", text.argument()))
            } else {
                text.clone()
            };
            self.keep("step", &Type::U32, &text)
        });
        self.note_neighbour(statement, range)?;
        let (first, end) = (first.plain(), end.plain());
        let sign = if range.inclusive { "<=" } else { "<" };
        self.line(&format!("if {first} {sign} {end} {{"));
        self.inside(|writer| {
            let last = if range.inclusive { end.to_owned() } else { format!("{end} - {one}") };
            let local = writer.shared.names.local(variable);
            writer.locals.insert(number, local.clone());
            let from = if range.reversed { &last } else { first };
            writer.line(&format!("var {local}: {name} = {from};"));
            let turns = writer.shared.names.local("turns");
            let distance = format!("u32({last}) - u32({first})");
            let (count, places) = match &step {
                Some(step) => {
                    (format!("({distance}) / {}", step.plain()), format!("{name}({})", step.plain()))
                }
                None => (distance, one.to_owned()),
            };
            writer.line(&format!("var {turns}: u32 = {count};"));
            writer.line("loop {");
            writer.long_body(long, loop_)?;
            writer.line("    continuing {");
            let operator = if range.reversed { "-=" } else { "+=" };
            writer.line(&format!("        {local} {operator} {places};"));
            // From 0 the number of turns wraps.
            writer.line(&format!("        {turns} -= 1u;"));
            writer.line(&format!("        break if {turns} == 0xffffffffu;"));
            writer.line("    }");
            writer.line("}");
            Ok(())
        })?;
        self.line("}");
        Ok(())
    }

    fn for_elements(
        &mut self,
        statement: &Statement,
        variable: &str,
        array: &Expression,
        loop_: &Loop,
    ) -> Result<(), Problem> {
        let Type::Array(element, length) = self.type_of(array) else {
            return Err(Problem::unsupported("`for`", "what it runs over is no array"));
        };
        let array_type = Type::Array(element.clone(), length);
        self.check_type(&array_type)?;
        let text = self.expression(array)?;
        let elements = if is_simple(array) && self.stable(array) {
            text.plain().to_owned()
        } else {
            let name = self.shared.names.local("elements");
            self.line(&format!("var {name}: {} = {};", array_type.wgsl(), text.plain()));
            name
        };
        self.shared.names.open();
        let place = self.shared.names.local("place");
        self.line(&format!("for (var {place}: u32 = 0u; {place} < {length}u; {place} += 1u) {{"));
        self.inside(|writer| {
            let local = writer.shared.names.local(variable);
            writer.line(&format!("let {local}: {} = {elements}[{place}];", element.wgsl()));
            writer.locals.insert(writer.analysis.bound(statement)?, local);
            writer.indent -= 1;
            let result = writer.loop_body(Frame::new(loop_, None), loop_);
            writer.indent += 1;
            result
        })?;
        self.line("}");
        self.shared.names.close();
        Ok(())
    }

    /// Remembers that a variable is the index of an existing neighbour.
    fn note_neighbour(&mut self, statement: &Statement, range: &Range) -> Result<(), Problem> {
        if !range.inclusive && matches!(range.to, Expression::Builtin(Builtin::NeighbourCount, _)) {
            self.neighbours.insert(self.analysis.bound(statement)?);
        }
        Ok(())
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
