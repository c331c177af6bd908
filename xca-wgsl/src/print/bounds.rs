//! Which numbers an integer can be, so that what cannot go wrong is not checked.

use super::range::Range;
use super::writer::Writer;
use crate::inference::LocalNumber;
use crate::types::Type;
use xca_core::ir::{BinaryOperator, Block, Builtin, Constant, Expression, Literal, Operation, UnaryOperator};

/// More turns than this, and a loop may take longer than a device lets it.
const MANY_TURNS: i64 = 1 << 16;

impl Writer<'_, '_> {
    /// The numbers that an integer, a bool or a state can be; of vectors, those of any lane.
    pub(super) fn range(&self, value: &Expression) -> Range {
        let type_ = self.analysis.type_of(value);
        let all = Range::of_type(type_);
        match self.known_range(value) {
            // Beyond the type it has wrapped around.
            Some(range) if range.lies_within(all) => range,
            _ => all,
        }
    }

    fn known_range(&self, value: &Expression) -> Option<Range> {
        Some(match value {
            Expression::Literal(Literal::Integer(number, _)) => Range::only(i64::try_from(*number).ok()?),
            Expression::Literal(Literal::Bool(truth)) => Range::only(i64::from(*truth)),
            Expression::Constant { value, .. } => constant_range(value)?,
            Expression::Local(_) => *self.ranges.get(&self.analysis.local(value).ok()?)?,
            Expression::Builtin(Builtin::NeighbourCount, _) => match self.shared.options.neighbourhood_size {
                Some(size) => Range::only(size.into()),
                None => Range::new(1, u32::MAX.into()),
            },
            Expression::Builtin(Builtin::Opposite, _) => {
                let size = self.shared.options.neighbourhood_size?;
                Range::new(0, i64::from(size) - 1)
            }
            Expression::Unary(UnaryOperator::Negate, operand) => {
                let range = self.range(operand);
                Range::new(-range.most, -range.least)
            }
            Expression::Binary(operator, left, right) => self.operator_range(*operator, left, right)?,
            // The same number, where the type has it.
            Expression::Cast(operand, _) if self.is_whole(operand) => self.range(operand),
            Expression::Method { method, receiver, arguments } => {
                self.method_range(*method, receiver, arguments)?
            }
            Expression::Element(array, _) => match &**array {
                Expression::Constant { value, .. } => constant_range(value)?,
                _ => return None,
            },
            Expression::Component(operand, _) | Expression::Splat(operand, _) => self.range(operand),
            Expression::Vector(components) => {
                components.iter().map(|component| self.range(component)).reduce(Range::with)?
            }
            Expression::If { then, otherwise: Some(otherwise), .. } => {
                self.block_range(then)?.with(self.block_range(otherwise)?)
            }
            Expression::Match { arms, .. } => arms
                .iter()
                .map(|arm| self.block_range(&arm.body))
                .collect::<Option<Vec<_>>>()?
                .into_iter()
                .reduce(Range::with)?,
            Expression::Block(block) => self.block_range(block)?,
            _ => return None,
        })
    }

    /// Of blocks without statements: variables of others are not known before they are written.
    fn block_range(&self, block: &Block) -> Option<Range> {
        block.value.as_deref().filter(|_| block.statements.is_empty()).map(|value| self.range(value))
    }

    fn operator_range(
        &self,
        operator: BinaryOperator,
        left: &Expression,
        right: &Expression,
    ) -> Option<Range> {
        if !self.is_whole(left) || !self.is_whole(right) {
            return None;
        }
        let (left, right) = (self.range(left), self.range(right));
        let positive = left.least >= 0 && right.least >= 0;
        Some(match operator {
            BinaryOperator::Add => left.ends(right, |a, b| a + b),
            BinaryOperator::Subtract => left.ends(right, |a, b| a - b),
            BinaryOperator::Multiply => left.ends(right, i64::saturating_mul),
            BinaryOperator::Divide if right.least > 0 => left.ends(right, |a, b| a / b),
            // A remainder without a result stops the process.
            BinaryOperator::Remainder if right != Range::only(0) => left.remainder(right),
            BinaryOperator::BitAnd if positive => Range::new(0, left.most.min(right.most)),
            BinaryOperator::BitAnd if right.least >= 0 => Range::new(0, right.most),
            BinaryOperator::BitAnd if left.least >= 0 => Range::new(0, left.most),
            BinaryOperator::ShiftRight if positive && right.most < 32 => left.ends(right, |a, b| a >> b),
            _ => return None,
        })
    }

    fn method_range(
        &self,
        operation: Operation,
        receiver: &Expression,
        arguments: &[Expression],
    ) -> Option<Range> {
        match (operation, self.analysis.type_of(receiver)) {
            (Operation::CountOnes, _) => return Some(Range::new(0, 32)),
            (Operation::Len, Type::Array(_, length)) => {
                return Some(Range::only(i64::try_from(*length).ok()?));
            }
            _ => {}
        }
        if !self.is_whole(receiver) {
            return None;
        }
        let of = self.range(receiver);
        let argument = |number: usize| arguments.get(number).map(|argument| self.range(argument));
        let smaller = |a: Range, b: Range| Range::new(a.least.min(b.least), a.most.min(b.most));
        let larger = |a: Range, b: Range| Range::new(a.least.max(b.least), a.most.max(b.most));
        Some(match operation {
            Operation::Min => smaller(of, argument(0)?),
            Operation::Max => larger(of, argument(0)?),
            Operation::Clamp => smaller(larger(of, argument(0)?), argument(1)?),
            Operation::Abs if of.least >= 0 => of,
            Operation::Abs => Range::new(0, of.most.max(-of.least)),
            _ => return None,
        })
    }

    /// Whether it is a whole number, a bool or a state.
    fn is_whole(&self, value: &Expression) -> bool {
        self.analysis.type_of(value).is_discrete()
    }

    /// Remembers which numbers a variable can be that never changes.
    pub(super) fn note_range(&mut self, variable: LocalNumber, range: Range) {
        let local = &self.analysis.locals[variable.0];
        if !local.mutable && local.type_.is_discrete() {
            self.ranges.insert(variable, range);
        }
    }

    /// The numbers that the variable of a range can be.
    pub(super) fn counted_range(&self, from: &Expression, to: &Expression, inclusive: bool) -> Range {
        self.range(from).counted(self.range(to), inclusive)
    }

    /// Whether a range may have more turns than a device has time for, as no loop over neighbours has.
    pub(super) fn may_take_long(&self, from: &Expression, to: &Expression) -> bool {
        let over_neighbours = matches!(to, Expression::Builtin(Builtin::NeighbourCount, _));
        !over_neighbours && self.range(to).most - self.range(from).least > MANY_TURNS
    }
}

/// The numbers in a constant.
fn constant_range(value: &Constant) -> Option<Range> {
    Some(match value {
        Constant::Bool(truth) => Range::only(i64::from(*truth)),
        Constant::U8(number) | Constant::State(number, _) => Range::only(i64::from(*number)),
        Constant::I32(number) => Range::only(i64::from(*number)),
        Constant::U32(number) => Range::only(i64::from(*number)),
        Constant::F32(_) | Constant::Real(_) => return None,
        Constant::Vector(parts) | Constant::Array(parts) => {
            parts.iter().map(constant_range).collect::<Option<Vec<_>>>()?.into_iter().reduce(Range::with)?
        }
    })
}
