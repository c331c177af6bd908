//! Three series serve all functions: those of sine, cosine and the inverse tangent. With the opposite sign of
//! the argument they give the hyperbolic functions, and from these the exponential and the logarithm.

use super::exact::is_single;
use crate::{Real, helper};

const FACTORIAL_3: Real = 1.0 / 6.0;
const FACTORIAL_4: Real = 1.0 / 24.0;
const FACTORIAL_5: Real = 1.0 / 120.0;
const FACTORIAL_6: Real = 1.0 / 720.0;
const FACTORIAL_7: Real = 1.0 / 5_040.0;
const FACTORIAL_8: Real = 1.0 / 40_320.0;
const FACTORIAL_9: Real = 1.0 / 362_880.0;
const FACTORIAL_10: Real = 1.0 / 3_628_800.0;
const FACTORIAL_11: Real = 1.0 / 39_916_800.0;
const FACTORIAL_12: Real = 1.0 / 479_001_600.0;
const FACTORIAL_13: Real = 1.0 / 6_227_020_800.0;
const FACTORIAL_14: Real = 1.0 / 87_178_291_200.0;
const FACTORIAL_15: Real = 1.0 / 1_307_674_368_000.0;
const FACTORIAL_16: Real = 1.0 / 20_922_789_888_000.0;
const FACTORIAL_17: Real = 1.0 / 355_687_428_096_000.0;

pub(super) const THIRD: Real = 1.0 / 3.0;
const FIFTH: Real = 1.0 / 5.0;
const SEVENTH: Real = 1.0 / 7.0;
const NINTH: Real = 1.0 / 9.0;
const ELEVENTH: Real = 1.0 / 11.0;
const THIRTEENTH: Real = 1.0 / 13.0;
const FIFTEENTH: Real = 1.0 / 15.0;
const SEVENTEENTH: Real = 1.0 / 17.0;
const NINETEENTH: Real = 1.0 / 19.0;
const TWENTY_FIRST: Real = 1.0 / 21.0;
const TWENTY_THIRD: Real = 1.0 / 23.0;
const TWENTY_FIFTH: Real = 1.0 / 25.0;
const TWENTY_SEVENTH: Real = 1.0 / 27.0;

/// `1/3! + z/5! + z^2/7! + …`, for `|z| < 0.62`: `sinh(x) = x + x z odd_factorials(z)` with `z = x^2`,
/// `sin(x)` with `z = -x^2`.
#[helper]
pub(super) fn odd_factorials(z: Real) -> Real {
    let mut rest: Real = 0.0;
    if !is_single() {
        rest = z * (FACTORIAL_11 + z * (FACTORIAL_13 + z * (FACTORIAL_15 + z * FACTORIAL_17)));
    }
    FACTORIAL_3 + z * (FACTORIAL_5 + z * (FACTORIAL_7 + z * (FACTORIAL_9 + rest)))
}

/// `1/4! + z/6! + z^2/8! + …`, for `|z| < 0.62`: `cosh(x) = 1 + z/2 + z^2 even_factorials(z)` with `z = x^2`,
/// `cos(x)` with `z = -x^2`.
#[helper]
pub(super) fn even_factorials(z: Real) -> Real {
    let mut rest: Real = 0.0;
    if !is_single() {
        rest = z * (FACTORIAL_12 + z * (FACTORIAL_14 + z * FACTORIAL_16));
    }
    FACTORIAL_4 + z * (FACTORIAL_6 + z * (FACTORIAL_8 + z * (FACTORIAL_10 + rest)))
}

/// `1/5 + z/7 + z^2/9 + …`, for `|z| < 0.056`: `artanh(x) = x (1 + z/3 + z^2 odd_numbers(z))` with `z = x^2`,
/// `atan(x)` with `z = -x^2`.
#[helper]
pub(super) fn odd_numbers(z: Real) -> Real {
    let mut rest: Real = 0.0;
    if !is_single() {
        rest = z
            * (FIFTEENTH
                + z * (SEVENTEENTH
                    + z * (NINETEENTH
                        + z * (TWENTY_FIRST
                            + z * (TWENTY_THIRD + z * (TWENTY_FIFTH + z * TWENTY_SEVENTH))))));
    }
    FIFTH + z * (SEVENTH + z * (NINTH + z * (ELEVENTH + z * (THIRTEENTH + rest))))
}
