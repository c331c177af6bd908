//! Expressions at random.

use super::source::{Source, boxed, is_float};
use super::state::{GROUND, PAIR, PLACE, path, table};
use xca_core::ScalarType;
use xca_core::ir::{BinaryOperator, Expression, Literal, Operation, Type, UnaryOperator};

impl Source {
    pub(super) fn expression(&mut self, type_: &Type, depth: usize) -> Expression {
        if depth == 0 {
            return self.leaf(type_);
        }
        let next = depth - 1;
        match (self.below(10), type_) {
            (0, _) => {
                let condition = boxed(self.expression(&Type::Bool, next));
                let then = self.block_or_leave(Some(type_), next, true);
                let otherwise = self.block(Some(type_), next);
                Expression::If { condition, then, otherwise: Some(otherwise) }
            }
            (1, _) => Expression::Block(self.block(Some(type_), next)),
            (2, _) => self.match_(Some(type_), next),
            (_, Type::Bool) => self.truth(next),
            (_, Type::State(_)) => self.own(type_),
            (_, Type::Vector(..)) if *type_ == PAIR => {
                let array = boxed(self.expression(&path(), next));
                Expression::Element(array, boxed(self.index(next)))
            }
            (3, Type::Array(..)) => self.own(type_),
            (_, Type::Vector(scalar, lanes)) => self.vector(*scalar, *lanes, next),
            (_, Type::Array(element, length)) => {
                Expression::Array((0..*length).map(|_| self.expression(element, next)).collect())
            }
            (3, Type::Scalar(scalar)) => {
                let from = self.scalar();
                Expression::Cast(boxed(self.expression(&from, next)), Type::Scalar(*scalar))
            }
            (4, Type::Scalar(ScalarType::Real)) => {
                Expression::Component(boxed(self.expression(&PLACE, next)), self.below(3) as u8)
            }
            (4, Type::Scalar(ScalarType::I32)) => {
                let array = boxed(self.expression(&table(), next));
                Expression::Element(array, boxed(self.index(next)))
            }
            (5, _) => self.method(type_, next),
            (6, _) if *type_ == Type::Scalar(ScalarType::I32) || is_float(type_) => {
                Expression::Unary(UnaryOperator::Negate, boxed(self.expression(type_, next)))
            }
            (6, _) => Expression::Unary(UnaryOperator::Not, boxed(self.expression(type_, next))),
            _ => self.arithmetic(type_, next),
        }
    }

    pub(super) fn arithmetic(&mut self, type_: &Type, depth: usize) -> Expression {
        use BinaryOperator::{
            Add, BitAnd, BitOr, BitXor, Divide, Multiply, Remainder, ShiftLeft, ShiftRight, Subtract,
        };
        let left = boxed(self.expression(type_, depth));
        if is_float(type_) {
            let operator = [Add, Subtract, Multiply, Divide, Remainder][self.below(5)];
            return Expression::Binary(operator, left, boxed(self.expression(type_, depth)));
        }
        let operator =
            [Add, Subtract, Multiply, BitAnd, BitOr, BitXor, Divide, Remainder, ShiftLeft, ShiftRight]
                [self.below(10)];
        let right = match operator {
            // Rust itself refuses a division by a literal 0.
            Divide | Remainder if self.below(2) == 0 => self.own(type_),
            Divide | Remainder => Expression::Method {
                method: Operation::Max,
                receiver: boxed(self.own(type_)),
                arguments: vec![Expression::Literal(Literal::Integer(1, None))],
            },
            ShiftLeft | ShiftRight => {
                let places = self.integer();
                self.expression(&places, depth)
            }
            _ => self.expression(type_, depth),
        };
        Expression::Binary(operator, left, boxed(right))
    }

    pub(super) fn method(&mut self, type_: &Type, depth: usize) -> Expression {
        use Operation::{
            Abs, Ceiling, Clamp, CopySign, DivideEuclid, Dot, Floor, Fraction, Max, Min, Reciprocal,
            RemainderEuclid, Round, Signum, SquareRoot, Truncate, WrappingAdd, WrappingMultiply,
        };
        if *type_ == Type::Scalar(ScalarType::Real) && self.below(2) == 0 {
            let (receiver, argument) =
                (boxed(self.expression(&PLACE, depth)), self.expression(&PLACE, depth));
            return match self.below(3) {
                0 => Expression::Method { method: Dot, receiver, arguments: vec![argument] },
                1 => Expression::Method { method: Operation::Length, receiver, arguments: Vec::new() },
                _ => Expression::Method { method: Operation::LengthSquared, receiver, arguments: Vec::new() },
            };
        }
        let method = if is_float(type_) {
            [
                Min,
                Max,
                Clamp,
                Abs,
                SquareRoot,
                Floor,
                Ceiling,
                Truncate,
                Round,
                Fraction,
                Signum,
                CopySign,
                Reciprocal,
                RemainderEuclid,
                DivideEuclid,
            ][self.below(15)]
        } else {
            [Min, Max, Clamp, WrappingAdd, WrappingMultiply][self.below(5)]
        };
        let count = method.method().map_or(0, |method| method.arguments.len());
        let receiver = boxed(self.expression(type_, depth));
        Expression::Method {
            method,
            receiver,
            arguments: (0..count).map(|_| self.expression(type_, depth)).collect(),
        }
    }

    pub(super) fn truth(&mut self, depth: usize) -> Expression {
        use BinaryOperator::{And, BitAnd, BitXor, Equal, Greater, Less, NotEqual, Or};
        let (operator, of) = match self.below(6) {
            3 => ([Equal, NotEqual][self.below(2)], [table(), path()][self.below(2)].clone()),
            4 => ([Equal, NotEqual, Less][self.below(3)], GROUND),
            0 => ([And, Or, BitAnd, BitXor][self.below(4)], Type::Bool),
            1 => ([Equal, NotEqual][self.below(2)], PLACE),
            2 => return Expression::Unary(UnaryOperator::Not, boxed(self.expression(&Type::Bool, depth))),
            _ => ([Less, Greater, Equal][self.below(3)], self.scalar()),
        };
        Expression::Binary(operator, boxed(self.expression(&of, depth)), boxed(self.expression(&of, depth)))
    }

    pub(super) fn vector(&mut self, scalar: ScalarType, lanes: u8, depth: usize) -> Expression {
        use BinaryOperator::{Add, Divide, Multiply, Subtract};
        let (vector, single) = (Type::Vector(scalar, lanes), Type::Scalar(scalar));
        match self.below(5) {
            0 => Expression::Vector((0..lanes).map(|_| self.expression(&single, depth)).collect()),
            1 => Expression::Binary(
                Multiply,
                boxed(self.expression(&single, depth)),
                boxed(self.expression(&vector, depth)),
            ),
            2 => Expression::Binary(
                [Multiply, Divide][self.below(2)],
                boxed(self.expression(&vector, depth)),
                boxed(self.expression(&single, depth)),
            ),
            3 => Expression::Method {
                method: Operation::Cross,
                receiver: boxed(self.expression(&vector, depth)),
                arguments: vec![self.expression(&vector, depth)],
            },
            _ => Expression::Binary(
                [Add, Subtract][self.below(2)],
                boxed(self.expression(&vector, depth)),
                boxed(self.expression(&vector, depth)),
            ),
        }
    }
}
