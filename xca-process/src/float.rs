//! The two types that `Real` stands for in a kernel.

use crate::host_value::HostScalar;
use crate::kernel::KernelElement;
use std::fmt;
use xca_values::Precision;

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

/// The two types that [`crate::Real`] can stand for in a kernel.
pub trait Float:
    sealed::Sealed
    + HostScalar
    + bytemuck::Pod
    + Default
    + PartialOrd
    + fmt::Debug
    + KernelElement<Memory = Self>
    + std::ops::Add<Output = Self>
    + std::ops::Sub<Output = Self>
    + std::ops::Mul<Output = Self>
{
    /// The precision of the type.
    const PRECISION: Precision;

    /// The nearest value.
    fn from_f64(value: f64) -> Self;

    /// The same value.
    fn to_f64(self) -> f64;

    /// A number in [0, 1) from random bits: 24 bits of the first word, or 27 and 26 bits of both.
    fn uniform(words: [u32; 2]) -> Self;

    /// The index of the cell of this side that contains the coordinate: `floor(coordinate / side)`. `None` if
    /// there is no such index (NaN, or too far away).
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
                // 2^31 is far beyond any space, and exact in both types.
                let numbered = quotient.abs() < 2_147_483_648.0;
                if !numbered {
                    return None;
                }
                // The floor without a call of the mathematical library: the cast rounds toward zero, so
                // subtract one if that went up.
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

/// A random number in [0, 1) for the host, whose `Real` is `f64`.
pub fn uniform([first, second, ..]: [u32; 4]) -> f64 {
    f64::uniform([first, second])
}
