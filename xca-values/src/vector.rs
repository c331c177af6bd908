//! Small vectors for positions, velocities and forces.
//!
//! The operations have the same bits everywhere. They work lane by lane. [`Vector3::dot`] sums from the first
//! lane to the last.

use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

macro_rules! vector {
    ($(#[$about:meta])* $name:ident, $first:ident $(, $lane:ident)+) => {
        $(#[$about])*
        #[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize, serde::Deserialize)]
        #[repr(C)]
        #[expect(missing_docs, reason = "the lanes have no other name")]
        pub struct $name<T> {
            pub $first: T,
            $(pub $lane: T,)+
        }

        // SAFETY: `repr(C)` with lanes of one type has no padding; all lanes are zeroable.
        #[allow(unsafe_code)]
        unsafe impl<T: bytemuck::Zeroable> bytemuck::Zeroable for $name<T> {}
        // SAFETY: `repr(C)` with lanes of one plain type has no padding and no invalid bit patterns.
        #[allow(unsafe_code)]
        unsafe impl<T: bytemuck::Pod> bytemuck::Pod for $name<T> {}

        impl<T> $name<T> {
            /// The vector with these lanes.
            #[inline(always)]
            pub const fn new($first: T $(, $lane: T)+) -> Self {
                Self { $first $(, $lane)+ }
            }
        }

        impl<T> $name<T> {
            /// Applies a function to each lane.
            #[inline(always)]
            pub fn map<U>(self, mut each: impl FnMut(T) -> U) -> $name<U> {
                $name { $first: each(self.$first) $(, $lane: each(self.$lane))+ }
            }
        }

        impl<T: Copy> $name<T> {
            /// The vector with the same value in each lane.
            #[inline(always)]
            pub const fn splat(value: T) -> Self {
                Self { $first: value $(, $lane: value)+ }
            }
        }

        impl<T: Copy + Mul<Output = T> + Add<Output = T>> $name<T> {
            /// The scalar product, summed from the first lane to the last.
            #[inline(always)]
            pub fn dot(self, other: Self) -> T {
                self.$first * other.$first $(+ self.$lane * other.$lane)+
            }

            /// The scalar product with itself.
            #[inline(always)]
            pub fn length_squared(self) -> T {
                self.dot(self)
            }
        }

        impl $name<f32> {
            /// The square root of [`Self::length_squared`].
            #[inline(always)]
            pub fn length(self) -> f32 {
                self.length_squared().sqrt()
            }
        }

        impl $name<f64> {
            /// The square root of [`Self::length_squared`].
            #[inline(always)]
            pub fn length(self) -> f64 {
                self.length_squared().sqrt()
            }
        }

        impl<T: Add<Output = T>> Add for $name<T> {
            type Output = Self;
            #[inline(always)]
            fn add(self, other: Self) -> Self {
                Self { $first: self.$first + other.$first $(, $lane: self.$lane + other.$lane)+ }
            }
        }

        impl<T: Sub<Output = T>> Sub for $name<T> {
            type Output = Self;
            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                Self { $first: self.$first - other.$first $(, $lane: self.$lane - other.$lane)+ }
            }
        }

        impl<T: Neg<Output = T>> Neg for $name<T> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self { $first: -self.$first $(, $lane: -self.$lane)+ }
            }
        }

        impl<T: Copy + Mul<Output = T>> Mul<T> for $name<T> {
            type Output = Self;
            #[inline(always)]
            fn mul(self, factor: T) -> Self {
                Self { $first: self.$first * factor $(, $lane: self.$lane * factor)+ }
            }
        }

        impl<T: Copy + Div<Output = T>> Div<T> for $name<T> {
            type Output = Self;
            #[inline(always)]
            fn div(self, divisor: T) -> Self {
                Self { $first: self.$first / divisor $(, $lane: self.$lane / divisor)+ }
            }
        }

        vector!(@scalar_first $name, f32, $first $(, $lane)+);
        vector!(@scalar_first $name, f64, $first $(, $lane)+);
        vector!(@scalar_first $name, i32, $first $(, $lane)+);
        vector!(@scalar_first $name, u32, $first $(, $lane)+);

        impl<T: Copy + Add<Output = T>> AddAssign for $name<T> {
            #[inline(always)]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }

        impl<T: Copy + Sub<Output = T>> SubAssign for $name<T> {
            #[inline(always)]
            fn sub_assign(&mut self, other: Self) {
                *self = *self - other;
            }
        }

        impl<T: Copy + Mul<Output = T>> MulAssign<T> for $name<T> {
            #[inline(always)]
            fn mul_assign(&mut self, factor: T) {
                *self = *self * factor;
            }
        }

        impl<T: Copy + Div<Output = T>> DivAssign<T> for $name<T> {
            #[inline(always)]
            fn div_assign(&mut self, divisor: T) {
                *self = *self / divisor;
            }
        }
    };
    (@scalar_first $name:ident, $scalar:ident, $first:ident $(, $lane:ident)+) => {
        impl Mul<$name<$scalar>> for $scalar {
            type Output = $name<$scalar>;
            #[inline(always)]
            fn mul(self, vector: $name<$scalar>) -> $name<$scalar> {
                $name { $first: self * vector.$first $(, $lane: self * vector.$lane)+ }
            }
        }
    };
}

vector!(
    /// A vector of two lanes, `x` and `y`.
    ///
    /// ```
    /// # use xca_values::Vector2;
    /// let velocity = Vector2::new(3.0_f64, 4.0);
    /// assert_eq!(velocity.length(), 5.0);
    /// assert_eq!(2.0 * velocity, Vector2 { x: 6.0, y: 8.0 });
    /// ```
    Vector2, x, y
);
vector!(
    /// A vector of three lanes, `x`, `y` and `z`.
    ///
    /// ```
    /// # use xca_values::Vector3;
    /// let east = Vector3::new(1.0, 0.0, 0.0);
    /// let north = Vector3::new(0.0, 1.0, 0.0);
    /// assert_eq!(east.cross(north), Vector3::new(0.0, 0.0, 1.0));
    /// assert_eq!((east + 2.0 * north).dot(east), 1.0);
    /// ```
    Vector3, x, y, z
);
vector!(
    /// A vector of four lanes, `x`, `y`, `z` and `w`.
    ///
    /// ```
    /// # use xca_values::Vector4;
    /// let layers = Vector4::new(1.0, 2.0, 3.0, 4.0);
    /// assert_eq!(layers.map(|value| value > 2.5), Vector4::new(false, false, true, true));
    /// assert_eq!(layers - Vector4::splat(1.0), Vector4::new(0.0, 1.0, 2.0, 3.0));
    /// ```
    Vector4, x, y, z, w
);

impl<T: Copy + Mul<Output = T> + Sub<Output = T>> Vector3<T> {
    /// The cross product.
    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }
}
