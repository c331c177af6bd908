//! The operations behind the methods of numbers, vectors and arrays, in kernels and in code for the type
//! checker.
//!
//! The macros write `methods::sqrt(x)` for `x.sqrt()`. The receiver may then be a literal whose type is
//! inferred later. The bits are the same on every engine. For the list of methods see `xca_methods`.

mod floats;
mod functions;
mod numbers;
mod vectors;

pub use floats::Floating;
pub use functions::*;
pub use numbers::{Comparable, Euclidean, Integer, Magnitude, Sign};
pub use vectors::{FloatVector, Lanes};

use crate::value::Real;
use crate::vector::{Vector2, Vector3, Vector4};
use std::ops::{Mul, Sub};

/// Returns the receiver of a function of `xca_core::math`.
#[inline(always)]
pub fn real<T: IsReal>(value: T) -> Real {
    value.real()
}

/// Implemented for `Real` only.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no such method, `Real` has",
    label = "this is no `Real`",
    note = "write `(value as Real)` before the method"
)]
pub trait IsReal {
    /// The value itself.
    fn real(self) -> Real;
}

#[diagnostic::do_not_recommend]
impl IsReal for Real {
    #[inline(always)]
    fn real(self) -> Real {
        self
    }
}

/// `value.cross(other)`
#[inline(always)]
pub fn cross<T: Copy + Mul<Output = T> + Sub<Output = T>>(
    value: Vector3<T>,
    other: Vector3<T>,
) -> Vector3<T> {
    value.cross(other)
}

/// `array.len()`
#[inline(always)]
pub fn len<T, const N: usize>(_array: [T; N]) -> usize {
    N
}

/// Returns the receiver of a method, which Rust finds through references.
#[inline(always)]
pub fn by_value<T: ByValue>(value: T) -> T::Value {
    value.by_value()
}

/// A value, or references around it.
pub trait ByValue {
    /// Its type without references.
    type Value;

    /// The value itself.
    fn by_value(self) -> Self::Value;
}

impl<T: ByValue + Copy> ByValue for &T {
    type Value = T::Value;

    #[inline(always)]
    fn by_value(self) -> T::Value {
        (*self).by_value()
    }
}

macro_rules! by_value {
    ($(impl[$($generic:tt)*] $type:ty),*) => {
        $(impl<$($generic)*> ByValue for $type {
            type Value = Self;

            #[inline(always)]
            fn by_value(self) -> Self {
                self
            }
        })*
    };
}

by_value!(impl[] bool, impl[] u8, impl[] i32, impl[] u32, impl[] usize, impl[] f32, impl[] f64);
by_value!(impl[T] Vector2<T>, impl[T] Vector3<T>, impl[T] Vector4<T>, impl[T, const N: usize] [T; N]);
