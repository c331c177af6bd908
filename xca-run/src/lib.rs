//! The program frame that every xca model's program shares.
//!
//! A scientist defines a model with [`xca_core`]; this crate makes a program of it. The whole of Conway's
//! Game of Life:
//!
//! ```no_run
//! use xca_run::prelude::*;
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
//! fn main() -> ExitCode {
//!     xca_run::main_of!("life", "Conway's Game of Life on a torus", |_given| {
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
//! ```
//!
//! `life run` now does 1000 steps on all cores, shows how far it has come, and leaves in the folder
//! `out/life`:
//!
//! | file | holds |
//! |---|---|
//! | `observables.csv` | a row of numbers every so many steps; statistics of each substate unless [`SetUp::observables`] says others |
//! | `life.pvd` | what ParaView opens: all frames with their times |
//! | `frames/life_00000050.vti`, … | all substates (`.vtp` for items and hexagons) |
//! | `frames/fish_00000050.xyz`, … | with `--formats +xyz`, the items of a population for OVITO and ASE |
//! | `initial.png`, `final.png` | pictures of the first state and the last |
//! | `final.csv` | of a population, all items by label, exact; [`read_items`] reads them back |
//! | `final_altitude.asc`, … | of a model of one layer, if [`SetUp::map`] or `--formats +asc` says so, each component of each substate of cells for geographic information systems |
//! | `final_altitude.tif`, … | with `--formats +tif`, the same as GeoTIFF |
//! | `run.json` | everything about the run: options, parameters, engine, seed, times, why it ended |
//!
//! Every program has the same command line: `--engine`, `--threads`, `--precision`, `--steps`, `--seed`,
//! `--set`, `--config`, `--out`, `--every`, `--formats`, `--initial`, `--checkpoint-every`, `--quiet`,
//! `--json`; and `life resume out/life` goes on with a run that was interrupted or killed, `life sweep
//! --seeds 10` runs it many times, `life inspect out/life` tells what it holds, `life render` draws a run and
//! animates it, `life watch` shows it in the terminal, and `life list` tells what there is. A model that has
//! options of its own is a struct that implements [`Program`]; what is saved and drawn is refined with
//! [`ItemView`] and [`CellView`].
//!
//! # The parts
//! | module | holds |
//! |---|---|
//! | [`io`] | the files: particles and time series as CSV, VTK files for ParaView, ESRI ASCII grids, GeoTIFF |
//! | [`picture`] | PNG pictures and animations |
//! | [`progress`] | the line that shows how far a run has come, and the table at its end |
//! | [`number_in`], [`positive_number`], [`whole_number`] | value parsers for a model's own options |
//! | [`interrupt`] | Ctrl-C and termination: the run ends after its current step |
//!
//! These work on plain data (slices of numbers, texts) and know nothing of models and engines.

#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should"))]

mod called;
mod command;
mod contender;
mod engines;
pub mod interrupt;
mod launcher;
mod options;
mod program;
pub mod progress;
mod terminal;

pub use command::{CommandLine, ConfigError};
pub use engines::{
    Devices, EngineDetail, EngineError, EngineKind, EngineOption, EngineOptions, Engines, Helper,
    MissingFeature,
};
pub use options::{number_in, positive_number, whole_number};
pub use program::{Assignment, Given, NoAssignment, Program};
#[doc(no_inline)]
pub use xca_io as io;
#[doc(no_inline)]
pub use xca_picture as picture;
#[doc(no_inline)]
pub use xca_record::{
    self as record, CellView, Failure, ItemView, Observable, ReadItem, SetUp, check_memory, read_items,
};

/// What a model's program needs: the words of [`xca_core::prelude`] and those of the frame.
pub mod prelude {
    pub use crate::{Given, Program, number_in, positive_number, whole_number};
    pub use clap::{self, Args};
    pub use std::process::ExitCode;
    pub use xca_core::prelude::*;
    pub use xca_io::map::{Map, Placement};
    pub use xca_io::raster::Raster;
    pub use xca_picture::ColourMap;
    pub use xca_record::{CellView, Failure, ItemView, Observable, SetUp};
}
