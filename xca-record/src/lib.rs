//! Records of a simulation: frames, time series, tables, pictures and checkpoints, from a `main` of your own.
//!
//! A [`SetUp`] says what is recorded. A [`Run`] says how often, and writes the files.
//!
//! ```
//! # let temporary = tempfile::tempdir()?;
//! # let out = temporary.path().join("heat");
//! use xca_core::prelude::*;
//! use xca_record::{CellView, Run, SetUp};
//!
//! #[derive(Substates, Clone)]
//! struct Plate {
//!     temperature: Real,
//! }
//!
//! #[elementary_process]
//! fn conduct(cell: &mut Cell<Plate>) {
//!     let mut sum = 0.0;
//!     for n in 1..cell.neighbour_count() {
//!         sum += cell.neighbour(n).temperature - cell.temperature;
//!     }
//!     cell.temperature += 0.2 * sum;
//! }
//!
//! let model = Model::builder("heat")
//!     .extents([64, 64, 1])
//!     .neighbourhood(Neighbourhood::von_neumann_2d(1))
//!     .substates::<Plate>()
//!     .process(conduct)
//!     .fill(|site| Plate { temperature: if site.cell()[0] < 32 { 100.0 } else { 0.0 } })
//!     .build()?;
//! let view = CellView::named("plate").draw(Plate::TEMPERATURE, "temperature (K)");
//! let run = Run::new(SetUp::new(model, 1000).cells(view))?.every(100);
//! run.begin(&out, &Reference)?.go(&mut ())?;
//! assert!(out.join("final.png").is_file() && out.join("frames/plate_00000500.vti").is_file());
//! # Ok::<(), Box<dyn std::error::Error + Send + Sync>>(())
//! ```
//!
//! # The parts
//! | item | purpose |
//! |---|---|
//! | [`SetUp`], [`CellView`], [`ItemView`], [`Observable`] | the content of a record |
//! | [`mod@format`] | the file formats, and how to add one |
//! | [`Run`], [`Recording`] | a run, from its start or from a checkpoint |
//! | [`Monitor`] | follows a run, and can end it |
//! | [`read_items`] | reads a table of items |
//!
//! Related crates: `xca_io` reads and writes the files, `xca_compare` compares engines, `xca_ensemble` runs a
//! model with many parameters and seeds, `xca_run` makes a program with a command line.

#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should"))]

mod failure;
pub mod format;
mod items_file;
mod monitor;
mod place;
#[doc(hidden)]
pub mod record;
#[doc(hidden)]
pub mod recording;
#[doc(hidden)]
pub mod report;
mod run;
mod set_up;
mod view;

pub use failure::Failure;
pub use items_file::{ReadItem, read_items};
pub use monitor::Monitor;
pub use record::{FolderError, Kind as FolderKind, RecordError};
pub use recording::{Outcome, Recording};
pub use report::ReadReportError;
#[doc(hidden)]
pub use run::Resumed;
pub use run::{BeginError, Run};
pub use set_up::{FinalWarning, SetUp, SetUpError};
pub use view::{CellView, ItemView, ViewError};
#[doc(no_inline)]
pub use xca_checkpoint::{CheckpointError, InputFile, Interval, Outputs};
#[doc(no_inline)]
pub use xca_machine::{NotEnoughMemory, check_memory};
#[doc(no_inline)]
pub use xca_observe::Observable;
