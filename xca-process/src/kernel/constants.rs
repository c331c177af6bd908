//! Constants of the user's code in kernels.

use crate::float::Float;
use crate::states::States;

/// A constant of the user's code in a kernel of precision `R`. `f64`, which stands for `Real`, becomes `R`.
pub trait KernelConstant<R> {
    /// The type in the kernel.
    type Native;

    /// Converts the constant.
    fn native(self) -> Self::Native;
}

macro_rules! same_constant {
    ($($type:ident)*) => {$(
        impl<R> KernelConstant<R> for $type {
            type Native = $type;
            #[inline(always)]
            fn native(self) -> $type {
                self
            }
        }
    )*};
}

same_constant!(bool u8 i32 u32 usize f32);

impl<R: Float> KernelConstant<R> for f64 {
    type Native = R;
    #[inline(always)]
    fn native(self) -> R {
        R::from_f64(self)
    }
}

impl<R, T: States> KernelConstant<R> for T {
    type Native = T;
    #[inline(always)]
    fn native(self) -> T {
        self
    }
}

impl<R, T: KernelConstant<R>, const N: usize> KernelConstant<R> for [T; N] {
    type Native = [T::Native; N];
    #[inline(always)]
    fn native(self) -> Self::Native {
        self.map(T::native)
    }
}

macro_rules! vector_constant {
    ($($vector:ident { $($lane:ident),+ })*) => {$(
        impl<R, T: KernelConstant<R>> KernelConstant<R> for xca_values::$vector<T> {
            type Native = xca_values::$vector<T::Native>;
            #[inline(always)]
            fn native(self) -> Self::Native {
                xca_values::$vector::new($(self.$lane.native()),+)
            }
        }
    )*};
}

vector_constant!(Vector2 { x, y } Vector3 { x, y, z } Vector4 { x, y, z, w });

/// Converts a constant of the user's code. The macros write calls of this function.
#[inline(always)]
pub fn constant<R, T: KernelConstant<R>>(value: T) -> T::Native {
    value.native()
}
