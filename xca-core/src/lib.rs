//! Extended Cellular Automata: write a model once, run it on every engine.
//!
//! An Extended Cellular Automaton is a space of cells (Di Gregorio and Serra, *Future Generation Computer
//! Systems* 16, 1999):
//!
//! - the state of a cell consists of named *substates*;
//! - *parameters* are the same in all cells;
//! - a *neighbourhood* says which cells a cell sees;
//! - *elementary processes* change the state of all cells at once, one process after the other;
//! - *steering* works on the whole state between steps.
//!
//! Cells can have *slots* that hold items, such as particles. All items of one struct are a *population*.
//!
//! # A model
//! A fire that spreads through a forest:
//!
//! ```
//! use xca_core::prelude::*;
//!
//! #[derive(Substates, Clone, Copy)]
//! struct Forest {
//!     tree: u8,
//!     fuel: Real,
//! }
//!
//! #[derive(Parameters, Clone, Debug)]
//! struct Fire {
//!     spread: Real,
//!     burning_rate: Real,
//! }
//!
//! const GREEN: u8 = 0;
//! const BURNING: u8 = 1;
//! const ASH: u8 = 2;
//!
//! #[elementary_process]
//! fn burn(cell: &mut Cell<Forest>, p: &Fire) {
//!     match cell.tree {
//!         GREEN => {
//!             for n in 1..cell.neighbour_count() {
//!                 if cell.neighbour(n).tree == BURNING && cell.random(n) < p.spread {
//!                     cell.tree = BURNING;
//!                 }
//!             }
//!         }
//!         BURNING => {
//!             cell.fuel -= p.burning_rate;
//!             if cell.fuel <= 0.0 {
//!                 cell.tree = ASH;
//!             }
//!         }
//!         _ => {}
//!     }
//! }
//!
//! let model = Model::builder("forest fire")
//!     .extents([64, 64, 1])
//!     .neighbourhood(Neighbourhood::moore_2d(1))
//!     .substates::<Forest>()
//!     .parameters(Fire { spread: 0.3, burning_rate: 0.25 })
//!     .process(burn)
//!     .fill(|site| Forest { tree: if site.cell() == [32, 32, 0] { BURNING } else { GREEN }, fuel: 1.0 })
//!     .stop_when(Schedule::Every(1), |state| {
//!         let burning = state.count(Forest::TREE, BURNING)?;
//!         Ok((burning == 0).then(|| "the fire is out".to_owned()))
//!     })
//!     .build()?;
//!
//! let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
//! let outcome = simulation.run(10_000)?;
//! assert_eq!(outcome, Outcome::Stopped { reason: "the fire is out".to_owned() });
//! assert!(simulation.state().count(Forest::TREE, ASH)? > 1_000);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | task | items |
//! |---|---|
//! | write a process | [`elementary_process`], [`Cell`], [`Slot`] |
//! | share code between processes | [`helper`] |
//! | compute `exp`, `sin` and others | [`math`] |
//! | move items from cell to cell | [`ModelBuilder::population`], [`migration`] |
//! | define a model | [`ModelBuilder`], [`Neighbourhood`], [`directions`], [`Boundary`], [`Face`] |
//! | read and change a state | [`State`] |
//! | run | [`Simulation`], [`Reference`], and the crate `xca-cpu` |
//!
//! # A step
//! Processes run in the order of their addition. Each sees the state that the previous one left. A process
//! writes only its own cell. It sees neighbours as they were before the process, and its own cell as it has
//! written it. The result therefore does not depend on the order of cells. Every engine gives the same bits,
//! at any number of threads.
//!
//! # For engines and generated code
//! The modules [`engine`], [`ir`], [`kernel`], [`plan`] and [`storage`] are not part of the interface for
//! models. They may change in any version, with the engines and the macros.

// The macros name this crate by its outer name, also in its own tests and documentation.
extern crate self as xca_core;

pub mod engine;
pub mod model;
mod parameter_set;
pub mod plan;
pub mod reduction;
mod reference;
mod simulation;
mod site;
mod state;
pub mod statistics;
mod steering;
pub mod storage;

pub use engine::{Engine, EngineFailure, Fault, StartError};
pub use model::{InitialError, Model, ModelBuilder, ModelError};
pub use parameter_set::ParameterSet;
pub use reference::Reference;
pub use simulation::{
    Batch, GroupSnapshot, ItemCounts, Outcome, Outline, RunError, RunOptions, Simulation, Snapshot,
    SnapshotError,
};
pub use site::Site;
pub use state::{Item, State, StateError};
pub use steering::{Schedule, SteeringError};
pub use xca_macros::{Parameters, States, Substates, elementary_process, helper, migration};
#[doc(inline)]
pub use xca_process::{
    AnyParameters, Argument, Boundary, Cell, Destination, Draw, ElementaryProcess, Face, Faces, Float,
    Geometry, HasSubstate, Hexagons, Holds, HostScalar, HostValue, Neighbourhood, NeighbourhoodError, Other,
    Others, ParameterError, ParameterValue, Parameters, ParametersArgument, Parity, Process, ProcessKind,
    Processes, Reached, Slot, Slots, Space, States, Stream, Substate, Substates, directions, ir, kernel,
    math, philox,
};
#[doc(hidden)]
pub use xca_process::{checks, field_type};
#[doc(hidden)]
pub use xca_values::methods;
#[doc(inline)]
pub use xca_values::{
    End, Field, Interval, Precision, Real, ScalarType, Schema, StateNames, StoredScalar, StoredType,
    UnknownPrecision, ValueType, Vector2, Vector3, Vector4,
};

/// Everything that the source of a model needs: `use xca_core::prelude::*;`.
pub mod prelude {
    pub use crate::{
        Boundary, Cell, Destination, Engine, Face, Faces, Hexagons, Item, Model, ModelBuilder, ModelError,
        Neighbourhood, Other, Outcome, ParameterError, Parameters, Precision, Real, Reference, RunError,
        RunOptions, Schedule, Simulation, Site, Slot, Slots, Space, State, States, SteeringError, Substate,
        Substates, Vector2, Vector3, Vector4, directions, elementary_process, helper, migration,
    };
}
