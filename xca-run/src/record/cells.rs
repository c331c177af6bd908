//! Substates of cells: the frames and the picture.

use super::RecordError;
use super::values::Plane;
use crate::output::picture::{ColourMap, Picture, Scalar, SlicePicture};
use crate::output::vtk::{DataArray, Grid, write_dense};
use crate::view::AnyCellView;
use std::path::Path;
use xca_core::model::Group;
use xca_core::{Geometry, Precision};

/// The substates of cells in one state.
pub(super) struct Cells<'a> {
    view: &'a AnyCellView,
    group: &'a Group,
    geometry: &'a Geometry,
    precision: Precision,
    /// The stored bytes of each substate.
    fields: &'a [Vec<u8>],
}

impl<'a> Cells<'a> {
    pub(super) fn new(
        view: &'a AnyCellView,
        group: &'a Group,
        geometry: &'a Geometry,
        precision: Precision,
        fields: &'a [Vec<u8>],
    ) -> Self {
        Self { view, group, geometry, precision, fields }
    }

    /// Writes all substates.
    pub(super) fn write_frame(&self, path: &Path, time: f64) -> Result<(), RecordError> {
        let stored = self.group.stored(self.precision);
        let names = self.group.schema().fields.iter().map(|field| field.name);
        let fields: Vec<(&str, Plane)> = names
            .zip(stored.iter().zip(self.fields).map(|(stored, bytes)| Plane::all(*stored, bytes)))
            .collect();
        let arrays: Vec<DataArray<'_>> =
            fields.iter().map(|(name, plane)| DataArray::new(name, plane.as_values())).collect();
        let grid = Grid::cubic(self.geometry.extents(), self.geometry.side());
        Ok(write_dense(path, time, &grid, &arrays)?)
    }

    fn drawn(&self) -> (usize, String) {
        let first = || (0, self.group.schema().fields.first().map_or("", |field| field.name).to_owned());
        self.view.drawn.clone().unwrap_or_else(first)
    }

    fn layer(&self) -> usize {
        self.view.layer.unwrap_or(self.geometry.extents()[2] / 2)
    }

    /// The least and the largest finite value of the drawn layer.
    pub(super) fn range(&self) -> Option<[f64; 2]> {
        let values = self.layer_values().1;
        let finite = values.into_iter().filter(|value| value.is_finite());
        finite.fold(None, |range, value| match range {
            None => Some([value; 2]),
            Some([low, high]) => Some([value.min(low), value.max(high)]),
        })
    }

    /// Whether the drawn substate is floating, and its values in the drawn layer.
    fn layer_values(&self) -> (bool, Vec<f64>) {
        let (field, _) = self.drawn();
        let Some(bytes) = self.fields.get(field) else { return (false, Vec::new()) };
        let stored = self.group.schema().fields[field].value_type.stored(self.precision);
        let [width, height, _] = self.geometry.extents();
        let size = width * height * stored.size();
        let plane = Plane::all(stored, &bytes[self.layer() * size..(self.layer() + 1) * size]);
        (plane.is_float(), plane.magnitudes())
    }

    /// Draws a layer; `range` is the scale that an earlier picture had.
    pub(super) fn draw(
        &self,
        title: &str,
        caption: &str,
        range: Option<[f64; 2]>,
    ) -> Result<Picture, RecordError> {
        let (_, label) = self.drawn();
        let (is_float, values) = self.layer_values();
        let mut scalar = Scalar::new(&label, &values);
        scalar.map = self.view.map.unwrap_or(if is_float { ColourMap::Sequential } else { ColourMap::Paper });
        let wider = |[low, high]: [f64; 2]| {
            self.range().map_or([low, high], |[least, most]| [least.min(low), most.max(high)])
        };
        scalar.range = self.view.range.or(range.map(wider));
        let [columns, rows, layers] = self.geometry.extents();
        let mut kinds: Vec<(f64, &str)> =
            self.view.kinds.iter().map(|(value, name)| (*value, name.as_str())).collect();
        let is_plain = kinds.is_empty() && self.view.map.is_none() && self.view.range.is_none();
        // Cells that are 0 or 1 need no scale.
        if is_plain && !is_float && values.iter().all(|value| [0.0, 1.0].contains(value)) {
            kinds = vec![(0.0, "0"), (1.0, "1")];
        }
        let mut picture = SlicePicture::new(columns, rows, scalar);
        picture.categories = &kinds;
        picture.title = title;
        let of_layers = format!("{caption}, layer {} of {layers}", self.layer());
        picture.caption = if layers > 1 { &of_layers } else { caption };
        // A side that no one gave is no length.
        if self.geometry.side() != 1.0 {
            picture.cell_side = self.geometry.side();
            picture.length_unit = "m";
        }
        Ok(picture.render()?)
    }
}
