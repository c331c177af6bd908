//! The values of a user's Rust constants as data.

use crate::states::States;
use xca_values::StateNames;
use xca_values::{Vector2, Vector3, Vector4};

/// The value of a Rust constant.
#[derive(Debug, Clone, PartialEq)]
pub enum Constant {
    /// `bool`
    Bool(bool),
    /// `u8`
    U8(u8),
    /// `i32`
    I32(i32),
    /// `u32`
    U32(u32),
    /// `f32`
    F32(f32),
    /// `f64`, which is `Real` in a process.
    Real(f64),
    /// A state by its number.
    State(u8, &'static StateNames),
    /// A small vector.
    Vector(Vec<Constant>),
    /// An array.
    Array(Vec<Constant>),
}

/// The type of a constant that a process can use.
#[diagnostic::on_unimplemented(
    message = "a constant of type `{Self}` cannot be used in a process",
    label = "used in a process",
    note = "a process can use constants of type bool, u8, i32, u32, usize, f32, f64 and Real, enums that derive `States`, vectors and arrays of these"
)]
pub trait ConstantValue {
    /// The value as data.
    fn constant(&self) -> Constant;
}

macro_rules! scalar {
    ($($type:ident $variant:ident),+) => {$(
        impl ConstantValue for $type {
            fn constant(&self) -> Constant {
                Constant::$variant(*self)
            }
        }
    )+};
}

scalar!(bool Bool, u8 U8, i32 I32, u32 U32, f32 F32, f64 Real);

impl<T: States> ConstantValue for T {
    fn constant(&self) -> Constant {
        Constant::State(self.number(), T::NAMES)
    }
}

/// A number of elements or an index.
impl ConstantValue for usize {
    fn constant(&self) -> Constant {
        Constant::U32(u32::try_from(*self).unwrap_or(u32::MAX))
    }
}

macro_rules! vector {
    ($($type:ident $($lane:ident)+),+) => {$(
        impl<T: ConstantValue> ConstantValue for $type<T> {
            fn constant(&self) -> Constant {
                Constant::Vector(vec![$(self.$lane.constant()),+])
            }
        }
    )+};
}

vector!(Vector2 x y, Vector3 x y z, Vector4 x y z w);

impl<T: ConstantValue, const N: usize> ConstantValue for [T; N] {
    fn constant(&self) -> Constant {
        Constant::Array(self.iter().map(ConstantValue::constant).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::{Constant, ConstantValue};
    use xca_values::Vector2;

    #[test]
    fn values_keep_their_types() {
        assert_eq!(true.constant(), Constant::Bool(true));
        assert_eq!(7_u8.constant(), Constant::U8(7));
        assert_eq!((-7_i32).constant(), Constant::I32(-7));
        assert_eq!(7_usize.constant(), Constant::U32(7));
        assert_eq!(0.5_f32.constant(), Constant::F32(0.5));
        assert_eq!(0.1_f64.constant(), Constant::Real(0.1));
        let directions = [Vector2::new(1_i32, 0), Vector2::new(0, -1)];
        assert_eq!(
            directions.constant(),
            Constant::Array(vec![
                Constant::Vector(vec![Constant::I32(1), Constant::I32(0)]),
                Constant::Vector(vec![Constant::I32(0), Constant::I32(-1)]),
            ])
        );
    }
}
