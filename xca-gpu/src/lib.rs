//! The GPU engine of xca: every model, unchanged, on Vulkan, Metal and Direct3D 12.
//!
//! ```no_run
//! use xca_core::prelude::*;
//! use xca_gpu::{Gpu, GpuOptions};
//!
//! #[derive(Substates, Clone, Copy)]
//! struct Counter {
//!     count: u32,
//! }
//!
//! #[elementary_process]
//! fn count(cell: &mut Cell<Counter>) {
//!     cell.count += 1;
//! }
//!
//! let builder = Model::builder("counters").extents([64, 64, 1]);
//! let model = builder.substates::<Counter>().process(count).build()?;
//! let gpu = Gpu::new(&GpuOptions::default())?;
//! println!("{}, {}", gpu.adapter(), if gpu.is_strict() { "strict" } else { "relaxed" });
//! let mut simulation = Simulation::new(&model, &gpu, RunOptions::default())?;
//! simulation.run(1000)?;
//! assert_eq!(simulation.state().get(Counter::COUNT, [3, 4, 0])?, 1000);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The state lives on the device; several steps go into one submission; reductions are done there too. With
//! *strict* arithmetic, which an adapter has to prove when it is opened, all results have the bits of the
//! reference engine. `docs/gpu.md` tells how it works and where its limits are.

#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should"))]
mod access;
mod activity;
mod cause;
mod device;
mod edges;
mod engine;
mod error;
mod execution;
mod ferry;
mod groups;
mod halo;
mod migration;
mod pace;
mod plane;
mod population;
mod program;
mod proof;
mod reduction;
mod service;
mod space;
mod stop;
mod turns;
mod values;

pub use device::{Adapter, AdapterChoice, AdapterKind, DeviceError, Handicap, adapters};
pub use engine::{Arithmetic, Gpu, GpuOptions, UnknownArithmetic, wgsl};
pub use error::GpuError;
