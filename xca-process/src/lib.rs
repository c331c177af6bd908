//! Elementary processes for engines: the vocabulary of their source, their kernels and bodies, and their
//! space.
//!
//! Models import these items from `xca_core`. The modules [`ir`] and [`kernel`] are for engines and generated
//! code. They can change in any version.

// The macros name `xca_core`, also for the helpers of this crate.
extern crate self as xca_core;

#[doc(hidden)]
pub mod checks;
#[doc(hidden)]
pub mod field_type;
mod float;
mod host_value;
pub mod ir;
pub mod kernel;
pub mod math;
mod parameters;
mod process;
mod states;
mod substates;
mod vocabulary;

pub use float::Float;
#[doc(hidden)]
pub use float::uniform;
pub use host_value::{HostScalar, HostValue};
pub use parameters::{AnyParameters, ParameterError, ParameterValue, Parameters};
pub use process::{Argument, ElementaryProcess, Holds, ParametersArgument, Process, ProcessKind, Processes};
pub use states::States;
pub use substates::{HasSubstate, Substate, Substates};
pub use vocabulary::{Cell, Destination, Other, Others, Slot, Slots, Space};
#[doc(no_inline)]
pub use xca_space::{
    Boundary, Face, Faces, Geometry, Hexagons, Neighbourhood, NeighbourhoodError, Parity, Reached, directions,
};
#[doc(no_inline)]
pub use xca_values::*;

use xca_macros::helper;
