//! The final state of a layer of cells as GeoTIFF.

use super::{Moment, OutputFile, RecordedState, SavedState, SavedView, Subject, View, Writer};
use crate::failure::Failure;
use crate::record::layer;
use xca_io::geotiff::{self, SampleType};

/// `final_SUBSTATE.tif`, one for each component of each substate of cells. `bool` and states are numbers.
#[derive(Debug)]
pub(super) struct GeoTiffs;

impl Writer for GeoTiffs {
    fn name(&self) -> &'static str {
        "tif"
    }

    fn about(&self) -> &'static str {
        "a final layer as GeoTIFF: final_SUBSTATE.tif"
    }

    fn check(&self, subject: Subject<'_>) -> Result<(), Failure> {
        layer::check(subject, self.name())
    }

    fn files(&self, subject: Subject<'_>) -> Vec<OutputFile> {
        let bands = layer::bands(subject.model()).into_iter();
        bands.map(|band| OutputFile::named(Moment::Last, &band.name, "tif")).collect()
    }

    fn finish(&mut self, state: RecordedState<'_>) -> Result<(), Failure> {
        for band in layer::bands(state.subject().model()) {
            if let Some(raster) = band.raster(state)? {
                let file = OutputFile::named(Moment::Last, &band.name, "tif");
                let samples = if band.fits_f32(state) { SampleType::F32 } else { SampleType::F64 };
                geotiff::write(&state.path(&file), &raster, samples)?;
            }
        }
        Ok(())
    }

    fn state_files(&self, subject: Subject<'_>, view: View<'_>) -> Vec<OutputFile> {
        layer::state_files(subject, view, "tif")
    }

    fn read_state(&self, saved: SavedView<'_>) -> Option<Result<SavedState, Failure>> {
        Some(layer::read_state(saved, "tif"))
    }
}
