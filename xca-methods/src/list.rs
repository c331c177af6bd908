//! The list.

use crate::method::{Meaning, Method, Operation, Outcome, Receiver};

const fn method(
    name: &'static str,
    arguments: &'static [&'static str],
    receiver: Receiver,
    result: Outcome,
    meaning: Meaning,
) -> Method {
    Method { name, arguments, receiver, result, meaning }
}

/// All methods.
pub const METHODS: &[Method] = &[
    method("min", &["b"], Receiver::Numbers, Outcome::Same, Meaning::Operation(Operation::Min)),
    method("max", &["b"], Receiver::Numbers, Outcome::Same, Meaning::Operation(Operation::Max)),
    method("clamp", &["low", "high"], Receiver::Numbers, Outcome::Same, Meaning::Operation(Operation::Clamp)),
    method(
        "rem_euclid",
        &["b"],
        Receiver::Scalars,
        Outcome::Same,
        Meaning::Operation(Operation::RemainderEuclid),
    ),
    method(
        "div_euclid",
        &["b"],
        Receiver::Scalars,
        Outcome::Same,
        Meaning::Operation(Operation::DivideEuclid),
    ),
    method("abs", &[], Receiver::Signed, Outcome::Same, Meaning::Operation(Operation::Abs)),
    method("signum", &[], Receiver::SignedScalars, Outcome::Same, Meaning::Operation(Operation::Signum)),
    method("sqrt", &[], Receiver::Floats, Outcome::Same, Meaning::Operation(Operation::SquareRoot)),
    method("floor", &[], Receiver::Floats, Outcome::Same, Meaning::Operation(Operation::Floor)),
    method("ceil", &[], Receiver::Floats, Outcome::Same, Meaning::Operation(Operation::Ceiling)),
    method("trunc", &[], Receiver::Floats, Outcome::Same, Meaning::Operation(Operation::Truncate)),
    method("round", &[], Receiver::Floats, Outcome::Same, Meaning::Operation(Operation::Round)),
    method("fract", &[], Receiver::Floats, Outcome::Same, Meaning::Operation(Operation::Fraction)),
    method("recip", &[], Receiver::Floats, Outcome::Same, Meaning::Operation(Operation::Reciprocal)),
    method("copysign", &["sign"], Receiver::Floats, Outcome::Same, Meaning::Operation(Operation::CopySign)),
    method("is_nan", &[], Receiver::Floats, Outcome::Truth, Meaning::Operation(Operation::IsNan)),
    method("is_finite", &[], Receiver::Floats, Outcome::Truth, Meaning::Operation(Operation::IsFinite)),
    method("is_infinite", &[], Receiver::Floats, Outcome::Truth, Meaning::Operation(Operation::IsInfinite)),
    method(
        "is_sign_negative",
        &[],
        Receiver::Floats,
        Outcome::Truth,
        Meaning::Operation(Operation::IsSignNegative),
    ),
    method("exp", &[], Receiver::Real, Outcome::Same, Meaning::Function("exp")),
    method("exp2", &[], Receiver::Real, Outcome::Same, Meaning::Function("exp2")),
    method("exp_m1", &[], Receiver::Real, Outcome::Same, Meaning::Function("exp_m1")),
    method("ln", &[], Receiver::Real, Outcome::Same, Meaning::Function("log")),
    method("log2", &[], Receiver::Real, Outcome::Same, Meaning::Function("log2")),
    method("log10", &[], Receiver::Real, Outcome::Same, Meaning::Function("log10")),
    method("ln_1p", &[], Receiver::Real, Outcome::Same, Meaning::Function("log_1p")),
    method("powf", &["y"], Receiver::Real, Outcome::Same, Meaning::Function("pow")),
    method("powi", &["n"], Receiver::Real, Outcome::Same, Meaning::Function("powi")),
    method("cbrt", &[], Receiver::Real, Outcome::Same, Meaning::Function("cbrt")),
    method("hypot", &["y"], Receiver::Real, Outcome::Same, Meaning::Function("hypot")),
    method("sin", &[], Receiver::Real, Outcome::Same, Meaning::Function("sin")),
    method("cos", &[], Receiver::Real, Outcome::Same, Meaning::Function("cos")),
    method("tan", &[], Receiver::Real, Outcome::Same, Meaning::Function("tan")),
    method("asin", &[], Receiver::Real, Outcome::Same, Meaning::Function("asin")),
    method("acos", &[], Receiver::Real, Outcome::Same, Meaning::Function("acos")),
    method("atan", &[], Receiver::Real, Outcome::Same, Meaning::Function("atan")),
    method("atan2", &["x"], Receiver::Real, Outcome::Same, Meaning::Function("atan2")),
    method("sinh", &[], Receiver::Real, Outcome::Same, Meaning::Function("sinh")),
    method("cosh", &[], Receiver::Real, Outcome::Same, Meaning::Function("cosh")),
    method("tanh", &[], Receiver::Real, Outcome::Same, Meaning::Function("tanh")),
    method("to_radians", &[], Receiver::Real, Outcome::Same, Meaning::Function("to_radians")),
    method("to_degrees", &[], Receiver::Real, Outcome::Same, Meaning::Function("to_degrees")),
    method(
        "wrapping_add",
        &["b"],
        Receiver::Integers,
        Outcome::Same,
        Meaning::Operation(Operation::WrappingAdd),
    ),
    method(
        "wrapping_sub",
        &["b"],
        Receiver::Integers,
        Outcome::Same,
        Meaning::Operation(Operation::WrappingSubtract),
    ),
    method(
        "wrapping_mul",
        &["b"],
        Receiver::Integers,
        Outcome::Same,
        Meaning::Operation(Operation::WrappingMultiply),
    ),
    method("count_ones", &[], Receiver::Integers, Outcome::Count, Meaning::Operation(Operation::CountOnes)),
    method("dot", &["b"], Receiver::Vectors, Outcome::Lane, Meaning::Operation(Operation::Dot)),
    method(
        "length_squared",
        &[],
        Receiver::Vectors,
        Outcome::Lane,
        Meaning::Operation(Operation::LengthSquared),
    ),
    method("length", &[], Receiver::FloatVectors, Outcome::Lane, Meaning::Operation(Operation::Length)),
    method(
        "distance",
        &["b"],
        Receiver::FloatVectors,
        Outcome::Lane,
        Meaning::Operation(Operation::Distance),
    ),
    method("normalize", &[], Receiver::FloatVectors, Outcome::Same, Meaning::Operation(Operation::Normalize)),
    method("cross", &["b"], Receiver::ThreeLanes, Outcome::Same, Meaning::Operation(Operation::Cross)),
    method("len", &[], Receiver::Arrays, Outcome::Count, Meaning::Operation(Operation::Len)),
];

impl Method {
    /// The method with this name.
    pub fn named(name: &str) -> Option<&'static Self> {
        METHODS.iter().find(|method| method.name == name)
    }

    /// How it is written: `clamp(low, high)`.
    pub fn usage(&self) -> String {
        format!("{}({})", self.name, self.arguments.join(", "))
    }
}

impl Operation {
    /// The method that means it.
    pub fn method(self) -> Option<&'static Method> {
        METHODS.iter().find(|method| method.meaning == Meaning::Operation(self))
    }
}
