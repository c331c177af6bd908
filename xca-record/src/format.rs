//! Formats: each writes the states of a run to files of its own, in one file of code.

mod ascii_grid;
mod extended_xyz;
mod file;
mod formats;
mod geotiff;
mod pictures;
mod recorded_state;
mod resumed_run;
mod saved_state;
mod saved_view;
mod shape;
mod space_time;
mod subject;
mod table;
mod vtk;
mod writer;

pub use file::OutputFile;
pub use formats::{FormatError, Formats};
pub use recorded_state::RecordedState;
pub use resumed_run::ResumedRun;
pub use saved_state::SavedState;
pub use saved_view::SavedView;
pub use shape::Moment;
pub(crate) use shape::{Shape, shape};
pub(crate) use space_time::is_row;
pub use subject::{Subject, View};
pub use writer::Writer;

pub use crate::record::{CellState, CellSubstate, ItemBlock, ItemState, Plane, SubstateValues};
