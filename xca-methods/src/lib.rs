//! The methods that numbers, vectors and arrays have in an elementary process.
//!
//! This list is the only one: the macros accept the methods in it, say in their messages what it says, and write calls of the functions that
//! it names; shaders are written from it; the tables of the documentation are those of [`table`].
//!
//! A method is either an [`Operation`], which each engine has for each type of number, or a function of `xca_core::math`, which is written
//! once, for `Real`.

mod list;

pub use list::METHODS;

/// A method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Method {
    /// What the source calls it.
    pub name: &'static str,
    /// The arguments beside the receiver, as the documentation calls them.
    pub arguments: &'static [&'static str],
    /// What has it.
    pub receiver: Receiver,
    /// What it gives.
    pub result: Outcome,
    /// How it is made.
    pub meaning: Meaning,
}

/// How a method is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Meaning {
    /// Natively by the function of `xca_core::methods` that has the method's name; in a shader by an operation of its own.
    Operation(Operation),
    /// By this function of `xca_core::math`, on every engine.
    Function(&'static str),
}

/// What has a method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Receiver {
    /// Numbers and vectors.
    Numbers,
    /// Floats and `i32`, and vectors of these.
    Signed,
    /// Floats and `i32`.
    SignedScalars,
    /// `f32`, `f64`, `Real`.
    Floats,
    /// `Real` alone.
    Real,
    /// Floats and integers.
    Scalars,
    /// `u8`, `i32`, `u32`.
    Integers,
    /// Vectors.
    Vectors,
    /// Vectors of floats.
    FloatVectors,
    /// Vectors of three lanes.
    ThreeLanes,
    /// Arrays.
    Arrays,
}

/// The type that a method gives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// That of the receiver.
    Same,
    /// `bool`
    Truth,
    /// `u32`, and `usize` of an array.
    Count,
    /// That of the vector's lanes.
    Lane,
}

/// What an engine computes by itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Operation {
    /// `a.min(b)`: `if b < a { b } else { a }`, of vectors lane by lane.
    Min,
    /// `a.max(b)`: `if a < b { b } else { a }`, of vectors lane by lane.
    Max,
    /// `a.clamp(low, high)`: `a.max(low).min(high)`
    Clamp,
    /// `a.abs()`, of vectors lane by lane.
    Abs,
    /// `a.signum()`: of floats 1 with the sign of a, and NaN of NaN; of integers -1, 0 or 1.
    Signum,
    /// `a.copysign(b)`: a with the sign of b, where NaN has a positive one.
    CopySign,
    /// `a.sqrt()`
    SquareRoot,
    /// `a.floor()`
    Floor,
    /// `a.ceil()`
    Ceiling,
    /// `a.trunc()`
    Truncate,
    /// `a.round()`: halves away from zero.
    Round,
    /// `a.fract()`: `a - a.trunc()`
    Fraction,
    /// `a.recip()`: `1 / a`
    Reciprocal,
    /// `a.is_nan()`
    IsNan,
    /// `a.is_finite()`
    IsFinite,
    /// `a.is_infinite()`
    IsInfinite,
    /// `a.is_sign_negative()`, which NaN is not.
    IsSignNegative,
    /// `a.rem_euclid(b)`: from 0 to below the size of b.
    RemainderEuclid,
    /// `a.div_euclid(b)`: the quotient to that remainder.
    DivideEuclid,
    /// `a.wrapping_add(b)` of integers.
    WrappingAdd,
    /// `a.wrapping_sub(b)` of integers.
    WrappingSubtract,
    /// `a.wrapping_mul(b)` of integers.
    WrappingMultiply,
    /// `a.count_ones()` of integers, `u32`.
    CountOnes,
    /// `a.dot(b)`: `a.x * b.x + a.y * b.y + …`, added from the left.
    Dot,
    /// `a.cross(b)` of three lanes.
    Cross,
    /// `a.length_squared()`: `a.dot(a)`
    LengthSquared,
    /// `a.length()`: `a.dot(a).sqrt()`
    Length,
    /// `a.normalize()`: `a / a.length()`
    Normalize,
    /// `a.distance(b)`: `(a - b).length()`
    Distance,
    /// `a.len()` of arrays.
    Len,
}

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

impl Receiver {
    /// All of them, in the order of the documentation.
    pub const ALL: [Self; 11] = [
        Self::Numbers,
        Self::Scalars,
        Self::Signed,
        Self::SignedScalars,
        Self::Floats,
        Self::Real,
        Self::Integers,
        Self::Vectors,
        Self::FloatVectors,
        Self::ThreeLanes,
        Self::Arrays,
    ];

    /// What the documentation calls them.
    pub fn words(self) -> &'static str {
        match self {
            Self::Numbers => "numbers and vectors have",
            Self::Signed => "floats, `i32` and vectors of these have",
            Self::SignedScalars => "floats and `i32` have",
            Self::Floats => "floats have",
            Self::Real => "`Real` has",
            Self::Scalars => "numbers have",
            Self::Integers => "integers have",
            Self::Vectors => "vectors have",
            Self::FloatVectors => "vectors of floats have",
            Self::ThreeLanes => "`Vector3` has",
            Self::Arrays => "arrays have",
        }
    }
}

/// The methods as rows of a Markdown table, one for each kind of receiver.
pub fn table() -> Vec<String> {
    let row = |receiver: Receiver| {
        let methods: Vec<String> = METHODS
            .iter()
            .filter(|method| method.receiver == receiver)
            .map(|method| format!("`{}`", method.usage()))
            .collect();
        format!("| {} | {} |", receiver.words(), methods.join(", "))
    };
    Receiver::ALL.into_iter().map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::{METHODS, Meaning, Method, Receiver, table};

    #[test]
    fn each_name_and_each_meaning_stands_once() {
        for (number, method) in METHODS.iter().enumerate() {
            let others = METHODS.iter().enumerate().filter(|(other, _)| *other != number);
            for (_, other) in others {
                assert_ne!(method.name, other.name);
                assert_ne!(method.meaning, other.meaning, "{}", method.name);
            }
            assert_eq!(Method::named(method.name), Some(method));
            if let Meaning::Operation(operation) = method.meaning {
                assert_eq!(operation.method(), Some(method));
            }
        }
        assert_eq!(Method::named("mul_add"), None);
    }

    #[test]
    fn each_method_stands_in_the_table_once() {
        let text = table().join("\n");
        assert_eq!(Receiver::ALL.len(), text.lines().count());
        for method in METHODS {
            assert_eq!(text.matches(&format!("`{}`", method.usage())).count(), 1, "{}", method.name);
        }
    }
}
