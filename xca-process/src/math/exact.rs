//! Exact sums and products, powers of two, and the dependence on the precision.

use crate::{Real, Vector2, helper};

/// 1 + 2^-30, which in `f32` is 1.
const ALMOST_1: Real = 1.000_000_000_931_322_6;

/// 2^-12.
const SMALL: Real = 0.000244140625;

/// 2^-28. Smaller numbers are their own sine and tangent.
pub(super) const TINY: Real = 3.725290298461914e-9;

/// WGSL has no infinite constants, so `xca-wgsl` computes them.
pub(super) const INFINITE: Real = Real::INFINITY;

/// Whether `Real` is `f32` in this run. The compiler knows the answer.
#[helper]
pub(super) fn is_single() -> bool {
    ALMOST_1 == 1.0
}

/// The first number if `Real` is `f32`, the second if it is `f64`.
#[helper]
pub(super) fn by_precision(single: Real, double: Real) -> Real {
    if is_single() { single } else { double }
}

/// NaN, which WGSL cannot express.
#[helper]
#[allow(clippy::eq_op, reason = "infinity less infinity is NaN")]
pub(super) fn not_a_number() -> Real {
    INFINITE - INFINITE
}

/// Whether it is NaN.
#[helper]
#[allow(clippy::eq_op, reason = "a process has no `is_nan`")]
pub(super) fn is_nan(x: Real) -> bool {
    x != x
}

/// Whether the sign is negative, including -0.0.
#[helper]
pub(super) fn is_negative(x: Real) -> bool {
    x < 0.0 || (x == 0.0 && 1.0 / x < 0.0)
}

/// `a + b` as the rounded sum and its error (Knuth).
#[helper]
pub(super) fn two_sum(a: Real, b: Real) -> Vector2<Real> {
    let sum = a + b;
    let of_b = sum - a;
    Vector2::new(sum, (a - (sum - of_b)) + (b - of_b))
}

/// `a + b` as the rounded sum and its error, if `a` is 0 or not the smaller one (Dekker).
#[helper]
pub(super) fn ordered_sum(a: Real, b: Real) -> Vector2<Real> {
    let sum = a + b;
    Vector2::new(sum, (a - sum) + b)
}

/// The upper half of the digits and the rest (Veltkamp).
#[helper]
fn halves(a: Real) -> Vector2<Real> {
    let scaled = by_precision(4097.0, 134217729.0) * a;
    let upper = scaled - (scaled - a);
    Vector2::new(upper, a - upper)
}

/// `a * b` as the rounded product and its error (Dekker), for numbers far from the limits of the type.
#[helper]
pub(super) fn two_product(a: Real, b: Real) -> Vector2<Real> {
    let product = a * b;
    let x = halves(a);
    let y = halves(b);
    Vector2::new(product, (((x.x * y.x - product) + x.x * y.y) + x.y * y.x) + x.y * y.y)
}

/// `a / b` as the rounded quotient and its error. Both operands are in two parts, and far from the limits of
/// the type.
#[helper]
pub(super) fn two_quotient(a: Vector2<Real>, b: Vector2<Real>) -> Vector2<Real> {
    let quotient = a.x / b.x;
    let product = two_product(quotient, b.x);
    let missing = ((a.x - product.x) - product.y) + (a.y - quotient * b.y);
    Vector2::new(quotient, missing / b.x)
}

/// 2^n for -384 <= n < 640, within the range of the type.
#[helper]
pub(super) fn power_of_two(n: i32) -> Real {
    // Two factors, each a shifted bit: 2^(n mod 32), and 2^(n / 32) to the power of 32.
    let low = (1_u32 << (n & 31)) as Real;
    let mut high = (1_u32 << ((n >> 5) + 12)) as Real * SMALL;
    high *= high;
    high *= high;
    high *= high;
    high *= high;
    high *= high;
    low * high
}
