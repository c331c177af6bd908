//! What a method is.

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
    /// Natively by the function of `xca_core::methods` that has the method's name; in a shader by an
    /// operation of its own.
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
