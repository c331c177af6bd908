//! GPU
#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should"))]
mod access;
mod device;
mod engine;
mod error;
mod execution;
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
mod values;

pub use device::{Adapter, AdapterChoice, AdapterKind, DeviceError, adapters};
pub use engine::{Arithmetic, Gpu, GpuOptions, UnknownArithmetic, wgsl};
pub use error::GpuError;
