//! Elements of arrays, and divisions: what Rust stops a process for where it has no result.

use super::range::Range;
use super::text::{Level, Text};
use super::writer::Writer;
use crate::error::Problem;
use crate::types::{self, Type};
use crate::visit;
use xca_core::ir::{BinaryOperator, Builtin, Expression, Operation};

impl Writer<'_, '_> {
    /// `array[index]`: of one that stands in memory, without loading the others.
    pub(super) fn element(&mut self, array: &Expression, index: &Expression) -> Result<Text, Problem> {
        let length = self.length(array)?;
        let (argument, field, number) = match array {
            Expression::Neighbour { argument, index: neighbour, field } => {
                let mut number = self.neighbour(neighbour)?;
                if self.hoists(index) {
                    number = self.keep("there", &Type::U32, &number);
                }
                (*argument, *field, number)
            }
            Expression::NamedNeighbour { argument, field, .. }
            | Expression::Other { argument, field, .. } => {
                (*argument, *field, Text::primary(self.local(self.analysis.local(array)?)?))
            }
            Expression::Own(field) if !self.shared.glossary.buffer(0, field)?.used.centre => {
                (0, *field, Text::primary(if self.over_cells() { "here" } else { "this_item" }))
            }
            Expression::OfCell { argument, field }
                if !self.shared.glossary.buffer(*argument, field)?.used.centre =>
            {
                (*argument, *field, Text::primary("here"))
            }
            Expression::Parameter { argument, field } => {
                let index = self.index(index, length)?;
                let text = format!("{}[{}]", self.parameter(argument, field)?, index.plain());
                return Ok(Text::primary(match self.analysis.type_of(array) {
                    Type::Array(element, _) if **element == Type::Bool => {
                        types::loaded(xca_core::ScalarType::Bool, &text)
                    }
                    _ => text,
                }));
            }
            _ => {
                let mut text = self.expression(array)?;
                if self.hoists(index) && (!self.stable(array) || self.may_stop(array)) {
                    let type_ = self.type_of(array);
                    text = self.keep("operand", &type_, &text);
                }
                let index = self.index(index, length)?;
                return Ok(Text::primary(format!("{}[{}]", text.at_least(Level::Primary), index.plain())));
            }
        };
        let index = self.index(index, length)?;
        let buffer = self.shared.glossary.buffer(argument, field)?;
        let (number, index) = (number.at_least(Level::Unary), index.right_of(Level::Multiplicative));
        Ok(Text::primary(buffer.read_element(&number, &index)))
    }

    fn length(&self, array: &Expression) -> Result<usize, Problem> {
        let type_ = self.analysis.type_of(array);
        let array = type_.array().map(|(_, length)| length);
        array.ok_or_else(|| Problem::unsupported("an index in brackets", "the value is no array"))
    }

    /// An index into an array of so many elements: checked where it may lie beyond.
    pub(super) fn index(&mut self, index: &Expression, length: usize) -> Result<Text, Problem> {
        let text = self.expression(index)?;
        if self.is_within(index, length) {
            return Ok(text);
        }
        let routine = self.shared.routines.need_index();
        Ok(Text::primary(format!("{routine}({}, {length}u)", text.argument())))
    }

    /// Whether an index surely lies in an array of so many elements.
    pub(super) fn is_within(&self, index: &Expression, length: usize) -> bool {
        let last = i64::try_from(length).map_or(i64::MAX, |length| length - 1);
        self.range(index).lies_within(Range::new(0, last))
    }

    /// `left / right` or `left % right` of integers.
    pub(super) fn quotient(
        &mut self,
        operator: BinaryOperator,
        (left, left_type, dividend): (&Text, &Type, Range),
        (right, right_type, divisor): (&Text, &Type, Range),
    ) -> Result<Text, Problem> {
        let type_ = if right_type.lanes() > 1 { right_type } else { left_type };
        if !divisor.may_stop_division_of(dividend, type_) {
            return self.combined(operator, (left, left_type), (right, right_type));
        }
        let routine = self.shared.routines.need_quotient(operator == BinaryOperator::Remainder, type_);
        let argument = |text: &Text, of: &Type| {
            if of.lanes() < type_.lanes() {
                format!("{}({})", type_.wgsl(), text.plain())
            } else {
                text.argument()
            }
        };
        let (left, right) = (argument(left, left_type), argument(right, right_type));
        Ok(Text::primary(format!("{routine}({left}, {right})")))
    }

    /// Whether computing the value may stop the process.
    pub(super) fn may_stop(&self, value: &Expression) -> bool {
        let mut found = false;
        visit::expression(value, &mut |node| {
            if let visit::Node::Expression(inner) = node {
                found |= match inner {
                    Expression::Element(array, index) => {
                        !self.length(array).is_ok_and(|length| self.is_within(index, length))
                    }
                    Expression::Binary(BinaryOperator::Divide | BinaryOperator::Remainder, left, right) => {
                        let type_ = self.analysis.type_of(left);
                        !type_.is_float() && self.range(right).may_stop_division_of(self.range(left), type_)
                    }
                    Expression::Method { method, receiver, arguments } => {
                        let type_ = self.analysis.type_of(receiver);
                        let divides = matches!(method, Operation::RemainderEuclid | Operation::DivideEuclid);
                        divides
                            && !type_.is_float()
                            && arguments.iter().any(|divisor| {
                                self.range(divisor).may_stop_division_of(self.range(receiver), type_)
                            })
                    }
                    Expression::Neighbour { .. } | Expression::Call { .. } => true,
                    Expression::Builtin(builtin, _) => {
                        matches!(builtin, Builtin::Opposite | Builtin::Displacement | Builtin::Exists)
                    }
                    _ => false,
                };
            }
            !found
        });
        found
    }
}

/// Whether an operator is a division, of which integers have not all results.
pub(super) fn is_division(operator: BinaryOperator) -> bool {
    matches!(operator, BinaryOperator::Divide | BinaryOperator::Remainder)
}
