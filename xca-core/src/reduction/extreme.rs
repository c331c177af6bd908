//! The smallest and the largest of many numbers, several at a time.
//!
//! One after the other, a number takes the place of the best so far where it is better, and a NaN always
//! does. So what is left is the last NaN, or the first of the numbers that equal the best. Which one is first
//! matters for zeros alone, whose signs may differ.

use bytemuck::Pod;
use xca_process::kernel::{self, Work};

/// Numbers that are compared at a time.
const LANES: usize = 16;

/// The best of stored numbers, `is_better` than all others; nothing where there is none.
pub(super) fn extreme<T>(values: &[u8], is_better: impl Fn(T, T) -> bool) -> Option<f64>
where
    T: Pod + PartialEq + Into<f64>,
{
    let first = numbers(values).next()?;
    let mut lanes = Lanes { best: [first; LANES], is_nan: [false; LANES] };
    kernel::run(Look { values, is_better: &is_better, lanes: &mut lanes });
    let found = if lanes.is_nan.contains(&true) {
        numbers(values).rev().find(|number| is_no_number(*number))
    } else {
        let best =
            lanes.best.into_iter().fold(first, |best, one| if is_better(one, best) { one } else { best });
        let zero: f64 = best.into();
        if zero == 0.0 { numbers(values).find(|number| *number == best) } else { Some(best) }
    };
    found.map(Into::into)
}

/// The numbers of stored bytes.
#[inline(always)]
fn numbers<T: Pod>(values: &[u8]) -> impl DoubleEndedIterator<Item = T> + '_ {
    values.chunks_exact(size_of::<T>()).map(bytemuck::pod_read_unaligned::<T>)
}

/// Every `LANES`th number.
struct Lanes<T> {
    best: [T; LANES],
    is_nan: [bool; LANES],
}

/// Looks for the best number of each lane.
struct Look<'a, T, B> {
    values: &'a [u8],
    is_better: &'a B,
    lanes: &'a mut Lanes<T>,
}

impl<T: Pod + PartialEq, B: Fn(T, T) -> bool> Work for Look<'_, T, B> {
    #[inline(always)]
    fn run(self) {
        let Lanes { mut best, mut is_nan } = *self.lanes;
        let mut look = |lane: usize, number: T| {
            is_nan[lane] |= is_no_number(number);
            best[lane] = if (self.is_better)(number, best[lane]) { number } else { best[lane] };
        };
        let size = size_of::<T>();
        let lines = self.values.chunks_exact(LANES * size);
        numbers(lines.remainder()).enumerate().for_each(|(lane, number)| look(lane, number));
        for line in lines {
            // The compiler knows the number of turns.
            for lane in 0..LANES {
                look(lane, bytemuck::pod_read_unaligned(&line[lane * size..(lane + 1) * size]));
            }
        }
        *self.lanes = Lanes { best, is_nan };
    }
}

#[inline(always)]
#[allow(clippy::eq_op, reason = "a NaN equals nothing")]
fn is_no_number<T: PartialEq + Copy>(number: T) -> bool {
    number != number
}

#[cfg(test)]
mod tests {
    use super::extreme;

    /// One after the other: a better number takes the place of the one before, and a NaN always does.
    fn in_turn(values: &[f64], is_better: impl Fn(f64, f64) -> bool) -> Option<f64> {
        values.iter().copied().reduce(|all, one| if is_better(one, all) || one.is_nan() { one } else { all })
    }

    fn bits(number: Option<f64>) -> Option<u64> {
        number.map(f64::to_bits)
    }

    /// All orders of zeros, NaN of two kinds and other numbers, in rows of many lengths.
    #[test]
    fn as_one_after_the_other() {
        let other_nan = f64::from_bits(f64::NAN.to_bits() | 5);
        let pool = [0.0, -0.0, 1.0, -1.0, f64::NAN, other_nan, f64::INFINITY, -f64::INFINITY];
        let mut state = 1_u64;
        let mut draw = |below: u64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((state >> 33) % below) as usize
        };
        for length in 0..40 {
            for kinds in 1..=pool.len() as u64 {
                for _ in 0..20 {
                    let start = draw(pool.len() as u64);
                    let values: Vec<f64> =
                        (0..length).map(|_| pool[(start + draw(kinds)) % pool.len()]).collect();
                    let bytes: &[u8] = bytemuck::cast_slice(&values);
                    let largest = extreme::<f64>(bytes, |a, b| a > b);
                    assert_eq!(bits(largest), bits(in_turn(&values, |a, b| a > b)), "{values:?}");
                    let smallest = extreme::<f64>(bytes, |a, b| a < b);
                    assert_eq!(bits(smallest), bits(in_turn(&values, |a, b| a < b)), "{values:?}");
                }
            }
        }
    }
}
