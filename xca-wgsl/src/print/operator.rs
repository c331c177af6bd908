//! Operators, with the results that Rust gives.

use super::element::is_division;
use super::text::{Level, Text};
use super::writer::Writer;
use crate::error::Problem;
use crate::types::{self, Type};
use crate::visit::{self, Node};
use xca_core::ScalarType;
use xca_core::ir::{BinaryOperator, Expression};

impl Writer<'_, '_> {
    pub(super) fn binary(
        &mut self,
        operator: BinaryOperator,
        left: &Expression,
        right: &Expression,
    ) -> Result<Text, Problem> {
        let mut texts = self.operands(&[left, right])?;
        let (left_type, right_type) = (self.type_of(left), self.type_of(right));
        if self.overflows(operator, left, right) {
            texts[0] = self.at_run_time(&left_type, &texts[0]);
        }
        if is_division(operator) && !left_type.is_float() {
            let dividend = (&texts[0], &left_type, self.range(left));
            return self.quotient(operator, dividend, (&texts[1], &right_type, self.range(right)));
        }
        self.combined(operator, (&texts[0], &left_type), (&texts[1], &right_type))
    }

    /// `left operator right`.
    pub(super) fn combined(
        &mut self,
        operator: BinaryOperator,
        (left, left_type): (&Text, &Type),
        (right, right_type): (&Text, &Type),
    ) -> Result<Text, Problem> {
        // A vector with a number gives a vector.
        let type_ = if right_type.lanes() > 1 { right_type } else { left_type };
        Ok(match operator {
            BinaryOperator::Add => self.wrapped(Text::joined(left, "+", right, Level::Additive), type_),
            BinaryOperator::Subtract => self.wrapped(Text::joined(left, "-", right, Level::Additive), type_),
            BinaryOperator::Multiply => {
                self.wrapped(Text::joined(left, "*", right, Level::Multiplicative), type_)
            }
            BinaryOperator::Divide => Text::joined(left, "/", right, Level::Multiplicative),
            BinaryOperator::Remainder if type_.is_float() => {
                let wide =
                    type_.scalar().is_some_and(|scalar| types::is_f64(scalar, self.shared.options.precision));
                let routine = self.shared.routines.need_remainder(type_, wide);
                Text::primary(format!("{routine}({}, {})", left.argument(), right.argument()))
            }
            BinaryOperator::Remainder => Text::joined(left, "%", right, Level::Multiplicative),
            BinaryOperator::BitAnd => Text::joined(left, "&", right, Level::Bitwise),
            BinaryOperator::BitOr => Text::joined(left, "|", right, Level::Bitwise),
            BinaryOperator::BitXor if *left_type == Type::Bool => {
                Text::joined(left, "!=", right, Level::Relational)
            }
            BinaryOperator::BitXor => Text::joined(left, "^", right, Level::Bitwise),
            BinaryOperator::ShiftLeft => {
                self.wrapped(shift(left, "<<", right, left_type, right_type), left_type)
            }
            BinaryOperator::ShiftRight => shift(left, ">>", right, left_type, right_type),
            BinaryOperator::Equal | BinaryOperator::NotEqual if type_.holds_tuples() => {
                return Err(Problem::unsupported("a comparison of tuples", "compare their parts"));
            }
            BinaryOperator::Equal if matches!(type_, Type::Array(..)) => {
                let routine = self.shared.routines.need_equal(type_);
                Text::primary(format!("{routine}({}, {})", left.argument(), right.argument()))
            }
            BinaryOperator::NotEqual if matches!(type_, Type::Array(..)) => {
                self.combined(BinaryOperator::Equal, (left, left_type), (right, right_type))?.inverted("!")
            }
            BinaryOperator::Equal if type_.lanes() > 1 => {
                Text::primary(format!("all({})", Text::joined(left, "==", right, Level::Relational).plain()))
            }
            // naga compares floats so that NaN is not unequal to anything; `!(a == b)` is what Rust has.
            BinaryOperator::NotEqual if type_.is_float() => {
                self.combined(BinaryOperator::Equal, (left, left_type), (right, right_type))?.inverted("!")
            }
            BinaryOperator::NotEqual if type_.lanes() > 1 => {
                Text::primary(format!("any({})", Text::joined(left, "!=", right, Level::Relational).plain()))
            }
            BinaryOperator::Equal => Text::joined(left, "==", right, Level::Relational),
            BinaryOperator::NotEqual => Text::joined(left, "!=", right, Level::Relational),
            BinaryOperator::Less
            | BinaryOperator::LessEqual
            | BinaryOperator::Greater
            | BinaryOperator::GreaterEqual => {
                if !matches!(type_, Type::Scalar(_) | Type::State(_)) {
                    return Err(Problem::unsupported(
                        "an order comparison",
                        "only numbers and states have an order",
                    ));
                }
                let sign = match operator {
                    BinaryOperator::Less => "<",
                    BinaryOperator::LessEqual => "<=",
                    BinaryOperator::Greater => ">",
                    _ => ">=",
                };
                Text::joined(left, sign, right, Level::Relational)
            }
            BinaryOperator::And => Text::joined(left, "&&", right, Level::And),
            BinaryOperator::Or => Text::joined(left, "||", right, Level::Or),
        })
    }

    /// `&&` and `||`: the right-hand side is computed only where it is needed.
    pub(super) fn logical(
        &mut self,
        operator: BinaryOperator,
        left: &Expression,
        right: &Expression,
    ) -> Result<Text, Problem> {
        let left = self.expression(left)?;
        if !self.hoists(right) {
            let right = self.expression(right)?;
            return self.combined(operator, (&left, &Type::Bool), (&right, &Type::Bool));
        }
        let name = self.shared.names.local("condition");
        self.line(&format!("var {name}: bool = {};", left.plain()));
        let sign = if operator == BinaryOperator::And { "" } else { "!" };
        self.line(&format!("if {sign}{name} {{"));
        self.inside(|writer| {
            let right = writer.expression(right)?;
            writer.line(&format!("{name} = {};", right.plain()));
            Ok(())
        })?;
        self.line("}");
        Ok(Text::primary(name))
    }

    /// Keeps a `u8` below 256.
    pub(super) fn wrapped(&self, value: Text, type_: &Type) -> Text {
        if !type_.is_u8() {
            return value;
        }
        let mask = match type_.lanes() {
            1 => "0xffu".to_owned(),
            lanes => format!("vec{lanes}<u32>(0xffu)"),
        };
        Text::joined(&value, "&", &Text::primary(mask), Level::Bitwise)
    }

    /// A constant that naga does not compute with while it reads the shader.
    pub(super) fn at_run_time(&mut self, type_: &Type, value: &Text) -> Text {
        let routine = self.shared.routines.need_run_time(type_);
        Text::primary(format!("{routine}({})", value.plain()))
    }

    /// Whether naga would compute the value while it reads the shader, and perhaps refuse it: a float that is
    /// not finite, an integer that loses bits.
    fn overflows(&self, operator: BinaryOperator, left: &Expression, right: &Expression) -> bool {
        if !(is_constant(left) && is_constant(right)) {
            return false;
        }
        let type_ = self.type_of(left);
        if !type_.is_float() {
            return matches!(
                operator,
                BinaryOperator::ShiftLeft | BinaryOperator::Divide | BinaryOperator::Remainder
            );
        }
        let value = match (constant_value(left), constant_value(right)) {
            (Some(left), Some(right)) => arithmetic(operator, left, right),
            _ => None,
        };
        let wide = type_.scalar().is_some_and(|scalar| types::is_f64(scalar, self.shared.options.precision));
        let finite = |value: f64| if wide { value.is_finite() } else { (value as f32).is_finite() };
        match operator {
            BinaryOperator::Add
            | BinaryOperator::Subtract
            | BinaryOperator::Multiply
            | BinaryOperator::Divide => !value.is_some_and(finite),
            _ => false,
        }
    }
}

/// Rust takes the number of places modulo the width in release builds.
fn shift(left: &Text, sign: &str, right: &Text, left_type: &Type, right_type: &Type) -> Text {
    let last = if left_type.is_u8() { 7 } else { 31 };
    let literal = right.plain().trim_end_matches(['u', 'i']).parse::<u32>().ok();
    let places = match literal {
        Some(places) if places <= last => Text::primary(format!("{places}u")),
        _ => {
            let unsigned = match right_type.scalar() {
                Some(ScalarType::I32) => Text::primary(format!("u32({})", right.plain())),
                _ => right.clone(),
            };
            Text::joined(&unsigned, "&", &Text::primary(format!("{last}u")), Level::Bitwise)
        }
    };
    Text::joined(left, sign, &places, Level::Shift)
}

/// Whether a value is made of literals and constants alone.
pub(super) fn is_constant(value: &Expression) -> bool {
    let mut constant = true;
    visit::expression(value, &mut |node| {
        if let Node::Expression(inner) = node {
            constant &= !matches!(
                inner,
                Expression::Local(_)
                    | Expression::Own(_)
                    | Expression::OfCell { .. }
                    | Expression::Neighbour { .. }
                    | Expression::NamedNeighbour { .. }
                    | Expression::Other { .. }
                    | Expression::OtherLabel(_)
                    | Expression::Parameter { .. }
                    | Expression::Builtin(..)
                    | Expression::Call { .. }
            );
        }
        constant
    });
    constant
}

/// About what a float is that is known before the run.
fn constant_value(value: &Expression) -> Option<f64> {
    use xca_core::ir::{Constant, Literal, UnaryOperator};
    match value {
        Expression::Literal(Literal::Float(digits, _)) => digits.parse().ok(),
        Expression::Constant { value: Constant::F32(value), .. } => Some((*value).into()),
        Expression::Constant { value: Constant::Real(value), .. } => Some(*value),
        Expression::Unary(UnaryOperator::Negate, operand) => Some(-constant_value(operand)?),
        Expression::Binary(operator, left, right) => {
            arithmetic(*operator, constant_value(left)?, constant_value(right)?)
        }
        _ => None,
    }
}

fn arithmetic(operator: BinaryOperator, left: f64, right: f64) -> Option<f64> {
    match operator {
        BinaryOperator::Add => Some(left + right),
        BinaryOperator::Subtract => Some(left - right),
        BinaryOperator::Multiply => Some(left * right),
        BinaryOperator::Divide => Some(left / right),
        _ => None,
    }
}
