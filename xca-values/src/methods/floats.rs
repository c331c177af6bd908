//! Of floats.

/// Floats.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no such method in a process: floats have",
    label = "this is no float"
)]
pub trait Floating: Copy {
    /// The square root.
    fn sqrt(self) -> Self;

    /// The largest whole number that is not above.
    fn floor(self) -> Self;

    /// The smallest whole number that is not below.
    fn ceil(self) -> Self;

    /// Without the fraction.
    fn trunc(self) -> Self;

    /// The nearest whole number; of two the one that is further from zero.
    fn round(self) -> Self;

    /// The fraction.
    fn fract(self) -> Self;

    /// One divided by it.
    fn recip(self) -> Self;

    /// With another sign. NaN, whose sign engines do not agree about, gives a positive one.
    fn copysign(self, sign: Self) -> Self;

    /// Whether it is NaN.
    fn is_nan(self) -> bool;

    /// Whether it is neither infinite nor NaN.
    fn is_finite(self) -> bool;

    /// Whether it is infinite.
    fn is_infinite(self) -> bool;

    /// Whether it has a negative sign, as -0.0 has, and NaN has not.
    fn is_sign_negative(self) -> bool;
}

macro_rules! floating {
    ($($type:ident)*) => {$(
        #[diagnostic::do_not_recommend]
        impl Floating for $type {
            floating!(@ $type sqrt floor ceil trunc fract recip -> Self);
            floating!(@ $type is_nan is_finite is_infinite -> bool);

            #[inline(always)]
            fn round(self) -> Self {
                // As a shader has it, and without a call of the mathematical library; the difference is
                // exact.
                let whole = self.trunc();
                if (self - whole).abs() >= 0.5 { whole + $type::signum(self) } else { whole }
            }

            #[inline(always)]
            fn copysign(self, sign: Self) -> Self {
                if Floating::is_sign_negative(sign) { -self.abs() } else { self.abs() }
            }

            #[inline(always)]
            fn is_sign_negative(self) -> bool {
                !$type::is_nan(self) && $type::is_sign_negative(self)
            }
        }
    )*};
    (@ $type:ident $($name:ident)* -> $result:ty) => {$(
        #[inline(always)]
        fn $name(self) -> $result {
            $type::$name(self)
        }
    )*};
}

floating!(f32 f64);
