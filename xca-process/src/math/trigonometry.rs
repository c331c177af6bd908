//! Sine, cosine, tangent, and their inverses.

use super::exact::{
    INFINITE, TINY, by_precision, is_nan, is_negative, not_a_number, ordered_sum, two_quotient, two_sum,
};
use super::series::{THIRD, even_factorials, odd_factorials, odd_numbers};
use crate::{Real, Vector2, Vector3, helper};

const TWO_OVER_PI: Real = core::f64::consts::FRAC_2_PI;
const RADIANS_IN_A_DEGREE: Real = core::f64::consts::PI / 180.0;
const DEGREES_IN_A_RADIAN: Real = 180.0 / core::f64::consts::PI;
const QUARTER_OF_PI: Real = core::f64::consts::FRAC_PI_4;

// pi/2, pi and the angle with tangent 1/2, each as an `f32` number and the rest.
const HALF_PI: Real = 1.5707963705062866;
const HALF_PI_REST: Real = -4.3711390001862426e-8;
const PI: Real = 3.1415927410125732;
const PI_REST: Real = -8.742278000372485e-8;
const ANGLE_OF_HALF: Real = 0.46364760398864746;
const ANGLE_OF_HALF_REST: Real = 5.012158655276756e-9;

/// The sine of an angle in radians.
///
/// The error is below 0.95 ulp for angles up to 4096 in `f32` and 2^20 in `f64`. Beyond that, it is below one
/// unit in the last place of 1. Beyond 2^24 and 2^40 the result is NaN.
#[helper]
pub fn sin(x: Real) -> Real {
    if x.abs() < TINY {
        return x;
    }
    let angle = reduced(x);
    match angle.z as i32 {
        0 => sine(angle).x,
        1 => cosine(angle).x,
        2 => -sine(angle).x,
        _ => -cosine(angle).x,
    }
}

/// The cosine of an angle in radians.
///
/// The error is below 0.90 ulp for angles up to 4096 in `f32` and 2^20 in `f64`. Beyond that, it is below one
/// unit in the last place of 1. Beyond 2^24 and 2^40 the result is NaN.
#[helper]
pub fn cos(x: Real) -> Real {
    let angle = reduced(x);
    match angle.z as i32 {
        0 => cosine(angle).x,
        1 => -sine(angle).x,
        2 => -cosine(angle).x,
        _ => sine(angle).x,
    }
}

/// The tangent of an angle in radians.
///
/// The error is below 1.20 ulp for angles up to 4096 in `f32` and 2^20 in `f64`. Beyond that, it is that of
/// the quotient of sine and cosine. Beyond 2^24 and 2^40 the result is NaN.
#[helper]
pub fn tan(x: Real) -> Real {
    if x.abs() < TINY {
        return x;
    }
    let angle = reduced(x);
    let opposite = sine(angle);
    let adjacent = cosine(angle);
    let even = angle.z as i32 & 1 == 0;
    let tangent =
        two_quotient(if even { opposite } else { -adjacent }, if even { adjacent } else { opposite });
    tangent.x + tangent.y
}

/// The inverse tangent in radians, between -pi/2 and pi/2.
///
/// The error is below 0.65 ulp. Infinities give -pi/2 and pi/2, -0.0 gives -0.0.
#[helper]
pub fn atan(x: Real) -> Real {
    let size = x.abs();
    if size <= 1.0 {
        let angle = angle_below_diagonal(size, 1.0).x;
        return if is_negative(x) { -angle } else { angle };
    }
    let angle = difference(HALF_PI, HALF_PI_REST, angle_below_diagonal(1.0, size));
    if x < 0.0 { -angle } else { angle }
}

/// The angle of the direction (x, y) in radians, between -pi and pi.
///
/// The error is below 0.60 ulp. Signed zeros and infinities behave as in C: `atan2(0.0, -1.0)` is pi,
/// `atan2(-0.0, -1.0)` is -pi, and two infinities give a diagonal.
#[helper]
pub fn atan2(y: Real, x: Real) -> Real {
    if is_nan(x) || is_nan(y) {
        return not_a_number();
    }
    let mut width = x.abs();
    let mut height = y.abs();
    if width == INFINITE || height == INFINITE {
        width = if width == INFINITE { 1.0 } else { 0.0 };
        height = if height == INFINITE { 1.0 } else { 0.0 };
    }
    let left = is_negative(x);
    let mut angle: Real = 0.0;
    if height > width {
        let rest = angle_below_diagonal(width, height);
        angle = difference(HALF_PI, HALF_PI_REST, if left { -rest } else { rest });
    } else if height > 0.0 {
        let acute = angle_below_diagonal(height, width);
        angle = if left { difference(PI, PI_REST, acute) } else { acute.x };
    } else if left {
        angle = difference(PI, PI_REST, Vector2::splat(0.0));
    }
    if is_negative(y) { -angle } else { angle }
}

/// The inverse sine in radians, between -pi/2 and pi/2.
///
/// The error is below 1.60 ulp. Beyond -1 and 1 the result is NaN. -0.0 gives -0.0.
#[helper]
pub fn asin(x: Real) -> Real {
    atan2(x, ((1.0 - x) * (1.0 + x)).sqrt())
}

/// The inverse cosine in radians, between 0 and pi.
///
/// The error is below 1.60 ulp. Beyond -1 and 1 the result is NaN.
#[helper]
pub fn acos(x: Real) -> Real {
    atan2(((1.0 - x) * (1.0 + x)).sqrt(), x)
}

/// Converts degrees to radians: a product with the rounded pi/180.
#[helper]
pub fn to_radians(x: Real) -> Real {
    x * RADIANS_IN_A_DEGREE
}

/// Converts radians to degrees: a product with the rounded 180/pi.
#[helper]
pub fn to_degrees(x: Real) -> Real {
    x * DEGREES_IN_A_RADIAN
}

/// `first + rest - angle`, where the angle is in two parts.
#[helper]
fn difference(first: Real, rest: Real, angle: Vector2<Real>) -> Real {
    let sum = two_sum(first, -angle.x);
    sum.x + (sum.y + (rest - angle.y))
}

/// The angle of the direction (x, y) for 0 <= y <= x and x > 0, as the rounded value and its error.
#[helper]
fn angle_below_diagonal(y: Real, x: Real) -> Vector2<Real> {
    let slope = y / x;
    if slope < TINY {
        return Vector2::new(slope, 0.0);
    }
    // Scaling by powers of two keeps the numbers far from the limits of the type. The loop is bounded, in
    // case a processor takes tiny numbers for zero.
    let mut size = Vector2::new(x, y);
    for _ in 0..18 {
        if size.x >= 18_446_744_073_709_551_616.0 {
            size *= 5.421010862427522e-20;
        } else if size.x < 1.0 {
            size *= 18_446_744_073_709_551_616.0;
        } else {
            break;
        }
    }
    // Rotate back by a known angle, with tangent 0, 1/2 or 1. The remaining angle has the tangent (y - t x) /
    // (x + t y).
    let mut turn: Real = 0.0;
    let mut known = Vector2::splat(0.0);
    if slope > 0.72 {
        turn = 1.0;
        known = Vector2::new(0.5 * HALF_PI, 0.5 * HALF_PI_REST);
    } else if slope > 0.236 {
        turn = 0.5;
        known = Vector2::new(ANGLE_OF_HALF, ANGLE_OF_HALF_REST);
    }
    let opposite = two_sum(size.y, -(turn * size.x));
    let adjacent = ordered_sum(size.x, turn * size.y);
    let t = two_quotient(opposite, adjacent);
    let z = -(t.x * t.x);
    let curved = t.x * (z * THIRD + z * z * odd_numbers(z));
    let sum = ordered_sum(known.x, t.x);
    ordered_sum(sum.x, sum.y + (known.y + (t.y + curved)))
}

/// x - n * pi/2 with |x| at most pi/4, in two parts, and n modulo 4. NaN if x is too large.
#[helper]
fn reduced(x: Real) -> Vector3<Real> {
    let size = x.abs();
    if size <= QUARTER_OF_PI {
        return Vector3::new(x, 0.0, 0.0);
    }
    if is_nan(x) || size > by_precision(16_777_216.0, 1_099_511_627_776.0) {
        return Vector3::splat(not_a_number());
    }
    // The products below are exact up to this number of turns.
    let exact = by_precision(4_096.0, 1_048_576.0);
    let mut rest = Vector2::new(x, 0.0);
    if size > exact {
        let turns = nearest(rest.x * TWO_OVER_PI / exact);
        rest = turned_back(rest, turns as Real * exact);
    }
    let turns = nearest(rest.x * TWO_OVER_PI);
    rest = turned_back(rest, turns as Real);
    Vector3::new(rest.x, rest.y, (turns & 3) as Real)
}

#[helper]
fn nearest(x: Real) -> i32 {
    (x + if x < 0.0 { -0.5 } else { 0.5 }) as i32
}

/// An angle minus a number of right angles. The parts of pi/2 have so few digits that all products except the
/// last are exact.
#[helper]
fn turned_back(angle: Vector2<Real>, turns: Real) -> Vector2<Real> {
    let a = two_sum(angle.x, -turns * by_precision(1.5703125, 1.5707963267341256));
    let b = two_sum(a.x, -turns * by_precision(0.0004837512969970703, 6.077100506303966e-11));
    let c = two_sum(b.x, -turns * by_precision(7.549533620476723e-8, 2.0222662487111665e-21));
    let d = two_sum(c.x, -turns * by_precision(2.5632829192545614e-12, 8.478427660348229e-32));
    let last = -turns * by_precision(6.123233995736766e-17, 2.0670321098263988e-43);
    ordered_sum(d.x, (((angle.y + a.y) + b.y) + c.y) + (d.y + last))
}

/// The sine of an angle of at most pi/4, in two parts.
#[helper]
fn sine(angle: Vector3<Real>) -> Vector2<Real> {
    let z = -(angle.x * angle.x);
    ordered_sum(angle.x, angle.y + angle.x * (z * odd_factorials(z)))
}

/// The cosine of an angle of at most pi/4, in two parts.
#[helper]
fn cosine(angle: Vector3<Real>) -> Vector2<Real> {
    let z = -(angle.x * angle.x);
    let parabola = ordered_sum(1.0, 0.5 * z);
    ordered_sum(parabola.x, parabola.y + (z * z * even_factorials(z) - angle.x * angle.y))
}
