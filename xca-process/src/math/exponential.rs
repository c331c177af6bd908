//! The exponential, the logarithm, and functions made from them.

use super::exact::{
    INFINITE, TINY, by_precision, is_nan, is_negative, not_a_number, ordered_sum, power_of_two, two_product,
    two_quotient,
};
use super::series::{THIRD, even_factorials, odd_factorials, odd_numbers};
use crate::{Real, Vector2, helper};

const LOG2_E: Real = core::f64::consts::LOG2_E;

// log(2) in three parts. The first two have 15 digits each. Their products with an exponent are then exact in
// `f32` as well.
const LOG_2_FIRST: Real = 0.693145751953125;
const LOG_2_SECOND: Real = 1.4285906217992306e-6;
const LOG_2_THIRD: Real = 1.619851018665656e-11;

const SQUARE_ROOT_OF_2: Real = core::f64::consts::SQRT_2;

/// The rounding error of 1/3 in `f32` and in `f64`.
const THIRD_REST_SINGLE: Real = -9.934107462565104e-9;
const THIRD_REST_DOUBLE: Real = 1.850371707708594e-17;

/// 2^66. Any power with a larger exponent is 0, 1 or infinite.
const LARGE_EXPONENT: Real = 73_786_976_294_838_206_464.0;

/// The argument at which `tanh` is 1/2.
pub(super) const HALF_WAY: Real = 0.549_306_144_334_054_8;

/// e^x.
///
/// The error is below 0.80 ulp. Overflow gives infinity, underflow gives 0.
#[helper]
pub fn exp(x: Real) -> Real {
    exp_of_sum(x, 0.0)
}

/// The natural logarithm.
///
/// The error is below 0.51 ulp. Zero gives minus infinity, a negative number NaN.
#[helper]
pub fn log(x: Real) -> Real {
    if x > 0.0 && x < INFINITE {
        return log_in_parts(x).x;
    }
    if x == 0.0 {
        -INFINITE
    } else if x > 0.0 {
        x
    } else {
        not_a_number()
    }
}

/// x^y.
///
/// The error is below 0.80 ulp in `f32`, 0.85 ulp in `f64`. A negative x requires an integer y; otherwise the
/// result is NaN. `pow(x, 0.0)` and `pow(1.0, y)` are 1, even with NaN. Zeros and infinities behave as in C.
#[helper]
pub fn pow(x: Real, y: Real) -> Real {
    if y == 0.0 || x == 1.0 {
        return 1.0;
    }
    if is_nan(x) || is_nan(y) {
        return not_a_number();
    }
    let size = x.abs();
    let whole = y.trunc() == y;
    let odd = whole && (0.5 * y).trunc() != 0.5 * y;
    if size == 0.0 || size == INFINITE {
        let power = if (size == 0.0) == (y > 0.0) { 0.0 } else { INFINITE };
        return if odd && is_negative(x) { -power } else { power };
    }
    if x < 0.0 && !whole {
        return not_a_number();
    }
    let mut power: Real = 1.0;
    if size != 1.0 {
        let exponent = y.clamp(-LARGE_EXPONENT, LARGE_EXPONENT);
        let logarithm = log_in_parts(size);
        let product = two_product(exponent, logarithm.x);
        power = exp_of_sum(product.x, product.y + exponent * logarithm.y);
    }
    if odd && x < 0.0 { -power } else { power }
}

/// The hyperbolic tangent.
///
/// The error is below 1.50 ulp. Infinities give 1 and -1, -0.0 gives -0.0.
#[helper]
pub fn tanh(x: Real) -> Real {
    let size = x.abs();
    if size < TINY {
        return x;
    }
    if size < HALF_WAY {
        let z = x * x;
        let sinh = ordered_sum(x, x * (z * odd_factorials(z)));
        let cosh = ordered_sum(1.0, 0.5 * z + z * z * even_factorials(z));
        let quotient = two_quotient(sinh, cosh);
        return quotient.x + quotient.y;
    }
    let result = 1.0 - 2.0 / (exp(2.0 * size) + 1.0);
    if x < 0.0 { -result } else { result }
}

/// e^(x + rest), where the rest is small relative to x.
#[helper]
pub(super) fn exp_of_sum(x: Real, rest: Real) -> Real {
    // Beyond this the result is 0 or infinite in `f64`. In `f32` the power of two below reaches that earlier.
    if x > 710.0 {
        return INFINITE;
    }
    if x < -746.0 {
        return 0.0;
    }
    // x + rest = exponent * log(2) + r + low
    let turns = x * LOG2_E;
    let exponent = (turns + if turns < 0.0 { -0.5 } else { 0.5 }) as i32;
    let n = exponent as Real;
    let first = x - n * LOG_2_FIRST;
    let second = ordered_sum(first, -(n * LOG_2_SECOND));
    let third = ordered_sum(second.x, second.y + (rest - n * LOG_2_THIRD));
    let r = third.x;
    let low = third.y;
    // e^r = cosh(r) + sinh(r)
    let z = r * r;
    let curved = 0.5 * z + (z * z * even_factorials(z) + r * z * odd_factorials(z));
    let linear = ordered_sum(1.0, r);
    let value = linear.x + (linear.y + (curved + low * linear.x));
    // In three factors. Only the last one can overflow, or lose digits by underflow.
    let part = (exponent + 1152) / 3 - 384;
    let factor = power_of_two(part);
    value * (1_u32 << (exponent - 3 * part)) as Real * factor * factor * factor
}

/// The logarithm of a positive finite number, as the rounded value and its error. It has about ten digits
/// more than the type.
#[helper]
pub(super) fn log_in_parts(x: Real) -> Vector2<Real> {
    // First x = m * 2^n with m from 1 to 2^32. The loop is bounded, in case a processor takes tiny numbers
    // for zero.
    let mut m = x;
    let mut n: Real = 0.0;
    for _ in 0..35 {
        if m >= 4_294_967_296.0 {
            m *= 2.3283064365386963e-10;
            n += 32.0;
        } else if m < 1.0 {
            m *= 4_294_967_296.0;
            n -= 32.0;
        } else {
            break;
        }
    }
    // Then m between the root of 1/2 and that of 2: the leading binary digit of m gives the power of two to
    // divide by.
    let mut digits = m as u32;
    digits |= digits >> 1;
    digits |= digits >> 2;
    digits |= digits >> 4;
    digits |= digits >> 8;
    digits |= digits >> 16;
    let below = digits >> 1;
    m /= (digits - below) as Real;
    n += below.count_ones() as Real;
    let large = m > SQUARE_ROOT_OF_2;
    m *= if large { 0.5 } else { 1.0 };
    n += if large { 1.0 } else { 0.0 };

    // log(m) = 2 artanh(s) with s = f / (2 + f), f = m - 1
    let f = m - 1.0;
    let s = two_quotient(Vector2::new(f, 0.0), ordered_sum(2.0, f));

    // w = z/3 + z^2/5 + …, in two parts
    let z = two_product(s.x, s.x);
    let z_low = z.y + 2.0 * s.x * s.y;
    let third = two_product(z.x, THIRD);
    let third_low = third.y + (z.x * by_precision(THIRD_REST_SINGLE, THIRD_REST_DOUBLE) + z_low * THIRD);
    let w = ordered_sum(third.x, third_low + z.x * z.x * odd_numbers(z.x));

    // 2 s (1 + w) + n log(2), from the largest part to the smallest
    let double = 2.0 * s.x;
    let bend = two_product(double, w.x);
    let bend_low = bend.y + (double * w.y + 2.0 * s.y * (1.0 + w.x));
    let of_m = ordered_sum(double, bend.x);
    let first = ordered_sum(n * LOG_2_FIRST, of_m.x);
    let second = ordered_sum(first.x, n * LOG_2_SECOND);
    ordered_sum(second.x, second.y + (first.y + (of_m.y + (bend_low + n * LOG_2_THIRD))))
}
