//! Methods of numbers, vectors and arrays.

use super::expression::list;
use super::operator::is_constant;
use super::text::{Level, Text};
use super::writer::Writer;
use crate::error::Problem;
use crate::inference::definition;
use crate::types::{self, Type};
use xca_core::ScalarType;
use xca_core::ir::{BinaryOperator, Expression, Operation};
use xca_methods::{Method, Receiver};

impl Writer<'_, '_> {
    pub(super) fn method(
        &mut self,
        operation: Operation,
        receiver: &Expression,
        arguments: &[Expression],
    ) -> Result<Text, Problem> {
        let method = definition(operation)?;
        let type_ = self.type_of(receiver);
        let mut values = vec![receiver];
        values.extend(arguments);
        if arguments.len() != method.arguments.len() {
            return Err(Problem::unsupported(
                format!("`{}`", method.name),
                "the number of arguments is wrong",
            ));
        }
        check_receiver(method, &type_)?;
        let mut texts = self.operands(&values)?;
        // naga would compute it while it reads the shader, and refuse square roots of negative numbers, say.
        if is_constant(receiver) && type_.scalar().is_some() {
            texts[0] = self.at_run_time(&type_, &texts[0]);
        }
        Ok(match operation {
            Operation::Min => self.least("minimum", "min", &type_, &texts),
            Operation::Max => self.least("maximum", "max", &type_, &texts),
            Operation::Clamp => {
                let above = self.least("maximum", "max", &type_, &[texts[0].clone(), texts[1].clone()]);
                self.least("minimum", "min", &type_, &[above, texts[2].clone()])
            }
            Operation::Abs
            | Operation::SquareRoot
            | Operation::Floor
            | Operation::Ceiling
            | Operation::Truncate => Text::primary(format!("{}({})", method.name, list(&texts))),
            Operation::Signum if !type_.is_float() => Text::primary(format!("sign({})", list(&texts))),
            Operation::Reciprocal => {
                let one = Text::primary(format!("{}(1.0)", type_.wgsl()));
                Text::joined(&one, "/", &texts[0], Level::Multiplicative)
            }
            Operation::RemainderEuclid | Operation::DivideEuclid if !type_.is_float() => {
                let remainder = operation == Operation::RemainderEuclid;
                let (dividend, divisor) = (self.range(receiver), self.range(&arguments[0]));
                if type_.scalar().is_some_and(is_unsigned) {
                    let operator = if remainder { BinaryOperator::Remainder } else { BinaryOperator::Divide };
                    self.quotient(operator, (&texts[0], &type_, dividend), (&texts[1], &type_, divisor))?
                } else {
                    let checked = divisor.may_stop_division_of(dividend, &type_);
                    let routine = self.shared.routines.need_euclidean(remainder, &type_, checked);
                    Text::primary(format!("{routine}({})", list(&texts)))
                }
            }
            Operation::WrappingAdd | Operation::WrappingSubtract | Operation::WrappingMultiply => {
                let operator = match operation {
                    Operation::WrappingAdd => BinaryOperator::Add,
                    Operation::WrappingSubtract => BinaryOperator::Subtract,
                    _ => BinaryOperator::Multiply,
                };
                self.combined(operator, (&texts[0], &type_), (&texts[1], &type_))?
            }
            Operation::CountOnes => {
                let ones = format!("countOneBits({})", list(&texts));
                let signed = type_.scalar() == Some(ScalarType::I32);
                Text::primary(if signed { format!("u32({ones})") } else { ones })
            }
            Operation::Len => match type_ {
                Type::Array(_, length) => Text::primary(format!("{length}u")),
                _ => return Err(no_method(method, &type_)),
            },
            Operation::Signum
            | Operation::CopySign
            | Operation::Round
            | Operation::Fraction
            | Operation::IsNan
            | Operation::IsFinite
            | Operation::IsInfinite
            | Operation::IsSignNegative
            | Operation::RemainderEuclid
            | Operation::DivideEuclid => {
                let wide =
                    type_.scalar().is_some_and(|scalar| types::is_f64(scalar, self.shared.options.precision));
                let routine = self.shared.routines.need_number(operation, &type_, wide);
                Text::primary(format!("{routine}({})", list(&texts)))
            }
            Operation::Dot
            | Operation::Cross
            | Operation::LengthSquared
            | Operation::Length
            | Operation::Distance
            | Operation::Normalize => {
                let routine = self.shared.routines.need_vector(operation, &type_);
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
}

fn is_unsigned(scalar: ScalarType) -> bool {
    matches!(scalar, ScalarType::U8 | ScalarType::U32)
}

fn check_receiver(method: &Method, type_: &Type) -> Result<(), Problem> {
    let vector = type_.lanes() > 1;
    let signed = type_.is_float() || type_.scalar() == Some(ScalarType::I32);
    let fits = match method.receiver {
        Receiver::Numbers => type_.scalar().is_some(),
        Receiver::Scalars => matches!(type_, Type::Scalar(_)),
        Receiver::Signed => signed,
        Receiver::SignedScalars => signed && !vector,
        Receiver::Floats => type_.is_float() && !vector,
        Receiver::Real => *type_ == Type::Scalar(ScalarType::Real),
        Receiver::Integers => matches!(type_, Type::Scalar(_)) && !type_.is_float(),
        Receiver::Vectors => vector,
        Receiver::FloatVectors => vector && type_.is_float(),
        Receiver::ThreeLanes => type_.lanes() == 3,
        Receiver::Arrays => matches!(type_, Type::Array(..)),
    };
    if fits { Ok(()) } else { Err(no_method(method, type_)) }
}

fn no_method(method: &Method, type_: &Type) -> Problem {
    Problem::unsupported(format!("`{}` of {}", method.name, type_.wgsl()), "this type has no such method")
}
