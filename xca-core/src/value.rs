//! What a substate or a parameter can hold.

use std::fmt;

/// The scalar types of substates and parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ScalarType {
    /// `u8`
    U8,
    /// `i32`
    I32,
    /// `u32`
    U32,
    /// `f32`, whatever the precision of the run
    F32,
    /// `f64`, whatever the precision of the run
    F64,
    /// `f32` or `f64`, as the run's [`Precision`] says
    Real,
}

/// The floating type that [`Real`] stands for in a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Precision {
    /// 32 bits
    F32,
    /// 64 bits
    #[default]
    F64,
}

/// The floating type that is chosen when the model is run.
///
/// In a struct that derives `Substates` or `Parameters`, and in a process, write `Real`: the macros see the word and
/// make one copy for each [`Precision`]. In all other code, on the host, it is `f64`, into which both convert exactly.
pub type Real = f64;

/// A scalar or a small vector of scalars.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct ValueType {
    /// The scalar.
    pub scalar: ScalarType,
    /// The number of lanes: 1 for a scalar, 2 to 4 for a vector.
    pub lanes: u8,
}

/// The machine type of a stored scalar, after `Real` has been resolved by the run's precision.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
#[expect(missing_docs, reason = "the names say it")]
pub enum StoredScalar {
    U8,
    I32,
    U32,
    F32,
    F64,
}

/// The machine type of a stored substate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
pub struct StoredType {
    /// The scalar.
    pub scalar: StoredScalar,
    /// The number of lanes, 1 to 4.
    pub lanes: u8,
}

impl ScalarType {
    /// Whether a number is a value of this type; of floating ones, whether it is finite.
    pub fn fits(self, number: f64) -> bool {
        let within = |least: f64, largest: f64| number.fract() == 0.0 && (least..=largest).contains(&number);
        match self {
            Self::U8 => within(0.0, u8::MAX.into()),
            Self::I32 => within(i32::MIN.into(), i32::MAX.into()),
            Self::U32 => within(0.0, u32::MAX.into()),
            Self::F32 | Self::F64 | Self::Real => number.is_finite(),
        }
    }
}

impl StoredScalar {
    /// Writes a number that fits the type.
    pub(crate) fn encode(self, number: f64, out: &mut [u8]) {
        match self {
            Self::U8 => out.copy_from_slice(&(number as u8).to_ne_bytes()),
            Self::I32 => out.copy_from_slice(&(number as i32).to_ne_bytes()),
            Self::U32 => out.copy_from_slice(&(number as u32).to_ne_bytes()),
            Self::F32 | Self::F64 => number.encode(self, out),
        }
    }

    /// The size in bytes.
    pub const fn size(self) -> usize {
        match self {
            Self::U8 => 1,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}

impl StoredType {
    /// The size in bytes of one value; lanes are stored next to each other.
    pub const fn size(self) -> usize {
        self.scalar.size() * self.lanes as usize
    }
}

impl ValueType {
    /// The machine type at this precision.
    pub const fn stored(self, precision: Precision) -> StoredType {
        let scalar = match (self.scalar, precision) {
            (ScalarType::U8, _) => StoredScalar::U8,
            (ScalarType::I32, _) => StoredScalar::I32,
            (ScalarType::U32, _) => StoredScalar::U32,
            (ScalarType::F32, _) | (ScalarType::Real, Precision::F32) => StoredScalar::F32,
            (ScalarType::F64, _) | (ScalarType::Real, Precision::F64) => StoredScalar::F64,
        };
        StoredType { scalar, lanes: self.lanes }
    }
}

impl fmt::Display for ScalarType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::U8 => "u8",
            Self::I32 => "i32",
            Self::U32 => "u32",
            Self::F32 => "f32",
            Self::F64 => "f64",
            Self::Real => "Real",
        })
    }
}

impl fmt::Display for ValueType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.lanes {
            1 => write!(f, "{}", self.scalar),
            lanes => write!(f, "Vector{lanes}<{}>", self.scalar),
        }
    }
}

impl fmt::Display for Precision {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::F32 => "f32",
            Self::F64 => "f64",
        })
    }
}

impl std::str::FromStr for Precision {
    type Err = UnknownPrecision;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "f32" => Ok(Self::F32),
            "f64" => Ok(Self::F64),
            other => Err(UnknownPrecision(other.to_owned())),
        }
    }
}

/// A precision that is neither `f32` nor `f64`.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is not a precision; use f32 or f64")]
pub struct UnknownPrecision(String);

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

/// The two types that [`Real`] can stand for in a kernel.
pub trait Float:
    sealed::Sealed
    + HostScalar
    + bytemuck::Pod
    + std::ops::Add<Output = Self>
    + std::ops::Sub<Output = Self>
    + std::ops::Mul<Output = Self>
{
    /// Which of the two.
    const PRECISION: Precision;

    /// The nearest value.
    fn from_f64(value: f64) -> Self;

    /// The same value.
    fn to_f64(self) -> f64;

    /// A number in [0, 1) made of random bits: 24 bits of the first word, or 27 and 26 bits of both.
    fn uniform(words: [u32; 2]) -> Self;

    /// The number of the cell of this side that holds the coordinate: `floor(coordinate / side)`, or nothing where
    /// that is no number of a cell (NaN, or too far away).
    fn cell_number(coordinate: Self, side: Self) -> Option<i64>;
}

macro_rules! float {
    ($type:ident, $precision:ident, $words:ident => $uniform:expr) => {
        impl Float for $type {
            const PRECISION: Precision = Precision::$precision;

            #[inline(always)]
            fn from_f64(value: f64) -> Self {
                value as $type
            }

            #[inline(always)]
            fn to_f64(self) -> f64 {
                self.into()
            }

            #[inline(always)]
            fn uniform($words: [u32; 2]) -> Self {
                $uniform
            }

            #[inline(always)]
            fn cell_number(coordinate: Self, side: Self) -> Option<i64> {
                let quotient = coordinate / side;
                // 2^31: far beyond any space, and exact in both types.
                let numbered = quotient.abs() < 2_147_483_648.0;
                if !numbered {
                    return None;
                }
                // The floor without a call of the mathematical library: cut off, and one less where that went up.
                let cut = quotient as i32;
                Some(i64::from(cut) - i64::from(cut as $type > quotient))
            }
        }
    };
}

float!(f32, F32, words => (words[0] >> 8) as f32 * (1.0 / 16_777_216.0));
float!(f64, F64, words => {
    (f64::from(words[0] >> 5) * 67_108_864.0 + f64::from(words[1] >> 6)) * (1.0 / 9_007_199_254_740_992.0)
});

/// A scalar as the host sees it: `Real` is `f64` there.
pub trait HostScalar: Copy + Default + PartialEq + PartialOrd + fmt::Debug + Send + Sync + 'static {
    /// Writes the value in the stored type: `f64` may be stored as `f32`.
    fn encode(self, stored: StoredScalar, out: &mut [u8]);

    /// Reads the value back.
    fn decode(stored: StoredScalar, bytes: &[u8]) -> Self;
}

macro_rules! host_scalar {
    ($type:ident, $stored:pat) => {
        impl HostScalar for $type {
            fn encode(self, stored: StoredScalar, out: &mut [u8]) {
                debug_assert!(matches!(stored, $stored));
                out.copy_from_slice(&self.to_ne_bytes());
            }

            fn decode(stored: StoredScalar, bytes: &[u8]) -> Self {
                debug_assert!(matches!(stored, $stored));
                bytemuck::pod_read_unaligned(bytes)
            }
        }
    };
}

host_scalar!(u8, StoredScalar::U8);
host_scalar!(i32, StoredScalar::I32);
host_scalar!(u32, StoredScalar::U32);
host_scalar!(f32, StoredScalar::F32);

impl HostScalar for f64 {
    fn encode(self, stored: StoredScalar, out: &mut [u8]) {
        match stored {
            StoredScalar::F32 => out.copy_from_slice(&(self as f32).to_ne_bytes()),
            _ => out.copy_from_slice(&self.to_ne_bytes()),
        }
    }

    fn decode(stored: StoredScalar, bytes: &[u8]) -> Self {
        match stored {
            StoredScalar::F32 => bytemuck::pod_read_unaligned::<f32>(bytes).into(),
            _ => bytemuck::pod_read_unaligned(bytes),
        }
    }
}

/// A value of a substate or parameter as the host sees it.
pub trait HostValue: Copy + Default + PartialEq + fmt::Debug + Send + Sync + 'static {
    /// The type of its lanes.
    type Scalar: HostScalar;

    /// The number of lanes.
    const LANES: usize;

    /// One lane.
    fn lane(&self, index: usize) -> Self::Scalar;

    /// The value with these lanes.
    fn from_lanes(lane: impl FnMut(usize) -> Self::Scalar) -> Self;

    /// Writes the value in the stored type.
    fn encode(&self, stored: StoredType, out: &mut [u8]) {
        let size = stored.scalar.size();
        for (index, bytes) in out.chunks_exact_mut(size).enumerate() {
            self.lane(index).encode(stored.scalar, bytes);
        }
    }

    /// Reads the value back.
    fn decode(stored: StoredType, bytes: &[u8]) -> Self {
        let size = stored.scalar.size();
        Self::from_lanes(|index| {
            Self::Scalar::decode(stored.scalar, &bytes[index * size..(index + 1) * size])
        })
    }
}

macro_rules! scalar_host_value {
    ($($type:ident)*) => {$(
        impl HostValue for $type {
            type Scalar = $type;
            const LANES: usize = 1;

            fn lane(&self, _index: usize) -> $type {
                *self
            }

            fn from_lanes(mut lane: impl FnMut(usize) -> $type) -> Self {
                lane(0)
            }
        }
    )*};
}

scalar_host_value!(u8 i32 u32 f32 f64);
