//! The meaning of the type of a field, for the derives.
//!
//! A derive sees only words, and a word can be an alias of any type. So the derive repeats the type of each
//! field, with [`RealWord`] in place of `Real`. The traits here then give the host's type, the type in
//! kernels and the description. All three follow from the same type, whatever its words mean.

use crate::float::Float;
use crate::host_value::{HostScalar, HostValue};
use crate::kernel::{KernelElement, KernelValue};
use crate::states::States;
use xca_values::{ScalarType, ValueType};
use xca_values::{Vector2, Vector3, Vector4};

/// Replaces the word `Real` in the type of a field.
#[derive(Debug, Clone, Copy)]
pub struct RealWord;

/// The type of a substate or parameter.
#[diagnostic::on_unimplemented(
    message = "this is no type of a substate or parameter",
    label = "neither a number, bool, vector or enum of states, nor an array of these"
)]
pub trait FieldType {
    /// Its description.
    const TYPE: ValueType;

    /// The type on the host.
    type Host: HostValue;

    /// The type in a kernel of precision `R`.
    type Native<R: Float>: KernelValue;

    /// Converts a value from the host to a kernel.
    fn native<R: Float>(value: Self::Host) -> Self::Native<R>;
}

/// The type of a field without arrays.
pub trait ElementType {
    /// Its description.
    const TYPE: ValueType;

    /// The type on the host.
    type Host: HostValue;

    /// The type in a kernel of precision `R`.
    type Native<R: Float>: KernelElement;

    /// Converts a value from the host to a kernel.
    fn native<R: Float>(value: Self::Host) -> Self::Native<R>;
}

/// The type of a lane.
pub trait NumberType {
    /// Its description.
    const SCALAR: ScalarType;

    /// The type on the host.
    type Host: HostScalar;

    /// The type in a kernel of precision `R`.
    type Native<R: Float>: bytemuck::Pod;

    /// Converts a value from the host to a kernel.
    fn native<R: Float>(value: Self::Host) -> Self::Native<R>;
}

/// The type of a parameter that can have a range.
#[diagnostic::on_unimplemented(
    message = "a parameter of type `{Self}` has no range",
    label = "leave this out: only numbers, and vectors and arrays of them, have a range",
    note = "to allow only some states, write an enum without the others"
)]
pub trait Ranged {
    /// Has a value if the type can have a range.
    const RANGED: () = ();
}

#[diagnostic::do_not_recommend]
impl<T: Ranged, const N: usize> Ranged for [T; N] {}

impl<T: ElementType> FieldType for T {
    const TYPE: ValueType = T::TYPE;
    type Host = T::Host;
    type Native<R: Float> = T::Native<R>;

    fn native<R: Float>(value: T::Host) -> T::Native<R> {
        T::native(value)
    }
}

/// The longest array in a struct of substates or parameters. A cell is loaded as a whole.
const LONGEST: usize = 1024;

impl<T: ElementType, const N: usize> FieldType for [T; N] {
    const TYPE: ValueType = {
        assert!(N > 0, "an array of substates or parameters needs at least 1 element");
        assert!(N <= LONGEST, "an array of substates or parameters has at most 1024 elements");
        T::TYPE.array(N as u32)
    };
    type Host = [T::Host; N];
    type Native<R: Float> = [T::Native<R>; N];

    fn native<R: Float>(value: Self::Host) -> Self::Native<R> {
        value.map(T::native)
    }
}

/// A type that can be copied and compared, as [`States`] must be. An enum that lacks this gets one message.
#[diagnostic::on_unimplemented(
    message = "values of type `{Self}` cannot be copied and compared",
    label = "`{Self}` needs `#[derive(Clone, Copy, PartialEq)]`"
)]
pub trait PlainValue {}

#[diagnostic::do_not_recommend]
impl<T: Copy + PartialEq> PlainValue for T {}

impl<T: States + PlainValue> ElementType for T {
    const TYPE: ValueType = ValueType::scalar(ScalarType::State(T::NAMES));
    type Host = T;
    type Native<R: Float> = T;

    fn native<R: Float>(value: T) -> T {
        value
    }
}

macro_rules! elements {
    ($($type:ident $host:ident $native:ty, $variant:ident, $value:ident => $conversion:expr;)*) => {$(
        impl ElementType for $type {
            const TYPE: ValueType = ValueType::scalar(ScalarType::$variant);
            type Host = $host;
            type Native<R: Float> = $native;

            fn native<R: Float>($value: $host) -> $native {
                $conversion
            }
        }
    )*};
}

macro_rules! numbers {
    ($($type:ident $host:ident $native:ty, $variant:ident, $value:ident => $conversion:expr;)*) => {$(
        elements!($type $host $native, $variant, $value => $conversion;);

        impl NumberType for $type {
            const SCALAR: ScalarType = ScalarType::$variant;
            type Host = $host;
            type Native<R: Float> = $native;

            fn native<R: Float>($value: $host) -> $native {
                $conversion
            }
        }

        #[diagnostic::do_not_recommend]
        impl Ranged for $type {}
    )*};
}

elements! {
    bool bool bool, Bool, value => value;
}

numbers! {
    u8 u8 u8, U8, value => value;
    i32 i32 i32, I32, value => value;
    u32 u32 u32, U32, value => value;
    f32 f32 f32, F32, value => value;
    f64 f64 f64, F64, value => value;
    RealWord f64 R, Real, value => R::from_f64(value);
}

macro_rules! vectors {
    ($($vector:ident $lanes:literal)*) => {$(
        impl<T: NumberType> ElementType for $vector<T> {
            const TYPE: ValueType = ValueType::vector(T::SCALAR, $lanes);
            type Host = $vector<T::Host>;
            type Native<R: Float> = $vector<T::Native<R>>;

            fn native<R: Float>(value: Self::Host) -> Self::Native<R> {
                value.map(T::native)
            }
        }

        #[diagnostic::do_not_recommend]
        impl<T: NumberType> Ranged for $vector<T> {}
    )*};
}

vectors!(Vector2 2 Vector3 3 Vector4 4);
