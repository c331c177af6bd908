//! Operations of vectors.

use crate::vector::{Vector2, Vector3, Vector4};
use std::ops::{Add, Mul};

/// Vectors.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no such method in a process: vectors have",
    label = "this is no vector"
)]
pub trait Lanes: Copy {
    /// The type of a lane.
    type Lane;

    /// The scalar product, summed from the first lane to the last.
    fn dot(self, other: Self) -> Self::Lane;

    /// The scalar product with itself.
    fn length_squared(self) -> Self::Lane;
}

/// Vectors of floats.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no such method in a process: vectors of floats have",
    label = "this is no vector of floats"
)]
pub trait FloatVector: Lanes {
    /// The square root of the scalar product with itself.
    fn length(self) -> Self::Lane;

    /// The length of the difference.
    fn distance(self, other: Self) -> Self::Lane;

    /// The vector divided by its length.
    fn normalize(self) -> Self;
}

macro_rules! vectors {
    ($($vector:ident)*) => {$(
        #[diagnostic::do_not_recommend]
        impl<T: Copy + Mul<Output = T> + Add<Output = T>> Lanes for $vector<T> {
            type Lane = T;

            #[inline(always)]
            fn dot(self, other: Self) -> T {
                $vector::dot(self, other)
            }

            #[inline(always)]
            fn length_squared(self) -> T {
                $vector::length_squared(self)
            }
        }

        vectors!(@ $vector f32);
        vectors!(@ $vector f64);
    )*};
    (@ $vector:ident $scalar:ident) => {
        #[diagnostic::do_not_recommend]
        impl FloatVector for $vector<$scalar> {
            #[inline(always)]
            fn length(self) -> $scalar {
                $vector::<$scalar>::length(self)
            }

            #[inline(always)]
            fn distance(self, other: Self) -> $scalar {
                (self - other).length()
            }

            #[inline(always)]
            fn normalize(self) -> Self {
                self / self.length()
            }
        }
    };
}

vectors!(Vector2 Vector3 Vector4);
