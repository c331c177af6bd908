//! `as`, with Rust's results: integers wrap, floats saturate.

use super::operator::is_constant;
use super::text::{Level, Text};
use super::writer::Writer;
use crate::error::Problem;
use crate::literal;
use crate::types::{self, Type};
use xca_core::ScalarType;
use xca_core::ir::{Constant, Expression, Literal};

impl Writer<'_, '_> {
    pub(super) fn cast(&mut self, operand: &Expression, target: &Type) -> Result<Text, Problem> {
        let source = self.type_of(operand);
        let unsupported = || {
            let construct = format!("a cast from {} to {}", source.wgsl(), target.wgsl());
            Problem::unsupported(construct, "only numbers, bool and states can be cast, to numbers")
        };
        let Type::Scalar(to) = *target else { return Err(unsupported()) };
        match source {
            Type::Bool => {
                let text = self.expression(operand)?;
                Ok(call(types::scalar_name(to), &text))
            }
            Type::Scalar(from) if types::is_float(from) => self.float_cast(operand, from, to),
            Type::Scalar(from) => {
                let text = self.expression(operand)?;
                Ok(from_integer(&text, from, to))
            }
            // Its number.
            Type::State(_) => {
                let text = self.expression(operand)?;
                Ok(from_integer(&text, ScalarType::U8, to))
            }
            _ => Err(unsupported()),
        }
    }

    fn float_cast(
        &mut self,
        operand: &Expression,
        from: ScalarType,
        to: ScalarType,
    ) -> Result<Text, Problem> {
        let precision = self.shared.options.precision;
        let same = types::is_float(to) && types::is_f64(from, precision) == types::is_f64(to, precision);
        if !types::is_float(to) {
            let text = self.expression(operand)?;
            let name = self.shared.routines.need_saturation(from, to);
            return Ok(call(&name, &text));
        }
        if same {
            return self.expression(operand);
        }
        // naga cannot narrow a constant, so that it is rounded here.
        if let Some(value) = exact_value(operand, types::is_f64(from, precision)) {
            return Ok(Text::number(literal::float(value, to, self.shared.options)?));
        }
        let mut text = self.expression(operand)?;
        if is_constant(operand) {
            text = self.at_run_time(&Type::Scalar(from), &text);
        }
        Ok(call(types::scalar_name(to), &text))
    }
}

/// What a literal or constant float is.
fn exact_value(value: &Expression, wide: bool) -> Option<f64> {
    match value {
        Expression::Literal(Literal::Float(digits, _)) if wide => digits.parse().ok(),
        Expression::Literal(Literal::Float(digits, _)) => digits.parse::<f32>().ok().map(f64::from),
        Expression::Constant { value: Constant::F32(value), .. } => Some(f64::from(*value)),
        Expression::Constant { value: Constant::Real(value), .. } if wide => Some(*value),
        Expression::Constant { value: Constant::Real(value), .. } => Some(f64::from(*value as f32)),
        _ => None,
    }
}

fn call(name: &str, text: &Text) -> Text {
    Text::primary(format!("{name}({})", text.plain()))
}

fn from_integer(text: &Text, from: ScalarType, to: ScalarType) -> Text {
    let as_u32 = || if from == ScalarType::I32 { call("u32", text) } else { text.clone() };
    match to {
        ScalarType::U8 if from == ScalarType::U8 => text.clone(),
        ScalarType::U8 => Text::joined(&as_u32(), "&", &Text::primary("0xffu"), Level::Bitwise),
        ScalarType::U32 => as_u32(),
        ScalarType::I32 if from == ScalarType::I32 => text.clone(),
        ScalarType::I32 => call("i32", text),
        ScalarType::F32 | ScalarType::F64 | ScalarType::Real => call(types::scalar_name(to), text),
        // No cast has these as its target.
        ScalarType::Bool | ScalarType::State(_) => text.clone(),
    }
}
