//! The final state of a layer of cells as ESRI ASCII grids.

use super::{Moment, OutputFile, RecordedState, SavedState, SavedView, Subject, View, Writer};
use crate::failure::Failure;
use crate::record::layer;
use xca_io::ascii_grid;

/// `final_SUBSTATE.asc`, one for each component of each substate of cells. `bool` and states are numbers.
#[derive(Debug)]
pub(super) struct AsciiGrids;

impl Writer for AsciiGrids {
    fn name(&self) -> &'static str {
        "asc"
    }

    fn about(&self) -> &'static str {
        "a final layer as ESRI ASCII grids: final_SUBSTATE.asc"
    }

    fn check(&self, subject: Subject<'_>) -> Result<(), Failure> {
        layer::check(subject, self.name())
    }

    fn files(&self, subject: Subject<'_>) -> Vec<OutputFile> {
        let bands = layer::bands(subject.model()).into_iter();
        bands.map(|band| OutputFile::named(Moment::Last, &band.name, "asc")).collect()
    }

    fn finish(&mut self, state: RecordedState<'_>) -> Result<(), Failure> {
        for band in layer::bands(state.subject().model()) {
            if let Some(raster) = band.raster(state)? {
                let file = OutputFile::named(Moment::Last, &band.name, "asc");
                ascii_grid::write(&state.path(&file), &raster)?;
            }
        }
        Ok(())
    }

    fn state_files(&self, subject: Subject<'_>, view: View<'_>) -> Vec<OutputFile> {
        layer::state_files(subject, view, "asc")
    }

    fn read_state(&self, saved: SavedView<'_>) -> Option<Result<SavedState, Failure>> {
        Some(layer::read_state(saved, "asc"))
    }
}
