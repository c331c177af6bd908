//! Substates of cells: the frames, and what is drawn of them.

use super::RecordError;
use super::frame_field::FrameField;
use super::seen::Seen;
use super::values::Plane;
use crate::components::{DrawnPart, Part};
use crate::view::AnyCellView;
use std::path::Path;
use xca_core::model::Group;
use xca_core::{Geometry, Precision, StoredType};
use xca_io::vtk::{DataArray, Grid, write_dense};

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
        let fields = self.group.schema().fields.iter().zip(self.fields);
        let fields: Vec<FrameField> = fields
            .map(|(field, bytes)| {
                FrameField::new(field, Plane::all(field.value_type.stored(self.precision), bytes))
            })
            .collect();
        let arrays: Vec<DataArray<'_>> = fields.iter().map(FrameField::array).collect();
        let grid = Grid::cubic(self.geometry.extents(), self.geometry.side());
        Ok(write_dense(path, time, &grid, &arrays)?)
    }

    /// What is drawn.
    pub(super) fn seen(&self) -> Seen {
        let schema = self.group.schema();
        let plane = |field: usize| {
            let stored = schema.fields.get(field)?.value_type.stored(self.precision);
            Some(drawn(self.view, self.geometry, stored, self.fields.get(field)?))
        };
        let Part { field, component } = self.view.part();
        match (plane(field), schema.fields.get(field)) {
            (Some(values), Some(field)) => {
                let part = DrawnPart::of(field.value_type, component);
                seen(&values, part, self.view.relief.and_then(|(field, _)| plane(field)))
            }
            _ => Seen::Cells { is_float: false, values: Vec::new(), heights: None },
        }
    }
}

/// What is seen of a substate, over the heights of the ground.
pub(super) fn seen(values: &Plane, part: DrawnPart, heights: Option<Plane>) -> Seen {
    Seen::Cells {
        is_float: values.is_float(),
        values: values.drawn(part),
        heights: heights.map(|heights| heights.component(0)),
    }
}

/// What a view draws of the stored bytes of a substate: those of its layer, or all of them.
pub(super) fn drawn(view: &AnyCellView, geometry: &Geometry, stored: StoredType, bytes: &[u8]) -> Plane {
    let [columns, rows, layers] = geometry.extents();
    let (layer, plane) = (view.drawn_layer(geometry), columns * rows);
    match view.axis {
        _ if view.block => Plane::all(stored, bytes),
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
    }
}
