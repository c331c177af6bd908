//! Operations of floats.

/// Floating-point numbers.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no such method in a process: floats have",
    label = "this is no float"
)]
pub trait Floating: Copy {
    /// The square root.
    fn sqrt(self) -> Self;

    /// The largest integer that is not larger.
    fn floor(self) -> Self;

    /// The smallest integer that is not smaller.
    fn ceil(self) -> Self;

    /// The integer part, rounded toward zero.
    fn trunc(self) -> Self;

    /// The nearest integer. Halfway cases round away from zero.
    fn round(self) -> Self;

    /// The fractional part.
    fn fract(self) -> Self;

    /// The reciprocal.
    fn recip(self) -> Self;

    /// The magnitude with the sign of `sign`. A NaN counts as positive, because engines disagree about its
    /// sign.
    fn copysign(self, sign: Self) -> Self;

    /// Whether it is NaN.
    fn is_nan(self) -> bool;

    /// Whether it is neither infinite nor NaN.
    fn is_finite(self) -> bool;

    /// Whether it is infinite.
    fn is_infinite(self) -> bool;

    /// Whether the sign is negative. True for -0.0, false for NaN.
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
                // As in a shader, and without a call of the mathematical library. The difference is exact.
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
