//! Methods of numbers and vectors.

use super::Writer;
use super::expression::list;
use super::operator::is_constant;
use super::text::Text;
use crate::error::Problem;
use crate::types::Type;
use xca_core::ScalarType;
use xca_core::ir::{BinaryOperator, Expression, Method};

impl Writer<'_, '_> {
    pub(super) fn method(
        &mut self,
        method: Method,
        receiver: &Expression,
        arguments: &[Expression],
    ) -> Result<Text, Problem> {
        let type_ = self.type_of(receiver);
        let mut values = vec![receiver];
        values.extend(arguments);
        if values.len() != operand_count(method) {
            return Err(Problem::unsupported(
                format!("`{}`", name(method)),
                "the number of arguments is wrong",
            ));
        }
        self.check_receiver(method, &type_)?;
        let mut texts = self.operands(&values)?;
        // naga would compute it while it reads the shader, and refuse square roots of negative numbers, say.
        if is_constant(receiver) {
            texts[0] = self.at_run_time(&type_, &texts[0]);
        }
        let operands = |texts: &[Text]| texts.iter().map(Text::argument).collect::<Vec<_>>().join(", ");
        Ok(match method {
            Method::Min => self.least("minimum", "min", &type_, &texts),
            Method::Max => self.least("maximum", "max", &type_, &texts),
            Method::Clamp => {
                let above = self.least("maximum", "max", &type_, &[texts[0].clone(), texts[1].clone()]);
                self.least("minimum", "min", &type_, &[above, texts[2].clone()])
            }
            Method::Abs | Method::SquareRoot | Method::Floor | Method::Ceiling | Method::Truncate => {
                Text::primary(format!("{}({})", name(method), list(&texts)))
            }
            Method::WrappingAdd | Method::WrappingSubtract | Method::WrappingMultiply => {
                let operator = match method {
                    Method::WrappingAdd => BinaryOperator::Add,
                    Method::WrappingSubtract => BinaryOperator::Subtract,
                    _ => BinaryOperator::Multiply,
                };
                self.combined(operator, (&texts[0], &type_), (&texts[1], &type_))?
            }
            Method::CountOnes => {
                let ones = format!("countOneBits({})", list(&texts));
                let signed = type_.scalar() == Some(ScalarType::I32);
                Text::primary(if signed { format!("u32({ones})") } else { ones })
            }
            Method::Dot => {
                let routine = self.shared.routines.need_dot(&type_);
                Text::primary(format!("{routine}({})", operands(&texts)))
            }
            Method::Cross => {
                let routine = self.shared.routines.need_cross(&type_);
                Text::primary(format!("{routine}({})", operands(&texts)))
            }
            Method::LengthSquared => {
                let routine = self.shared.routines.need_length_squared(&type_);
                Text::primary(format!("{routine}({})", list(&texts)))
            }
            Method::Length => {
                let routine = self.shared.routines.need_length(&type_);
                Text::primary(format!("{routine}({})", list(&texts)))
            }
        })
    }

    /// The smaller or larger of two; of floats by a routine that says what happens to NaN and signed zeros.
    fn least(&mut self, routine: &str, builtin: &str, type_: &Type, texts: &[Text]) -> Text {
        let arguments = list(texts);
        if type_.is_float() {
            let routine = self.shared.routines.need_least(routine, type_);
            Text::primary(format!("{routine}({arguments})"))
        } else {
            Text::primary(format!("{builtin}({arguments})"))
        }
    }

    fn check_receiver(&self, method: Method, type_: &Type) -> Result<(), Problem> {
        let vector = type_.lanes() > 1;
        let fits = match method {
            Method::Min | Method::Max | Method::Clamp => type_.scalar().is_some(),
            Method::Abs => type_.is_float() || type_.scalar() == Some(ScalarType::I32),
            Method::SquareRoot | Method::Floor | Method::Ceiling | Method::Truncate => type_.is_float(),
            Method::WrappingAdd | Method::WrappingSubtract | Method::WrappingMultiply | Method::CountOnes => {
                matches!(type_, Type::Scalar(_)) && !type_.is_float()
            }
            Method::Dot | Method::LengthSquared => vector,
            Method::Length => vector && type_.is_float(),
            Method::Cross => type_.lanes() == 3,
        };
        if fits {
            return Ok(());
        }
        Err(Problem::unsupported(
            format!("`{}` of {}", name(method), type_.wgsl()),
            "this type has no such method",
        ))
    }
}

fn operand_count(method: Method) -> usize {
    match method {
        Method::Clamp => 3,
        Method::Min
        | Method::Max
        | Method::WrappingAdd
        | Method::WrappingSubtract
        | Method::WrappingMultiply
        | Method::Dot
        | Method::Cross => 2,
        _ => 1,
    }
}

fn name(method: Method) -> &'static str {
    match method {
        Method::Min => "min",
        Method::Max => "max",
        Method::Clamp => "clamp",
        Method::Abs => "abs",
        Method::SquareRoot => "sqrt",
        Method::Floor => "floor",
        Method::Ceiling => "ceil",
        Method::Truncate => "trunc",
        Method::WrappingAdd => "wrapping_add",
        Method::WrappingSubtract => "wrapping_sub",
        Method::WrappingMultiply => "wrapping_mul",
        Method::CountOnes => "count_ones",
        Method::Dot => "dot",
        Method::Cross => "cross",
        Method::LengthSquared => "length_squared",
        Method::Length => "length",
    }
}
