//! The smallest and the largest of many numbers, several at a time.
//!
//! One after the other, a number takes the place of the best so far where it is better, and a NaN always
//! does. So what is left is the last NaN, or the first of the numbers that equal the best. Which one is first
//! matters for zeros alone, whose signs may differ.

use bytemuck::Pod;

/// Numbers that are compared at a time.
const LANES: usize = 8;

/// The best of stored numbers, `is_better` than all others; nothing where there is none.
pub(super) fn extreme<T>(values: &[u8], is_better: impl Fn(T, T) -> bool) -> Option<f64>
where
    T: Pod + PartialEq + Into<f64>,
{
    let numbers = || values.chunks_exact(size_of::<T>()).map(bytemuck::pod_read_unaligned::<T>);
    let first = numbers().next()?;
    let mut best = [first; LANES];
    let mut is_nan = [false; LANES];
    let mut look = |lanes: &[u8]| {
        let numbers = lanes.chunks_exact(size_of::<T>()).map(bytemuck::pod_read_unaligned::<T>);
        for ((number, best), is_nan) in numbers.zip(&mut best).zip(&mut is_nan) {
            *is_nan |= is_no_number(number);
            *best = if is_better(number, *best) { number } else { *best };
        }
    };
    let lines = values.chunks_exact(LANES * size_of::<T>());
    let rest = lines.remainder();
    lines.for_each(&mut look);
    look(rest);
    let found = if is_nan.contains(&true) {
        numbers().rev().find(|number| is_no_number(*number))
    } else {
        let best = best.into_iter().fold(first, |best, one| if is_better(one, best) { one } else { best });
        let zero: f64 = best.into();
        if zero == 0.0 { numbers().find(|number| *number == best) } else { Some(best) }
    };
    found.map(Into::into)
}

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
