//! Extended Cellular Automata: write a model once, run it with the same bits on every engine.
//!
//! A model is a grid of cells, a population of particles, or both. You write what one cell or one particle
//! does, as an ordinary Rust function. An engine applies it everywhere: on one core, on all cores, on a GPU,
//! or on many machines under MPI. Results do not depend on the engine or on the number of threads.
//!
//! A model or its program depends on this crate alone. The [features](#features) add engines, files and a
//! command line.
//!
//! # A first model
//! Heat spreads over a plate:
//!
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
//!
//! let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
//! simulation.run(1000)?;
//! let mean = simulation.state().sum(Heat::TEMPERATURE)? / 1024.0;
//! assert!((mean - 0.5).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`Model::builder`] collects the definition, and [`ModelBuilder::build`] checks it. A [`Simulation`] holds
//! the state of one run. [`State`] reads and changes it.
//!
//! # Cells
//! The state of a cell is a struct of substates: numbers, vectors, arrays, and enums that derive [`States`].
//! An elementary process runs for every cell. It reads the neighbours and writes its own cell:
//!
//! ```
//! use xca::prelude::*;
//!
//! #[derive(States, Clone, Copy, Debug, PartialEq)]
//! enum Tree {
//!     Green,
//!     Burning,
//!     Ash,
//! }
//!
//! #[derive(Substates, Clone, Copy)]
//! struct Forest {
//!     tree: Tree,
//! }
//!
//! #[elementary_process]
//! fn burn(cell: &mut Cell<Forest>) {
//!     if cell.tree == Tree::Burning {
//!         cell.tree = Tree::Ash;
//!     } else if cell.tree == Tree::Green {
//!         for n in 1..cell.neighbour_count() {
//!             if cell.neighbour(n).tree == Tree::Burning {
//!                 cell.tree = Tree::Burning;
//!             }
//!         }
//!     }
//! }
//!
//! let model = Model::builder("fire")
//!     .extents([9, 9, 1])
//!     .neighbourhood(Neighbourhood::moore_2d(1))
//!     .substates::<Forest>()
//!     .process(burn)
//!     .fill(|site| Forest { tree: if site.cell() == [4, 4, 0] { Tree::Burning } else { Tree::Green } })
//!     .build()?;
//! let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
//! simulation.step()?;
//! assert_eq!(simulation.state().count(Forest::TREE, Tree::Burning)?, 8);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Neighbours show the state from before the process. The order of the cells therefore does not matter. See
//! [`Neighbourhood`] and [`Boundary`] for what a cell sees, and [`elementary_process`] for the Rust of a
//! process.
//!
//! # Items
//! Items are particles, animals or grains. All items of one struct are a population. A process can run for
//! every item, and a migration moves items from cell to cell:
//!
//! ```
//! use xca::prelude::*;
//!
//! #[derive(Substates, Clone, Copy)]
//! struct Grain {
//!     #[position]
//!     position: Vector3<Real>,
//!     velocity: Vector3<Real>,
//! }
//!
//! #[elementary_process]
//! fn drift(me: &mut Slot<Grain>) {
//!     me.position += 0.1 * me.velocity;
//! }
//!
//! #[migration]
//! fn settle(me: &Slot<Grain>, space: &Space) -> Destination {
//!     space.cell_containing(me.position)
//! }
//!
//! let model = Model::builder("drift")
//!     .extents([8, 8, 1])
//!     .neighbourhood(Neighbourhood::moore_2d(1))
//!     .population::<Grain>(4)
//!     .process((drift, settle))
//!     .populate(|site| {
//!         let grain = Grain { position: site.centre(), velocity: Vector3::new(1.0, 0.0, 0.0) };
//!         (site.cell()[0] == 0).then_some(grain)
//!     })
//!     .build()?;
//! let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
//! simulation.run(10)?;
//! let items = simulation.state().items::<Grain>()?;
//! assert_eq!(items.len(), 8);
//! assert!(items.iter().all(|item| item.cell[0] == 1));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`Slot`] has the searches for other items: in the same cell, in the neighbourhood, within a radius.
//!
//! # Parameters
//! Parameters are the same in all cells. They have units and ranges, and can be set by name:
//!
//! ```
//! use xca::prelude::*;
//!
//! #[derive(Substates, Clone, Copy)]
//! struct Colony {
//!     size: Real,
//! }
//!
//! #[derive(Parameters, Clone, Debug)]
//! struct Growth {
//!     #[parameter(unit = "1/step", range = 0.0..=1.0)]
//!     rate: Real,
//! }
//!
//! #[elementary_process]
//! fn grow(cell: &mut Cell<Colony>, p: &Growth) {
//!     cell.size += p.rate * cell.size;
//! }
//!
//! let mut model = Model::builder("growth")
//!     .extents([8, 8, 1])
//!     .substates::<Colony>()
//!     .parameters(Growth { rate: 0.1 })
//!     .process(grow)
//!     .fill(|_| Colony { size: 1.0 })
//!     .build()?;
//! model.set_parameter("rate", "0.5")?;
//! let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
//! simulation.run(2)?;
//! assert_eq!(simulation.state().get(Colony::SIZE, [0, 0, 0])?, 2.25);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Steering
//! Steering works on the whole state between steps: sources, events, stop criteria. A [`Schedule`] says when:
//!
//! ```
//! use xca::prelude::*;
//!
//! #[derive(Substates, Clone, Copy)]
//! struct Lava {
//!     thickness: Real,
//! }
//!
//! let model = Model::builder("vent")
//!     .extents([8, 8, 1])
//!     .substates::<Lava>()
//!     .steer(Schedule::Every(10), |state| {
//!         Ok(state.update(Lava::THICKNESS, &[[4, 4, 0]], |_cell, thickness| thickness + 0.5)?)
//!     })
//!     .stop_when(Schedule::Every(10), |state| {
//!         let volume = state.sum(Lava::THICKNESS)?;
//!         Ok((volume >= 2.0).then(|| "the vent is empty".to_owned()))
//!     })
//!     .build()?;
//! let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
//! let outcome = simulation.run(1000)?;
//! assert_eq!(outcome, Outcome::Stopped { reason: "the vent is empty".to_owned() });
//! assert_eq!(simulation.step_number(), 40);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Engines
//! The model stays the same. The second argument of [`Simulation::new`] chooses the engine:
//!
//! ```
//! # use xca::prelude::*;
//! # #[derive(Substates, Clone, Copy)]
//! # struct Heat { temperature: Real }
//! # let model = Model::builder("heat").extents([8, 8, 1]).substates::<Heat>().build()?;
//! let options = RunOptions { precision: Precision::F32, seed: 7 };
//! let mut one_core = Simulation::new(&model, &Reference, options)?;
//! one_core.run(10)?;
//! # #[cfg(feature = "cpu")]
//! # {
//! let mut all_cores = Simulation::new(&model, &xca::Cpu::new()?, options)?;
//! all_cores.run(10)?;
//! assert_eq!(one_core.snapshot()?, all_cores.snapshot()?);
//! # }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | engine | feature | runs on |
//! |---|---|---|
//! | [`Reference`] | | one core; the definition of the result |
//! | `xca::Cpu` | `cpu` | all cores |
//! | `xca::gpu::Gpu` | `gpu` | a GPU |
//! | `xca::parts::Parts` | `cpu` | several engines, each with a part of the space |
//! | `--engine mpi` | `mpi` | many machines; for programs only |
//!
//! A GPU gives the same bits if its driver passes a test at the start.
//!
//! # Programs
//! With the feature `run` a model becomes a program. It has a command line, a progress line, pictures, files
//! for ParaView and checkpoints:
//!
//! ```no_run
//! # #[cfg(feature = "run")]
//! # mod program {
//! use xca::prelude::*;
//!
//! #[derive(Substates, Clone)]
//! struct Life {
//!     alive: u8,
//! }
//!
//! #[elementary_process]
//! fn evolve(cell: &mut Cell<Life>) {
//!     let mut count = 0;
//!     for n in 1..cell.neighbour_count() {
//!         count += cell.neighbour(n).alive;
//!     }
//!     cell.alive = if count == 3 || (count == 2 && cell.alive == 1) { 1 } else { 0 };
//! }
//!
//! # pub
//! fn main() -> ExitCode {
//!     xca::run::main_of!("life", "Conway's Game of Life on a torus", |_given| {
//!         let model = Model::builder("life")
//!             .extents([256, 256, 1])
//!             .neighbourhood(Neighbourhood::moore_2d(1))
//!             .boundary(Boundary::Toroidal)
//!             .substates::<Life>()
//!             .process(evolve)
//!             .fill(|site| Life { alive: u8::from(site.random(0) < 0.3) })
//!             .build()?;
//!         Ok(SetUp::new(model, 1000))
//!     })
//! }
//! # }
//! # #[cfg(feature = "run")]
//! # fn main() -> std::process::ExitCode { program::main() }
//! # #[cfg(not(feature = "run"))]
//! # fn main() {}
//! ```
//!
//! `cargo run --release -- run` runs it. A program whose model has options of its own implements
//! `xca::run::Program` and calls `xca::run::main!`.
//!
//! The feature `record` writes the same files from a `main` of your own, without a command line:
//!
//! ```no_run
//! # #[cfg(feature = "record")]
//! # {
//! use xca::prelude::*;
//! use xca::record::{Run, SetUp};
//!
//! # #[derive(Substates, Clone, Copy)]
//! # struct Heat { temperature: Real }
//! # let model = Model::builder("heat").extents([8, 8, 1]).substates::<Heat>().build()?;
//! let run = Run::new(SetUp::new(model, 1000))?.every(100);
//! run.begin("out/heat", &Reference)?.go(&mut ())?;
//! # }
//! # Ok::<(), Box<dyn std::error::Error + Send + Sync>>(())
//! ```
//!
//! # Features
//! | feature | adds | default |
//! |---|---|---|
//! | | [`prelude`], models, the serial reference engine | |
//! | `cpu` | `xca::Cpu` and `xca::parts` | yes |
//! | `gpu` | `xca::gpu`; with `run` also `--engine gpu` | |
//! | `mpi` | `--engine mpi` of a program; needs an MPI library | |
//! | `record` | `xca::record`, `xca::compare`, `xca::ensemble`, `xca::picture`, `xca::io` | |
//! | `run` | `xca::run`, and its names in the prelude | |
//! | `terminal` | the subcommand `watch` of a program | |
//!
//! `gpu` and `terminal` bring many dependencies, so they are off by default. Turn them on for one command:
//!
//! ```sh
//! cargo run --release --features xca/gpu,xca/terminal -- watch --engine gpu
//! ```

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

/// Everything that the source of a model needs: `use xca::prelude::*;`.
pub mod prelude {
    #[doc(no_inline)]
    pub use xca_core::prelude::*;
    #[cfg(feature = "run")]
    #[doc(no_inline)]
    pub use xca_run::prelude::*;
}
