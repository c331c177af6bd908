//! The values of substates and parameters: scalar types, small vectors, states, and their ranges.
//!
//! Models import them from `xca_core`, which re-exports all of them.

mod instructions;
mod interval;
#[doc(hidden)]
pub mod methods;
mod random;
mod schema;
mod state_names;
mod value;
mod vector;

#[doc(hidden)]
pub use instructions::Instructions;
pub use interval::{End, Interval};
#[doc(hidden)]
pub use random::{Draw, Stream, philox};
pub use schema::{Field, Schema};
pub use state_names::StateNames;
#[doc(hidden)]
pub use value::Shortest;
pub use value::{Precision, Real, ScalarType, StoredScalar, StoredType, UnknownPrecision, ValueType};
pub use vector::{Vector2, Vector3, Vector4};
