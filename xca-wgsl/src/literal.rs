//! Numbers as WGSL writes them, exact to the last bit.

use crate::error::Problem;
use crate::shader::Options;
use crate::types::{self, Type};
use xca_core::ScalarType;
use xca_core::ir::Literal;

/// A literal of this type.
pub(crate) fn literal(literal: &Literal, type_: &Type, options: &Options) -> Result<String, Problem> {
    match (literal, type_) {
        (Literal::Bool(value), _) => Ok(value.to_string()),
        (Literal::Integer(value, _), Type::Scalar(scalar)) => integer(i128::from(*value), *scalar),
        (Literal::Float(digits, _), Type::Scalar(scalar)) if types::is_f64(*scalar, options.precision) => {
            let value = digits.parse().map_err(|_| unreadable(digits))?;
            float(value, *scalar, options)
        }
        (Literal::Float(digits, _), Type::Scalar(scalar)) => {
            // Rounded once, as Rust rounds a literal of type `f32`.
            let value: f32 = digits.parse().map_err(|_| unreadable(digits))?;
            float(value.into(), *scalar, options)
        }
        (Literal::Integer(..) | Literal::Float(..), _) => {
            Err(Problem::unsupported("a literal", "its type is not known"))
        }
    }
}

fn unreadable(digits: &str) -> Problem {
    Problem::unsupported(format!("the literal `{digits}`"), "it is no number")
}

/// An integer of this type.
pub(crate) fn integer(value: i128, scalar: ScalarType) -> Result<String, Problem> {
    let too_large =
        || Problem::unsupported(format!("the literal `{value}`"), format!("it does not fit into {scalar}"));
    match scalar {
        ScalarType::U8 => u8::try_from(value).map(|value| format!("{value}u")).map_err(|_| too_large()),
        ScalarType::U32 => u32::try_from(value).map(|value| format!("{value}u")).map_err(|_| too_large()),
        ScalarType::I32 => match i32::try_from(value) {
            // There are no negative literals, and 2147483648 is no i32.
            Ok(i32::MIN) => Ok("i32(-2147483648)".to_owned()),
            Ok(value) => Ok(format!("{value}i")),
            Err(_) => Err(too_large()),
        },
        ScalarType::Bool | ScalarType::State(_) => {
            Err(Problem::unsupported(format!("the literal `{value}`"), format!("it is no {scalar}")))
        }
        ScalarType::F32 | ScalarType::F64 | ScalarType::Real => Err(Problem::unsupported(
            format!("the literal `{value}`"),
            "an integer stands where a float is needed",
        )),
    }
}

/// A float of this type; `f64` is rounded where the type is narrower, as `as f32` does.
pub(crate) fn float(value: f64, scalar: ScalarType, options: &Options) -> Result<String, Problem> {
    let wide = types::is_f64(scalar, options.precision);
    let zero = if wide { value == 0.0 } else { value as f32 == 0.0 };
    if zero && options.opaque_zero {
        let same = wide == types::is_f64(ScalarType::Real, options.precision);
        let sign = if value.is_sign_negative() { "-" } else { "" };
        let name = types::scalar_name(scalar);
        return Ok(if same { format!("{sign}space.zero") } else { format!("{sign}{name}(space.zero)") });
    }
    if wide { double(value) } else { single(value as f32) }
}

fn single(value: f32) -> Result<String, Problem> {
    match value.classify() {
        std::num::FpCategory::Nan => Err(not_a_number()),
        std::num::FpCategory::Infinite => Ok(infinite("f32", value.is_sign_negative())),
        _ => Ok(format!("{value:?}f")),
    }
}

fn double(value: f64) -> Result<String, Problem> {
    match value.classify() {
        std::num::FpCategory::Nan => Err(not_a_number()),
        std::num::FpCategory::Infinite => Ok(infinite("f64", value.is_sign_negative())),
        _ => Ok(format!("{value:?}lf")),
    }
}

fn not_a_number() -> Problem {
    Problem::unsupported("NaN as a constant", "WGSL cannot write it; report a fault instead")
}

/// WGSL refuses infinite constants, so that they are computed at run time.
fn infinite(scalar: &str, negative: bool) -> String {
    format!("{}infinity_{scalar}()", if negative { "-" } else { "" })
}

/// The routine behind an infinite constant.
pub(crate) fn infinity_routine(scalar: &str) -> String {
    let largest = if scalar == "f64" { format!("{:?}lf", f64::MAX) } else { format!("{:?}f", f32::MAX) };
    format!(
        "fn infinity_{scalar}() -> {scalar} {{\n    let largest: {scalar} = {largest};\n    return largest + largest;\n}}\n"
    )
}

#[cfg(test)]
mod tests {
    use super::{float, integer, literal};
    use crate::shader::Options;
    use crate::types::Type;
    use xca_core::ir::Literal;
    use xca_core::{Precision, ScalarType};

    fn single() -> Options {
        Options { precision: Precision::F32, ..Options::default() }
    }

    fn double() -> Options {
        Options { precision: Precision::F64, ..Options::default() }
    }

    #[test]
    fn floats_are_exact() {
        let real = Type::Scalar(ScalarType::Real);
        let tenth = Literal::Float("0.1", None);
        assert_eq!(literal(&tenth, &real, &single()).unwrap(), "0.1f");
        assert_eq!(literal(&tenth, &real, &double()).unwrap(), "0.1lf");
        let long = Literal::Float("0.30000000000000004000", None);
        assert_eq!(literal(&long, &real, &double()).unwrap(), "0.30000000000000004lf");
        assert_eq!(float(1e300, ScalarType::Real, &single()).unwrap(), "infinity_f32()");
        assert_eq!(float(f64::NEG_INFINITY, ScalarType::F64, &single()).unwrap(), "-infinity_f64()");
        let opaque = Options { opaque_zero: true, ..single() };
        assert_eq!(float(-0.0, ScalarType::Real, &opaque).unwrap(), "-space.zero");
        assert_eq!(float(0.0, ScalarType::F64, &opaque).unwrap(), "f64(space.zero)");
        assert!(float(f64::NAN, ScalarType::F64, &single()).is_err());
    }

    #[test]
    fn integers_fit() {
        assert_eq!(integer(255, ScalarType::U8).unwrap(), "255u");
        assert!(integer(256, ScalarType::U8).is_err());
        assert_eq!(integer(-2_147_483_648, ScalarType::I32).unwrap(), "i32(-2147483648)");
        assert_eq!(integer(-1, ScalarType::I32).unwrap(), "-1i");
    }
}
