//! Types in the source of a function.

use xca_values::ScalarType;
use xca_values::StateNames;

/// A type in the source.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Type {
    /// `bool`
    Bool,
    /// A number.
    Scalar(ScalarType),
    /// `Vector2`, `Vector3` or `Vector4` of a scalar, and the number of lanes.
    Vector(ScalarType, u8),
    /// An enum that derives `States`.
    State(&'static StateNames),
    /// `[T; N]`
    Array(Box<Type>, usize),
    /// `(A, B, …)`
    Tuple(Vec<Type>),
    /// `Destination`, the result of a migration.
    Destination,
}
