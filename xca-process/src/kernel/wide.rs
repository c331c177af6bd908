//! Comparison of distances, four items at a time, on processors with AVX2.
//!
//! Each lane performs the operations of the plain loop, in the same order, with the same rounding and without
//! fused operations. The results are therefore equal.
#![allow(unsafe_code)]

use std::ops::Range;
use xca_values::{Instructions, Vector3};

/// A proof that the processor has AVX2.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wide(());

/// The sphere of near items: closer to `centre` than the root of `square`.
#[derive(Clone, Copy)]
pub(super) struct Sphere {
    pub(super) centre: Vector3<f64>,
    pub(super) square: f64,
}

impl Wide {
    pub(super) fn detect() -> Option<Self> {
        (Instructions::present() >= Instructions::Avx2).then_some(Self(()))
    }

    /// Adds the near items of a range, without the item itself.
    #[inline(always)]
    pub(super) fn keep(
        self,
        range: Range<usize>,
        item: usize,
        positions: &[Vector3<f64>],
        sphere: Sphere,
        found: &mut Vec<u32>,
    ) {
        #[cfg(target_arch = "x86_64")]
        if !range.is_empty() {
            // SAFETY: the processor has AVX2, of which `self` is the proof.
            unsafe { avx2::keep(range, item, positions, sphere, found) }
        }
        #[cfg(not(target_arch = "x86_64"))]
        let _ = (range, item, positions, sphere, found);
    }
}

#[cfg(target_arch = "x86_64")]
mod avx2 {
    use super::Sphere;
    use crate::kernel::distance;
    use std::arch::x86_64::{
        _CMP_LT_OQ, _mm256_add_pd, _mm256_blend_pd, _mm256_cmp_pd, _mm256_loadu_pd, _mm256_movemask_pd,
        _mm256_mul_pd, _mm256_permute2f128_pd, _mm256_set1_pd, _mm256_shuffle_pd, _mm256_sub_pd,
    };
    use std::ops::Range;
    use xca_values::Vector3;

    #[target_feature(enable = "avx2")]
    pub(super) fn keep(
        range: Range<usize>,
        item: usize,
        positions: &[Vector3<f64>],
        Sphere { centre, square }: Sphere,
        found: &mut Vec<u32>,
    ) {
        let (x, y, z) = (_mm256_set1_pd(centre.x), _mm256_set1_pd(centre.y), _mm256_set1_pd(centre.z));
        let reach = _mm256_set1_pd(square);
        let mut first = range.start;
        // Each load reads four positions. It may pass the end of the range, but not the last item of all.
        while first < range.end && first + 4 <= positions.len() {
            let numbers = positions[first..first + 4].as_ptr().cast::<f64>();
            // SAFETY: four vectors of three numbers lie there.
            let (a, b, c) = unsafe {
                (_mm256_loadu_pd(numbers), _mm256_loadu_pd(numbers.add(4)), _mm256_loadu_pd(numbers.add(8)))
            };
            // From x0 y0 z0 x1, y1 z1 x2 y2, z2 x3 y3 z3 to one register for each axis.
            let ends = _mm256_blend_pd::<0b1100>(a, b);
            let middle = _mm256_permute2f128_pd::<0x21>(a, c);
            let others = _mm256_blend_pd::<0b1100>(b, c);
            let dx = _mm256_sub_pd(x, _mm256_blend_pd::<0b1010>(ends, middle));
            let dy = _mm256_sub_pd(y, _mm256_shuffle_pd::<0b0101>(ends, others));
            let dz = _mm256_sub_pd(z, _mm256_blend_pd::<0b1010>(middle, others));
            let plane = _mm256_add_pd(_mm256_mul_pd(dx, dx), _mm256_mul_pd(dy, dy));
            let squares = _mm256_add_pd(plane, _mm256_mul_pd(dz, dz));
            let mut near = _mm256_movemask_pd(_mm256_cmp_pd::<_CMP_LT_OQ>(squares, reach)) as u32;
            if range.end - first < 4 {
                near &= (1 << (range.end - first)) - 1;
            }
            while near != 0 {
                let number = first + near.trailing_zeros() as usize;
                near &= near - 1;
                if number != item {
                    found.push(number as u32);
                }
            }
            first += 4;
        }
        distance::keep(first..range.end.max(first), item, positions, found, |other| {
            distance::length_squared(centre - other) < square
        });
    }

    #[cfg(test)]
    mod tests {
        use super::super::{Sphere, Wide};
        use crate::kernel::distance;
        use xca_values::Vector3;
        use xca_values::philox;

        /// The plain loop is the reference, for ranges of every length at every place, including distances on
        /// the edge.
        #[test]
        fn as_the_plain_loop() {
            let Some(wide) = Wide::detect() else { return };
            let number =
                |counter: u32, word: usize| f64::from(philox([counter, 0, 0, 0], [7, 9])[word] >> 29) * 0.25;
            let positions: Vec<Vector3<f64>> =
                (0..23).map(|item| Vector3::new(number(item, 0), number(item, 1), number(item, 2))).collect();
            let mut kept = 0;
            for item in 0..positions.len() {
                for start in 0..=positions.len() {
                    for end in start..=positions.len() {
                        let sphere = Sphere { centre: positions[item], square: 0.5 };
                        let (mut fast, mut plain) = (vec![99], vec![99]);
                        wide.keep(start..end, item, &positions, sphere, &mut fast);
                        distance::keep(start..end, item, &positions, &mut plain, |other| {
                            distance::length_squared(sphere.centre - other) < sphere.square
                        });
                        assert_eq!(fast, plain, "item {item} of {start}..{end}");
                        kept += plain.len() - 1;
                    }
                }
            }
            assert!(kept > 1000);
        }
    }
}
