//! Extended Cellular Automata.

// The macros name this crate by its outer name, also in its own tests and documentation.
extern crate self as xca_core;

#[doc(hidden)]
pub mod checks;
pub mod engine;
mod geometry;
pub mod ir;
mod ir_constant;
pub mod kernel;
pub mod model;
mod neighbourhood;
mod parameters;
mod process;
mod random;
pub mod reduction;
mod reference;
mod schema;
mod simulation;
mod state;
mod steering;
pub mod storage;
mod substates;
mod value;
mod vector;
mod vocabulary;

pub use engine::{Engine, Fault, StartError};
pub use geometry::{Boundary, Geometry};
pub use model::{Model, ModelBuilder, ModelError};
pub use neighbourhood::{Hexagons, Neighbourhood, NeighbourhoodError, Parity};
pub use parameters::{AnyParameters, FromLane, ParameterError, ParameterValue, Parameters};
pub use process::{ElementaryProcess, Process, ProcessKind};
pub use random::{Owner, draw_words, philox};
pub use reference::Reference;
pub use schema::{Field, Schema};
pub use simulation::{GroupSnapshot, Outcome, RunError, RunOptions, Simulation, Snapshot};
pub use state::{Item, State, StateError};
pub use steering::{Schedule, SteeringError};
pub use substates::{HasSubstate, Substate, Substates};
pub use value::{
    Float, HostScalar, HostValue, Precision, Real, ScalarType, StoredScalar, StoredType, UnknownPrecision,
    ValueType,
};
pub use vector::{Vector2, Vector3, Vector4};
pub use vocabulary::{Cell, Destination, Other, Others, Slot, Slots, Space};
pub use xca_macros::{Parameters, Substates, elementary_process, helper, migration};

/// What a model's source needs.
pub mod prelude {
    pub use crate::{
        Boundary, Cell, Destination, Engine, Hexagons, Item, Model, ModelError, Neighbourhood, Other,
        Outcome, ParameterError, Parameters, Precision, Real, Reference, RunError, RunOptions, Schedule,
        Simulation, Slot, Slots, Space, State, SteeringError, Substate, Substates, Vector2, Vector3, Vector4,
        elementary_process, helper, migration,
    };
}
