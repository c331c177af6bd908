//! The methods as functions. Each is written out, because error messages show its signature.

use super::{Comparable, Euclidean, FloatVector, Floating, Integer, Lanes, Magnitude, Sign};

/// `value.min(other)`
#[inline(always)]
pub fn min<T: Comparable>(value: T, other: T) -> T {
    Comparable::min(value, other)
}

/// `value.max(other)`
#[inline(always)]
pub fn max<T: Comparable>(value: T, other: T) -> T {
    Comparable::max(value, other)
}

/// `value.clamp(low, high)`
#[inline(always)]
pub fn clamp<T: Comparable>(value: T, low: T, high: T) -> T {
    Comparable::clamp(value, low, high)
}

/// `value.abs()`
#[inline(always)]
pub fn abs<T: Magnitude>(value: T) -> T {
    Magnitude::abs(value)
}

/// `value.signum()`
#[inline(always)]
pub fn signum<T: Sign>(value: T) -> T {
    Sign::signum(value)
}

/// `value.rem_euclid(divisor)`
#[inline(always)]
pub fn rem_euclid<T: Euclidean>(value: T, divisor: T) -> T {
    Euclidean::rem_euclid(value, divisor)
}

/// `value.div_euclid(divisor)`
#[inline(always)]
pub fn div_euclid<T: Euclidean>(value: T, divisor: T) -> T {
    Euclidean::div_euclid(value, divisor)
}

/// `value.wrapping_add(other)`
#[inline(always)]
pub fn wrapping_add<T: Integer>(value: T, other: T) -> T {
    Integer::wrapping_add(value, other)
}

/// `value.wrapping_sub(other)`
#[inline(always)]
pub fn wrapping_sub<T: Integer>(value: T, other: T) -> T {
    Integer::wrapping_sub(value, other)
}

/// `value.wrapping_mul(other)`
#[inline(always)]
pub fn wrapping_mul<T: Integer>(value: T, other: T) -> T {
    Integer::wrapping_mul(value, other)
}

/// `value.count_ones()`
#[inline(always)]
pub fn count_ones<T: Integer>(value: T) -> u32 {
    Integer::count_ones(value)
}

/// `value.sqrt()`
#[inline(always)]
pub fn sqrt<T: Floating>(value: T) -> T {
    Floating::sqrt(value)
}

/// `value.floor()`
#[inline(always)]
pub fn floor<T: Floating>(value: T) -> T {
    Floating::floor(value)
}

/// `value.ceil()`
#[inline(always)]
pub fn ceil<T: Floating>(value: T) -> T {
    Floating::ceil(value)
}

/// `value.trunc()`
#[inline(always)]
pub fn trunc<T: Floating>(value: T) -> T {
    Floating::trunc(value)
}

/// `value.round()`
#[inline(always)]
pub fn round<T: Floating>(value: T) -> T {
    Floating::round(value)
}

/// `value.fract()`
#[inline(always)]
pub fn fract<T: Floating>(value: T) -> T {
    Floating::fract(value)
}

/// `value.recip()`
#[inline(always)]
pub fn recip<T: Floating>(value: T) -> T {
    Floating::recip(value)
}

/// `value.copysign(sign)`
#[inline(always)]
pub fn copysign<T: Floating>(value: T, sign: T) -> T {
    Floating::copysign(value, sign)
}

/// `value.is_nan()`
#[inline(always)]
pub fn is_nan<T: Floating>(value: T) -> bool {
    Floating::is_nan(value)
}

/// `value.is_finite()`
#[inline(always)]
pub fn is_finite<T: Floating>(value: T) -> bool {
    Floating::is_finite(value)
}

/// `value.is_infinite()`
#[inline(always)]
pub fn is_infinite<T: Floating>(value: T) -> bool {
    Floating::is_infinite(value)
}

/// `value.is_sign_negative()`
#[inline(always)]
pub fn is_sign_negative<T: Floating>(value: T) -> bool {
    Floating::is_sign_negative(value)
}

/// `value.dot(other)`
#[inline(always)]
pub fn dot<T: Lanes>(value: T, other: T) -> T::Lane {
    Lanes::dot(value, other)
}

/// `value.length_squared()`
#[inline(always)]
pub fn length_squared<T: Lanes>(value: T) -> T::Lane {
    Lanes::length_squared(value)
}

/// `value.length()`
#[inline(always)]
pub fn length<T: FloatVector>(value: T) -> T::Lane {
    FloatVector::length(value)
}

/// `value.distance(other)`
#[inline(always)]
pub fn distance<T: FloatVector>(value: T, other: T) -> T::Lane {
    FloatVector::distance(value, other)
}

/// `value.normalize()`
#[inline(always)]
pub fn normalize<T: FloatVector>(value: T) -> T {
    FloatVector::normalize(value)
}
