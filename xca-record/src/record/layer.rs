//! The substates of a layer of cells, component by component, as a geographic information system takes them.

use super::typed::{NoValue, typed};
use crate::failure::Failure;
use crate::format::{Moment, OutputFile, RecordedState, SavedState, SavedView, Subject, View};
use std::path::PathBuf;
use xca_core::engine::SubstateId;
use xca_core::model::GroupKind;
use xca_core::{EngineFailure, Model, StoredScalar};
use xca_io::map::{Map, PlacementDifference};
use xca_io::raster::Raster;

/// One component of a substate of cells.
pub(crate) struct Band {
    /// `altitude`, `outflow_3`; with the struct before it where several have such a substate.
    pub(crate) name: String,
    substate: SubstateId,
    component: usize,
}

/// A model that has no single layer.
#[derive(Debug, thiserror::Error)]
#[error("the format {format} is for models of one layer, and `{model}` has {layers}")]
struct Layers {
    format: &'static str,
    model: String,
    layers: usize,
}

/// A layer that the run cannot have left.
#[derive(Debug, thiserror::Error)]
#[error("{} is not of this run: {difference}", path.display())]
struct OtherPlace {
    path: PathBuf,
    difference: PlacementDifference,
}

/// A number that no substate of the run was.
#[derive(Debug, thiserror::Error)]
#[error(
    "{}: {number} is no value of `{substate}` (column {} from the west, row {} from the north)",
    path.display(), place[0], place[1]
)]
struct OtherValue {
    path: PathBuf,
    substate: &'static str,
    number: f64,
    place: [usize; 2],
}

/// Refuses a model of several layers.
pub(crate) fn check(subject: Subject<'_>, format: &'static str) -> Result<(), Failure> {
    let model = subject.model();
    let layers = model.geometry().extents()[2];
    let error = || Layers { format, model: model.name().to_owned(), layers };
    if layers > 1 { Err(error().into()) } else { Ok(()) }
}

/// The bands of a model; none of one with several layers.
pub(crate) fn bands(model: &Model) -> Vec<Band> {
    let of_cells = |kind: &GroupKind| matches!(kind, GroupKind::Cells { .. });
    let groups = || model.groups().iter().enumerate().filter(|(_, group)| of_cells(group.kind()));
    let fields = || groups().flat_map(|(_, group)| group.schema().fields);
    let mut all = Vec::new();
    if model.geometry().extents()[2] > 1 {
        return all;
    }
    for (group, of) in groups() {
        for (index, field) in of.schema().fields.iter().enumerate() {
            let is_single = fields().filter(|other| other.name == field.name).count() == 1;
            let of = if is_single { String::new() } else { format!("{}_", of.schema().name.to_lowercase()) };
            for (component, name) in field.value_type.component_names().into_iter().enumerate() {
                let gap = if name.is_empty() { "" } else { "_" };
                let name = format!("{of}{}{gap}{name}", field.name);
                all.push(Band { name, substate: SubstateId { group, field: index }, component });
            }
        }
    }
    all
}

impl Band {
    /// Its values at their place on the map; NaN where there is no ground.
    pub(crate) fn raster(&self, state: RecordedState<'_>) -> Result<Option<Raster>, EngineFailure> {
        let (place, map) = (state.subject().placement(), state.subject().map);
        let coordinate_system = map.and_then(Map::coordinate_system).cloned();
        let raster = Raster::new(place.extents, place.side, self.values(state)?);
        let placed =
            |raster: Raster| raster.with_corner(place.corner).with_coordinate_system(coordinate_system);
        Ok(raster.map(placed))
    }

    /// Whether `f32` holds all its values.
    pub(crate) fn fits_f32(&self, state: RecordedState<'_>) -> bool {
        let stored = state.subject().model().stored(self.substate, state.precision()).scalar;
        matches!(stored, StoredScalar::F32 | StoredScalar::U8)
    }

    /// The lowest row first; NaN where there is no ground.
    fn values(&self, state: RecordedState<'_>) -> Result<Vec<f64>, EngineFailure> {
        let mut values = state.values(self.substate)?.component(self.component);
        if state.subject().model().stored(self.substate, state.precision()).scalar == StoredScalar::F32 {
            values.iter_mut().for_each(|value| *value = with_digits_of_f32(*value));
        }
        mask(&mut values, state.subject().missing());
        Ok(values)
    }
}

/// The files of the final state of a view, one for each band.
pub(crate) fn state_files(subject: Subject<'_>, view: View<'_>, extension: &'static str) -> Vec<OutputFile> {
    let mut bands = bands(subject.model());
    bands.retain(|band| band.substate.group == view.shown.group);
    bands.into_iter().map(|band| OutputFile::named(Moment::Last, &band.name, extension)).collect()
}

/// The final state of a view, from the files of all its bands.
pub(crate) fn read_state(saved: SavedView<'_>, extension: &'static str) -> Result<SavedState, Failure> {
    let (subject, group) = (saved.subject(), saved.view().shown.group);
    let model = subject.model();
    let mut paths = state_files(subject, saved.view(), extension).into_iter().map(|file| saved.path(&file));
    let mut arrays = Vec::new();
    for field in model.groups()[group].schema().fields {
        let paths: Vec<PathBuf> = paths.by_ref().take(field.value_type.components()).collect();
        let mut components = Vec::new();
        for path in &paths {
            let raster = Raster::read(path)?;
            if let Some(difference) = raster.placement().difference(&subject.placement()) {
                return Err(OtherPlace { path: path.clone(), difference }.into());
            }
            components.push(raster);
        }
        let stored = field.value_type.stored(saved.precision()).scalar;
        let is_float = matches!(stored, StoredScalar::F32 | StoredScalar::F64);
        let is_missing = |cell: usize| subject.missing().is_some_and(|missing| missing[cell]);
        let cells = components.first().map_or(0, |raster| raster.values().len());
        let mut numbers = Vec::with_capacity(cells * components.len());
        for cell in 0..cells {
            // Where there is no ground, whole numbers are 0.
            let number = |raster: &Raster| match raster.values()[cell] {
                _ if is_missing(cell) && !is_float => 0.0,
                number => number,
            };
            numbers.extend(components.iter().map(number));
        }
        let array = typed(field, saved.precision(), &numbers);
        arrays.push(array.map_err(|NoValue { index, number }| OtherValue {
            path: paths.first().cloned().unwrap_or_default(),
            substate: field.name,
            number,
            place: subject.placement().place(index),
        })?);
    }
    Ok(SavedState::of_cells(saved.time(), model.geometry().extents(), arrays))
}

/// Takes the values from the cells without ground.
fn mask(values: &mut [f64], missing: Option<&[bool]>) {
    let masked = values.iter_mut().zip(missing.unwrap_or_default());
    masked.filter(|(_, is_missing)| **is_missing).for_each(|(value, _)| *value = f64::NAN);
}

/// The `f64` that has the digits of an `f32`: 0.1 of 0.1f32, which is 0.10000000149011612.
fn with_digits_of_f32(value: f64) -> f64 {
    format!("{:e}", value as f32).parse().unwrap_or(value)
}
