//! Extended Cellular Automata.

// The macros name this crate by its outer name, also in its own tests and documentation.
extern crate self as xca_core;

pub mod ir;
mod ir_constant;
pub mod kernel;
mod parameters;
mod process;
mod random;
mod schema;
mod substates;
mod value;
mod vector;
mod vocabulary;

pub use parameters::{AnyParameters, FromLane, ParameterError, ParameterValue, Parameters};
pub use process::{ElementaryProcess, Process, ProcessKind};
pub use random::{Owner, draw_words, philox};
pub use schema::{Field, Schema};
pub use substates::{HasSubstate, Substate, Substates};
pub use value::{
    Float, HostScalar, HostValue, Precision, Real, ScalarType, StoredScalar, StoredType, UnknownPrecision, ValueType,
};
pub use vector::{Vector2, Vector3, Vector4};
pub use vocabulary::{Cell, Destination, Other, Others, Slot, Slots, Space};
pub use xca_macros::{Parameters, Substates, elementary_process, helper, migration};

/// What a model's source needs.
pub mod prelude {
    pub use crate::{
        Cell, Destination, Other, ParameterError, Parameters, Precision, Real, Slot, Slots, Space, Substate, Substates,
        Vector2, Vector3, Vector4, elementary_process, helper, migration,
    };
}
