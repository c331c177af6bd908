//! Operations of all numbers.

use crate::vector::{Vector2, Vector3, Vector4};

/// Numbers with an order, and vectors of them, lane by lane.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no such method in a process: numbers and vectors have",
    label = "this is neither a number nor a vector"
)]
pub trait Comparable: Copy {
    /// `if other < self { other } else { self }`, so that NaN and signed zeros give the same on every
    /// processor.
    fn min(self, other: Self) -> Self;

    /// `if self < other { other } else { self }`
    fn max(self, other: Self) -> Self;

    /// `self.max(low).min(high)`
    #[inline(always)]
    fn clamp(self, low: Self, high: Self) -> Self {
        self.max(low).min(high)
    }
}

/// Signed numbers, and vectors of them, lane by lane.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no such method in a process: floats and `i32` have, and vectors of these",
    label = "this is never negative, or no number"
)]
pub trait Magnitude: Copy {
    /// The absolute value.
    fn abs(self) -> Self;
}

/// Signed numbers.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no such method in a process: floats and `i32` have",
    label = "this is no float and no `i32`"
)]
pub trait Sign: Copy {
    /// For a float, 1 with its sign, and NaN for NaN. For an integer, -1, 0 or 1.
    fn signum(self) -> Self;
}

/// Numbers with Euclidean division.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no such method in a process: numbers have",
    label = "this is no number"
)]
pub trait Euclidean: Copy {
    /// The remainder, which is never negative.
    fn rem_euclid(self, divisor: Self) -> Self;

    /// The quotient that belongs to [`Self::rem_euclid`].
    fn div_euclid(self, divisor: Self) -> Self;
}

/// Integers.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no such method in a process: `u8`, `i32` and `u32` have",
    label = "this is no integer of a process"
)]
pub trait Integer: Copy {
    /// The sum, with wrapping on overflow.
    fn wrapping_add(self, other: Self) -> Self;

    /// The difference, with wrapping on overflow.
    fn wrapping_sub(self, other: Self) -> Self;

    /// The product, with wrapping on overflow.
    fn wrapping_mul(self, other: Self) -> Self;

    /// The number of ones in the binary representation.
    fn count_ones(self) -> u32;
}

macro_rules! comparable {
    ($($type:ident)*) => {$(
        #[diagnostic::do_not_recommend]
        impl Comparable for $type {
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                if other < self { other } else { self }
            }

            #[inline(always)]
            fn max(self, other: Self) -> Self {
                if self < other { other } else { self }
            }
        }
    )*};
}

comparable!(u8 i32 u32 usize f32 f64);

macro_rules! lane_by_lane {
    ($($vector:ident { $($lane:ident)+ })*) => {$(
        #[diagnostic::do_not_recommend]
        impl<T: Comparable> Comparable for $vector<T> {
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                Self { $($lane: self.$lane.min(other.$lane)),+ }
            }

            #[inline(always)]
            fn max(self, other: Self) -> Self {
                Self { $($lane: self.$lane.max(other.$lane)),+ }
            }
        }

        #[diagnostic::do_not_recommend]
        impl<T: Magnitude> Magnitude for $vector<T> {
            #[inline(always)]
            fn abs(self) -> Self {
                Self { $($lane: self.$lane.abs()),+ }
            }
        }
    )*};
}

lane_by_lane!(Vector2 { x y } Vector3 { x y z } Vector4 { x y z w });

macro_rules! by_rust {
    ($trait:ident: $($type:ident)* => $methods:tt) => {$(
        #[diagnostic::do_not_recommend]
        impl $trait for $type {
            by_rust!(@ $type $methods);
        }
    )*};
    (@ $type:ident { $($name:ident($($argument:ident)?) -> $result:ty),+ }) => {$(
        #[inline(always)]
        fn $name(self $(, $argument: Self)?) -> $result {
            $type::$name(self $(, $argument)?)
        }
    )+};
}

by_rust!(Magnitude: f32 f64 i32 => { abs() -> Self });
by_rust!(Sign: f32 f64 i32 => { signum() -> Self });
by_rust!(Euclidean: f32 f64 u8 i32 u32 usize => { rem_euclid(divisor) -> Self, div_euclid(divisor) -> Self });
by_rust!(Integer: u8 i32 u32 => {
    wrapping_add(other) -> Self,
    wrapping_sub(other) -> Self,
    wrapping_mul(other) -> Self,
    count_ones() -> u32
});
