//! Statements.

use super::element::is_division;
use super::expression::{is_simple, list};
use super::range::Range;
use super::text::{Level, Text};
use super::writer::{Target, Writer};
use crate::error::Problem;
use crate::types::Type;
use crate::visit;
use xca_core::ScalarType;
use xca_core::ir::{
    BinaryOperator, Block, Builtin, Constant, Expression, Literal, Place, PlaceRoot, Projection, Statement,
    TuplePart,
};

impl Writer<'_, '_> {
    /// Writes the statements of a block, and its value to where it belongs.
    pub(super) fn block_into(&mut self, block: &Block, target: Target<'_>) -> Result<(), Problem> {
        for statement in &block.statements {
            self.statement(statement)?;
        }
        match &block.value {
            Some(value) => self.value_into(value, target),
            None => Ok(()),
        }
    }

    /// Writes what computes a value and puts it where it belongs.
    pub(super) fn value_into(&mut self, value: &Expression, target: Target<'_>) -> Result<(), Problem> {
        let target = if *self.analysis.type_of(value) == Type::Unit { Target::Nowhere } else { target };
        match value {
            Expression::If { condition, then, otherwise } => {
                self.if_into(condition, then, otherwise.as_ref(), target)
            }
            Expression::Match { value, arms } => self.match_into(value, arms, target),
            Expression::Block(Block { statements, value: Some(inner) }) if statements.is_empty() => {
                self.value_into(inner, target)
            }
            Expression::Block(block) => {
                self.line("{");
                self.inside(|writer| writer.block_into(block, target))?;
                self.line("}");
                Ok(())
            }
            other => {
                let text = self.expression(other)?;
                match target {
                    Target::Nowhere => self.line(&format!("_ = {};", text.plain())),
                    Target::Variable(name) => self.line(&format!("{name} = {};", text.plain())),
                    Target::Return => self.line(&format!("return {};", text.plain())),
                }
                Ok(())
            }
        }
    }

    fn statement(&mut self, statement: &Statement) -> Result<(), Problem> {
        match statement {
            Statement::Let { name, mutable, value, .. } => self.let_(statement, name, *mutable, value),
            Statement::LetTuple { parts, value, .. } => self.let_tuple(parts, value),
            Statement::LetNeighbour { name, index } => {
                let number = self.neighbour(index)?;
                let local = self.shared.names.local(name);
                self.line(&format!("let {local}: u32 = {};", number.plain()));
                self.locals.insert(self.analysis.bound(statement)?, local);
                Ok(())
            }
            Statement::Assign { place, operator, value } => self.assign(place, *operator, value),
            Statement::Expression(value) => self.value_into(value, Target::Nowhere),
            Statement::Loop(loop_) => self.loop_(statement, loop_),
            Statement::Break(label) => {
                self.jump(true, *label);
                Ok(())
            }
            Statement::Continue(label) => {
                self.jump(false, *label);
                Ok(())
            }
            Statement::Return(None) => {
                self.line("return;");
                Ok(())
            }
            Statement::Return(Some(value)) => self.value_into(value, Target::Return),
            Statement::Fault { code, value } => {
                let texts = self.operands(&[code, value])?;
                self.line(&format!("report_fault({});", list(&texts)));
                Ok(())
            }
        }
    }

    fn let_(
        &mut self,
        statement: &Statement,
        name: &str,
        mutable: bool,
        value: &Expression,
    ) -> Result<(), Problem> {
        let number = self.analysis.bound(statement)?;
        let type_ = self.analysis.locals[number.0].type_.clone();
        self.check_type(&type_)?;
        if type_ == Type::Unit {
            return self.value_into(value, Target::Nowhere);
        }
        let spread = match value {
            Expression::Match { .. } | Expression::Block(_) => true,
            Expression::If { .. } => self.hoists(value),
            _ => false,
        };
        let local;
        if spread {
            local = self.shared.names.local(name);
            self.line(&format!("var {local}: {};", type_.wgsl()));
            self.value_into(value, Target::Variable(&local))?;
        } else {
            let text = self.expression(value)?;
            // An array in a variable can be indexed cheaply.
            let keyword = if mutable || matches!(type_, Type::Array(..)) { "var" } else { "let" };
            local = self.shared.names.local(name);
            self.line(&format!("{keyword} {local}: {} = {};", type_.wgsl(), text.plain()));
        }
        self.locals.insert(number, local);
        let range = self.range(value);
        self.note_range(number, range);
        Ok(())
    }

    fn let_tuple(&mut self, parts: &[TuplePart], value: &Expression) -> Result<(), Problem> {
        let type_ = self.type_of(value);
        self.check_type(&type_)?;
        let Type::Tuple(types) = &type_ else {
            return Err(Problem::unsupported("`let` with a tuple", "the value is none"));
        };
        let text = self.expression(value)?;
        let tuple = self.keep("parts", &type_, &text);
        for (place, (part, type_)) in parts.iter().zip(types).enumerate() {
            let Some(name) = part.name else { continue };
            let keyword = if part.mutable || matches!(type_, Type::Array(..)) { "var" } else { "let" };
            let local = self.shared.names.local(name);
            self.line(&format!("{keyword} {local}: {} = {}.part_{place};", type_.wgsl(), tuple.plain()));
            self.locals.insert(self.analysis.part(part)?, local);
        }
        Ok(())
    }

    fn assign(
        &mut self,
        place: &Place,
        operator: Option<BinaryOperator>,
        value: &Expression,
    ) -> Result<(), Problem> {
        let type_ = self.analysis.type_of_place(place).clone();
        let Some(operator) = operator else {
            if place.path.is_empty()
                && matches!(value, Expression::If { .. } | Expression::Match { .. })
                && self.hoists(value)
            {
                // Each branch assigns.
                let target = self.place(place)?;
                return self.value_into(value, Target::Variable(&target));
            }
            let text = self.assigned(place, value)?;
            let target = self.place(place)?;
            self.line(&format!("{target} = {};", text.plain()));
            return Ok(());
        };
        let text = self.assigned(place, value)?;
        let target = self.place(place)?;
        let before = Text::primary(target.clone());
        let value_type = self.type_of(value);
        let short = match operator {
            BinaryOperator::Add => Some("+="),
            BinaryOperator::Subtract => Some("-="),
            BinaryOperator::Multiply => Some("*="),
            BinaryOperator::Divide => Some("/="),
            _ => None,
        };
        if is_division(operator) && !type_.is_float() {
            let dividend = (&before, &type_, Range::of_type(&type_));
            let result = self.quotient(operator, dividend, (&text, &value_type, self.range(value)))?;
            self.line(&format!("{target} = {};", result.plain()));
            return Ok(());
        }
        let result = self.combined(operator, (&before, &type_), (&text, &value_type))?;
        match short {
            Some(short) if !type_.is_u8() => {
                self.line(&format!("{target} {short} {};", text.plain()));
            }
            _ => self.line(&format!("{target} = {};", result.plain())),
        }
        Ok(())
    }

    /// The right-hand side of an assignment, which comes first in Rust.
    fn assigned(&mut self, place: &Place, value: &Expression) -> Result<Text, Problem> {
        let text = self.expression(value)?;
        let indices = || {
            place.path.iter().filter_map(|projection| match projection {
                Projection::Element(index) => Some(index),
                Projection::Component(_) => None,
            })
        };
        // What the place needs stands in statements before.
        let stops = self.may_stop(value) && indices().any(|index| !matches!(index, Expression::Literal(_)));
        if stops || indices().any(|index| self.hoists(index)) && !self.stable(value) {
            let type_ = self.type_of(value);
            return Ok(self.keep("assigned", &type_, &text));
        }
        Ok(text)
    }

    fn place(&mut self, place: &Place) -> Result<String, Problem> {
        let (mut text, mut type_) = match &place.root {
            PlaceRoot::Local(_) => {
                let number = self.analysis.place_root(place)?;
                (self.local(number)?, self.analysis.locals[number.0].type_.clone())
            }
            PlaceRoot::Own(name) => {
                let value_type = self.shared.glossary.buffer(0, name)?.value_type;
                (self.own(name)?, Type::of_value(value_type))
            }
        };
        for projection in &place.path {
            match projection {
                Projection::Component(lane) => {
                    text.push('.');
                    text.push_str(self.lane(*lane)?);
                }
                Projection::Element(index) => {
                    let length = type_.array().map_or(0, |(_, length)| length);
                    let mut number = self.index(index, length)?;
                    // A check stands once in the text, as it is one fault.
                    if !is_simple(index) || !self.is_within(index, length) {
                        number = self.keep("index", &Type::U32, &number);
                    }
                    text = format!("{text}[{}]", number.plain());
                    type_ = type_.array().map_or(Type::Unit, |(element, _)| element.clone());
                }
            }
        }
        Ok(text)
    }

    /// The number of the cell that is the neighbour with this index.
    pub(super) fn neighbour(&mut self, index: &Expression) -> Result<Text, Problem> {
        if let Some(offset) = self.known_offset(index)? {
            return Ok(match offset {
                0 => Text::primary("here".to_owned()),
                _ => {
                    let sign = if offset < 0 { '-' } else { '+' };
                    Text::new(format!("here {sign} {}u", offset.unsigned_abs()), Level::Additive)
                }
            });
        }
        let text = self.neighbour_index(index)?;
        Ok(Text::primary(format!("neighbour_at({})", text.plain())))
    }

    /// The index of a neighbour, checked where it may lie beyond the neighbourhood.
    pub(super) fn neighbour_index(&mut self, index: &Expression) -> Result<Text, Problem> {
        let known = match index {
            Expression::Local(_) => self.neighbours.contains(&self.analysis.local(index)?),
            _ => false,
        };
        let size = self.shared.options.neighbourhood_size;
        let known = known || size.is_some_and(|size| self.is_within(index, size as usize));
        let text = self.expression(index)?;
        if known {
            return Ok(text);
        }
        self.shared.routines.checked_neighbours = true;
        Ok(Text::primary(format!("valid_neighbour({})", text.plain())))
    }

    /// What is asked about where a neighbour lies.
    pub(super) fn direction(&mut self, builtin: Builtin, index: &Expression) -> Result<Text, Problem> {
        let index = self.neighbour_index(index)?;
        let index = index.plain();
        Ok(Text::primary(match builtin {
            Builtin::Opposite => format!("u32(neighbour_direction({index}).w)"),
            Builtin::Exists => {
                self.shared.routines.neighbour_exists = true;
                format!("neighbour_exists({index})")
            }
            _ => format!("neighbour_direction({index}).xyz"),
        }))
    }

    /// How far the neighbour with this index is away, where that is known when the text is written.
    fn known_offset(&self, index: &Expression) -> Result<Option<i32>, Problem> {
        let Some(offsets) = &self.shared.options.neighbour_offsets else { return Ok(None) };
        let number = match index {
            Expression::Local(_) => self.counted.get(&self.analysis.local(index)?).copied(),
            _ => fixed_number(index),
        };
        Ok(number.and_then(|number| offsets.get(number)).copied())
    }

    /// A value that a loop compares with again and again: computed once.
    pub(super) fn end(&mut self, value: &Expression, text: Text) -> String {
        let cheap = is_simple(value) && self.stable(value);
        if cheap {
            return text.at_least(Level::Additive);
        }
        let type_ = self.type_of(value);
        self.keep("end", &type_, &text).plain().to_owned()
    }

    /// The literal one of an integer type.
    pub(super) fn one(&self, type_: &Type) -> Result<&'static str, Problem> {
        match type_ {
            Type::Scalar(ScalarType::I32) => Ok("1i"),
            Type::Scalar(ScalarType::U8 | ScalarType::U32) => Ok("1u"),
            _ => Err(Problem::unsupported("a range", "its ends are integers")),
        }
    }
}

/// The number that a literal or a constant is.
fn fixed_number(index: &Expression) -> Option<usize> {
    match index {
        Expression::Literal(Literal::Integer(number, _)) => usize::try_from(*number).ok(),
        Expression::Constant { value: Constant::U32(number), .. } => usize::try_from(*number).ok(),
        _ => None,
    }
}

/// Whether WGSL sees that every way through the block ends in a `return`.
pub(super) fn ends_in_return(block: &Block) -> bool {
    match (&block.value, block.statements.last()) {
        (Some(value), _) => expression_ends_in_return(value),
        (None, Some(Statement::Return(Some(value)))) => expression_ends_in_return(value),
        (None, Some(Statement::Expression(value))) => {
            visit::expression_diverges(value) && expression_ends_in_return(value)
        }
        _ => false,
    }
}

fn expression_ends_in_return(value: &Expression) -> bool {
    match value {
        Expression::If { then, otherwise: Some(otherwise), .. } => {
            ends_in_return(then) && ends_in_return(otherwise)
        }
        Expression::Match { arms, .. } => {
            arms.last().is_some_and(|arm| arm.guard.is_none())
                && arms.iter().all(|arm| ends_in_return(&arm.body))
        }
        Expression::If { .. } => false,
        Expression::Block(block) => ends_in_return(block),
        _ => true,
    }
}
