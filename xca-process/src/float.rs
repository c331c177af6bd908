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

    /// The same index if it is at least 0 and below `extent`, faster.
    fn cell_index(coordinate: Self, side: Self, extent: u32) -> Option<u32>;
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

            #[inline(always)]
            fn cell_index(coordinate: Self, side: Self, extent: u32) -> Option<u32> {
                let quotient = coordinate / side;
                // From 0 on, the cast is the floor. It makes too large numbers the largest, and NaN 0.
                let index = quotient as u32;
                ((quotient >= 0.0) & (index < extent)).then_some(index)
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

#[cfg(test)]
mod tests {
    use super::Float;

    /// Near all faces of cells, and far away.
    fn fast_index_is_the_floor<R: Float>() {
        let (side, extent) = (0.3, 7);
        let near = (-30..100).flat_map(|number| {
            let face = 0.1 * f64::from(number);
            [face, face.next_down(), face.next_up(), face - 1e-7, face + 1e-7]
        });
        let far = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -0.0, 1e9, -1e9, 1e30, -1e30, -1e-300];
        for coordinate in near.chain(far) {
            let [coordinate, side] = [coordinate, side].map(R::from_f64);
            let number = R::cell_number(coordinate, side).and_then(|number| u32::try_from(number).ok());
            let index = R::cell_index(coordinate, side, extent);
            assert_eq!(index, number.filter(|number| *number < extent), "{coordinate:?}");
        }
    }

    #[test]
    fn fast_index_is_the_floor_in_both_precisions() {
        fast_index_is_the_floor::<f32>();
        fast_index_is_the_floor::<f64>();
    }
}
