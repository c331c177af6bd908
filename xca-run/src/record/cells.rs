//! Substates of cells: the frames and the picture.

use super::RecordError;
use super::values::Plane;
use crate::output::picture::{BlockPicture, ColourMap, Picture, Scalar, SlicePicture};
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

    pub(super) fn drawn(&self) -> (usize, String) {
        let first = || (0, self.group.schema().fields.first().map_or("", |field| field.name).to_owned());
        self.view.drawn.clone().unwrap_or_else(first)
    }

    pub(super) fn layer(&self) -> usize {
        self.view.layer.unwrap_or(self.geometry.extents()[self.view.axis] / 2)
    }

    /// The axis that layers are counted along.
    pub(super) fn axis(&self) -> usize {
        self.view.axis
    }

    /// The cells of a layer across and down, and the number of layers.
    pub(super) fn plane(&self) -> ([usize; 2], usize) {
        let [columns, rows, layers] = self.geometry.extents();
        match self.view.axis {
            0 => ([rows, layers], columns),
            1 => ([columns, layers], rows),
            _ => ([columns, rows], layers),
        }
    }

    /// The least and the largest finite value of the drawn layer.
    pub(super) fn range(&self) -> Option<[f64; 2]> {
        ends(&self.layer_values().1)
    }

    /// The least and the largest finite value of all cells.
    pub(super) fn whole_range(&self) -> Option<[f64; 2]> {
        ends(&self.values().1)
    }

    /// Whether the drawn substate is floating, and its values in all cells.
    fn values(&self) -> (bool, Vec<f64>) {
        let (field, _) = self.drawn();
        let Some(bytes) = self.fields.get(field) else { return (false, Vec::new()) };
        let stored = self.group.schema().fields[field].value_type.stored(self.precision);
        let plane = Plane::all(stored, bytes);
        (plane.is_float(), plane.magnitudes())
    }

    /// Whether the drawn substate is floating, and its values in the drawn layer.
    pub(super) fn layer_values(&self) -> (bool, Vec<f64>) {
        let (field, _) = self.drawn();
        let Some(bytes) = self.fields.get(field) else { return (false, Vec::new()) };
        let stored = self.group.schema().fields[field].value_type.stored(self.precision);
        let [columns, rows, layers] = self.geometry.extents();
        let (layer, plane) = (self.layer(), columns * rows);
        let plane = match self.view.axis {
            0 => {
                let cells: Vec<usize> = (0..rows * layers).map(|row| row * columns + layer).collect();
                Plane::chosen(stored, bytes, &cells)
            }
            1 => {
                let cell = |i: usize| i / columns * plane + layer * columns + i % columns;
                let cells: Vec<usize> = (0..columns * layers).map(cell).collect();
                Plane::chosen(stored, bytes, &cells)
            }
            _ => {
                let size = plane * stored.size();
                Plane::all(stored, &bytes[layer * size..(layer + 1) * size])
            }
        };
        (plane.is_float(), plane.magnitudes())
    }

    /// Draws a layer; `range` is the scale that an earlier picture had. The picture has its natural size unless one is given.
    pub(super) fn draw(
        &self,
        title: &str,
        caption: &str,
        range: Option<[f64; 2]>,
        size: Option<[usize; 2]>,
    ) -> Result<Picture, RecordError> {
        let (_, label) = self.drawn();
        let (is_float, values) = self.layer_values();
        let scalar = self.scalar(&label, is_float, &values, range, self.range());
        let kinds = self.kinds(is_float, &values, range);
        let ([across, down], along) = self.plane();
        let mut picture = SlicePicture::new(across, down, scalar);
        picture.categories = &kinds;
        picture.title = title;
        picture.size = size;
        let axis = if self.view.axis == 2 { "" } else { [" along x", " along y"][self.view.axis] };
        let of_layers = format!("{caption}, layer {} of {along}{axis}", self.layer());
        picture.caption = if along > 1 { &of_layers } else { caption };
        // A side that no one gave is no length.
        if self.geometry.side() != 1.0 {
            picture.cell_side = self.geometry.side();
            picture.length_unit = "m";
        }
        Ok(picture.render()?)
    }

    /// Draws all cells, or those that are not 0 where the substate is a whole number.
    pub(super) fn draw_block(
        &self,
        title: &str,
        caption: &str,
        range: Option<[f64; 2]>,
        size: [usize; 2],
    ) -> Result<Picture, RecordError> {
        let (_, label) = self.drawn();
        let (is_float, values) = self.values();
        let scalar = self.scalar(&label, is_float, &values, range, self.whole_range());
        let kinds = self.kinds(is_float, &values, range);
        let mut picture = BlockPicture::new(self.geometry.extents(), scalar);
        picture.categories = &kinds;
        // In a single layer nothing is hidden that an empty cell would show.
        let is_flat = self.geometry.extents()[2] == 1;
        picture.empty = (!is_float && !is_flat).then_some(0.0);
        picture.title = title;
        picture.caption = caption;
        picture.size = size;
        Ok(picture.render()?)
    }

    pub(super) fn scalar<'v>(
        &self,
        label: &'v str,
        is_float: bool,
        values: &'v [f64],
        earlier: Option<[f64; 2]>,
        present: Option<[f64; 2]>,
    ) -> Scalar<'v> {
        let mut scalar = Scalar::new(label, values);
        scalar.map = self.view.map.unwrap_or(if is_float { ColourMap::Sequential } else { ColourMap::Paper });
        scalar.range = self.view.range.or(earlier.map(|earlier| wider(earlier, present)));
        scalar
    }

    /// The values that are kinds rather than magnitudes, with their names.
    pub(super) fn kinds(&self, is_float: bool, values: &[f64], range: Option<[f64; 2]>) -> Vec<(f64, &str)> {
        let view = self.view;
        let is_plain = view.kinds.is_empty() && view.map.is_none() && view.range.is_none();
        let mut all = values.iter().copied().chain(range.into_iter().flatten());
        // Cells that are 0 or 1 need no scale.
        if is_plain && !is_float && all.all(|value| [0.0, 1.0].contains(&value)) {
            return vec![(0.0, "0"), (1.0, "1")];
        }
        view.kinds.iter().map(|(value, name)| (*value, name.as_str())).collect()
    }
}

/// The least and the largest finite value.
pub(super) fn ends(values: &[f64]) -> Option<[f64; 2]> {
    let finite = values.iter().copied().filter(|value| value.is_finite());
    finite.map(|value| [value; 2]).reduce(|range, one| wider(range, Some(one)))
}

/// A range that holds two.
pub(super) fn wider([low, high]: [f64; 2], other: Option<[f64; 2]>) -> [f64; 2] {
    other.map_or([low, high], |[least, most]| [low.min(least), high.max(most)])
}
