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
use crate::vector::Vector3;
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
