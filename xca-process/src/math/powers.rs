//! Powers, roots, and logarithms to other bases.

use super::exact::{INFINITE, TINY, by_precision, is_nan, not_a_number, two_product, two_quotient, two_sum};
use super::exponential::{HALF_WAY, exp, exp_of_sum, log, log_in_parts};
use super::series::{even_factorials, odd_factorials};
use crate::{Real, Vector2, helper};

pub(super) const LN_2: Real = core::f64::consts::LN_2;
const LN_10: Real = core::f64::consts::LN_10;

// The rounding errors of the logarithms in `f32` and in `f64`.
const LN_2_REST_SINGLE: Real = -1.904654299957768e-09;
const LN_2_REST_DOUBLE: Real = 2.3190468138462996e-17;
const LN_10_REST_SINGLE: Real = -3.197543673785701e-08;
const LN_10_REST_DOUBLE: Real = -2.1707562233822494e-16;

/// 2^x.
///
/// The error is below 0.80 ulp. Overflow gives infinity, underflow gives 0.
#[helper]
pub fn exp2(x: Real) -> Real {
    let exponent = x.clamp(-1100.0, 1100.0);
    let product = two_product(exponent, LN_2);
    exp_of_sum(product.x, product.y + exponent * rest_of_ln_2())
}

/// e^x - 1, accurate also near zero.
///
/// The error is below 1.40 ulp. -0.0 gives -0.0.
#[helper]
pub fn exp_m1(x: Real) -> Real {
    if x == 0.0 {
        return x;
    }
    if x.abs() < HALF_WAY {
        let z = x * x;
        let curved = 0.5 * z + (z * z * even_factorials(z) + x * z * odd_factorials(z));
        return x + curved;
    }
    exp(x) - 1.0
}

/// The logarithm to the base 2.
///
/// The error is below 0.55 ulp. Zero gives minus infinity, a negative number NaN.
#[helper]
pub fn log2(x: Real) -> Real {
    log_to_base(x, Vector2::new(LN_2, rest_of_ln_2()))
}

/// The logarithm to the base 10.
///
/// The error is below 0.55 ulp. Zero gives minus infinity, a negative number NaN.
#[helper]
pub fn log10(x: Real) -> Real {
    log_to_base(x, Vector2::new(LN_10, by_precision(LN_10_REST_SINGLE, LN_10_REST_DOUBLE)))
}

/// The natural logarithm of 1 + x, accurate also near zero.
///
/// The error is below 0.80 ulp. -1 gives minus infinity, a smaller number NaN, and -0.0 gives -0.0.
#[helper]
pub fn log_1p(x: Real) -> Real {
    if x == 0.0 {
        return x;
    }
    if x > -1.0 && x < INFINITE {
        let sum = two_sum(1.0, x);
        let logarithm = log_in_parts(sum.x);
        let rest = sum.y / sum.x;
        return logarithm.x + (logarithm.y + (rest - 0.5 * rest * rest));
    }
    log(1.0 + x)
}

/// x^n for an integer n, by products in a fixed order: x^13 is x (x^4 (x^8)).
///
/// The error grows with n, like that of n products. A negative n gives the reciprocal of the power of -n.
#[helper]
pub fn powi(x: Real, n: i32) -> Real {
    let mut rest = if n < 0 { 0_u32.wrapping_sub(n as u32) } else { n as u32 };
    let mut factor = x;
    let mut power: Real = 1.0;
    while rest > 0 {
        if rest & 1 == 1 {
            power *= factor;
        }
        factor *= factor;
        rest >>= 1;
    }
    if n < 0 { 1.0 / power } else { power }
}

/// The cube root, also of negative numbers.
///
/// The error is below 0.80 ulp. Zeros and infinities keep their signs.
#[helper]
pub fn cbrt(x: Real) -> Real {
    let size = x.abs();
    if size > 0.0 && size < INFINITE {
        let third = two_quotient(log_in_parts(size), Vector2::new(3.0, 0.0));
        let root = exp_of_sum(third.x, third.y);
        return if x < 0.0 { -root } else { root };
    }
    x
}

/// The length of the hypotenuse, the square root of x^2 + y^2, without intermediate overflow.
///
/// The error is below 1.20 ulp. Infinite if x or y is infinite, even if the other one is NaN.
#[helper]
pub fn hypot(x: Real, y: Real) -> Real {
    let a = x.abs();
    let b = y.abs();
    if a == INFINITE || b == INFINITE {
        return INFINITE;
    }
    if is_nan(a) || is_nan(b) {
        return not_a_number();
    }
    // Scaling by powers of two keeps squares far from the limits of the type.
    let longer = a.max(b);
    let mut there: Real = 1.0;
    let mut back: Real = 1.0;
    if longer > by_precision(4.611686018427388e18, 3.273390607896142e150) {
        there = by_precision(8.470329472543003e-22, 2.409919865102884e-181);
        back = by_precision(1.1805916207174113e21, 4.149515568880993e180);
    } else if longer < by_precision(9.094947017729282e-13, 3.8725919148493183e-121) {
        there = by_precision(1.2676506002282294e30, 5.260135901548374e210);
        back = by_precision(7.888609052210118e-31, 1.90109156629516e-211);
    }
    let p = there * a;
    let q = there * b;
    back * (p * p + q * q).sqrt()
}

/// The hyperbolic sine.
///
/// The error is below 2.00 ulp. -0.0 gives -0.0.
#[helper]
pub fn sinh(x: Real) -> Real {
    let size = x.abs();
    if size < TINY {
        return x;
    }
    if size < HALF_WAY {
        let z = x * x;
        return x + x * (z * odd_factorials(z));
    }
    let mut result = half_exp(size);
    if size < 20.0 {
        let power = exp(size);
        result = 0.5 * (power - 1.0 / power);
    }
    if x < 0.0 { -result } else { result }
}

/// The hyperbolic cosine.
///
/// The error is below 1.30 ulp.
#[helper]
pub fn cosh(x: Real) -> Real {
    let size = x.abs();
    if size < 20.0 {
        let power = exp(size);
        return 0.5 * (power + 1.0 / power);
    }
    half_exp(size)
}

/// e^x / 2, even if e^x overflows.
#[helper]
fn half_exp(x: Real) -> Real {
    let difference = two_sum(x, -LN_2);
    exp_of_sum(difference.x, difference.y - rest_of_ln_2())
}

#[helper]
fn rest_of_ln_2() -> Real {
    by_precision(LN_2_REST_SINGLE, LN_2_REST_DOUBLE)
}

/// The natural logarithm of the base, in two parts.
#[helper]
fn log_to_base(x: Real, base: Vector2<Real>) -> Real {
    if x > 0.0 && x < INFINITE {
        let quotient = two_quotient(log_in_parts(x), base);
        return quotient.x + quotient.y;
    }
    log(x)
}
