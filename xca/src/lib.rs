//! Extended Cellular Automata: write a model once, run it with the same bits on every engine.
//!
//! This crate is all that a model or its program depends on. It gathers the others behind features:
//!
//! | feature | adds | default |
//! |---|---|---|
//! | | [`prelude`], models, the serial reference engine | |
//! | `cpu` | `xca::Cpu`, the engine for all cores, and `xca::parts`, an engine made of several | yes |
//! | `gpu` | `xca::gpu`, the engine for graphics adapters; with `run` also `--engine gpu` | |
//! | `mpi` | `--engine mpi` of a program: parts of the space on many machines; the MPI library has to be installed | |
//! | `record` | `xca::record`, `xca::compare`, `xca::ensemble`, `xca::picture` and `xca::io`: runs and their files without a command line | |
//! | `run` | `xca::run`, the command line of a model's program, and its names in the prelude | |
//! | `terminal` | the subcommand `watch` of a program | |
//!
//! # A model in a library
//! ```
//! use xca::prelude::*;
//!
//! #[derive(Substates, Clone, Copy)]
//! struct Heat {
//!     temperature: Real,
//! }
//!
//! #[elementary_process]
//! fn conduct(cell: &mut Cell<Heat>) {
//!     let mut sum = 0.0;
//!     for n in 1..cell.neighbour_count() {
//!         sum += cell.neighbour(n).temperature - cell.temperature;
//!     }
//!     cell.temperature += 0.2 * sum;
//! }
//!
//! let model = Model::builder("heat")
//!     .extents([32, 32, 1])
//!     .neighbourhood(Neighbourhood::von_neumann_2d(1))
//!     .boundary(Boundary::Toroidal)
//!     .substates::<Heat>()
//!     .process(conduct)
//!     .fill(|site| Heat { temperature: if site.cell()[0] < 16 { 1.0 } else { 0.0 } })
//!     .build()?;
//! let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
//! simulation.run(1000)?;
//! let mean = simulation.state().sum(Heat::TEMPERATURE)? / 1024.0;
//! assert!((mean - 0.5).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # A program
//! With the feature `run` the same model becomes a program with a command line, pictures and
//! checkpoints. `fn main() -> ExitCode` calls the macro `xca::run::main_of!` or `xca::run::main!`.
//!
//! The GPU engine and `watch` bring many dependencies. A program has them if it is built with the features:
//! `cargo run --release --features xca/gpu,xca/terminal -- watch --engine gpu`.

// The macros name this crate by its outer name, also in its own tests and documentation.
extern crate self as xca;

#[doc(hidden)]
pub use xca_core as __core;

#[cfg(feature = "record")]
#[doc(no_inline)]
pub use xca_compare as compare;
#[doc(no_inline)]
pub use xca_core::*;
#[cfg(feature = "cpu")]
#[doc(no_inline)]
pub use xca_cpu::{Cpu, CpuError};
#[cfg(feature = "record")]
#[doc(no_inline)]
pub use xca_ensemble as ensemble;
#[cfg(feature = "gpu")]
#[doc(no_inline)]
pub use xca_gpu as gpu;
#[cfg(feature = "record")]
#[doc(no_inline)]
pub use xca_io as io;
#[cfg(feature = "cpu")]
#[doc(no_inline)]
pub use xca_parts as parts;
#[cfg(feature = "record")]
#[doc(no_inline)]
pub use xca_picture as picture;
#[cfg(feature = "record")]
#[doc(no_inline)]
pub use xca_record as record;
#[cfg(feature = "run")]
#[doc(no_inline)]
pub use xca_run as run;

/// What a model's source needs.
pub mod prelude {
    #[doc(no_inline)]
    pub use xca_core::prelude::*;
    #[cfg(feature = "run")]
    #[doc(no_inline)]
    pub use xca_run::prelude::*;
}
