//! Items: the table of the final state, the frames, and what is drawn of them.

use super::RecordError;
use super::frame_field::FrameField;
use super::seen::Seen;
use super::values::Plane;
use crate::components::DrawnPart;
use crate::view::{AnyItemView, Drawn, TableColumn};
use std::path::Path;
use xca_core::engine::Population;
use xca_core::model::Group;
use xca_core::{Geometry, Precision, ScalarType, StoredType};
use xca_io::particle_csv::{self, Column, ColumnType};
use xca_io::vtk::{DataArray, write_particles};

/// The items of one state that a view shows, by label.
pub(super) struct Items<'a> {
    view: &'a AnyItemView,
    group: &'a Group,
    geometry: &'a Geometry,
    stored: Vec<StoredType>,
    population: &'a Population,
    /// The places of the items in the population.
    which: Vec<usize>,
    labels: Vec<u32>,
}

impl<'a> Items<'a> {
    pub(super) fn new(
        view: &'a AnyItemView,
        group: &'a Group,
        geometry: &'a Geometry,
        precision: Precision,
        population: &'a Population,
    ) -> Self {
        let stored = group.stored(precision);
        let mut which: Vec<usize> = (0..population.labels.len()).collect();
        if let Some((field, value)) = view.only {
            let values = Plane::all(stored[field], &population.fields[field]).component(0);
            which.retain(|&place| values[place] == value);
        }
        which.sort_unstable_by_key(|&place| population.labels[place]);
        let labels = which.iter().map(|&place| population.labels[place]).collect();
        Self { view, group, geometry, stored, population, which, labels }
    }

    fn plane(&self, field: usize) -> Plane {
        Plane::chosen(self.stored[field], &self.population.fields[field], &self.which)
    }

    /// The positions; of items without one, the centres of their cells.
    fn positions(&self) -> Plane {
        if let Some(field) = self.group.schema().position {
            return self.plane(field);
        }
        let mut cells = Vec::with_capacity(self.population.labels.len());
        for (cell, count) in self.population.counts.iter().enumerate() {
            cells.extend(std::iter::repeat_n(cell, *count as usize));
        }
        let centre = |place: &usize| self.geometry.centre(self.geometry.indices(cells[*place]));
        Plane::points(self.which.iter().map(centre).collect())
    }

    /// The columns of the table.
    fn columns(&self) -> Vec<TableColumn> {
        if !self.view.columns.is_empty() {
            return self.view.columns.clone();
        }
        TableColumn::all(self.group.schema())
    }

    /// Writes all columns of all items, by label.
    pub(super) fn write_table(&self, path: &Path) -> Result<(), RecordError> {
        let fields = self.group.schema().fields;
        let columns = self.columns();
        let values: Vec<(&str, ScalarType, Vec<f64>)> = columns
            .iter()
            .map(|TableColumn { header, field, component }| {
                let scalar = fields[*field].value_type.scalar;
                (header.as_str(), scalar, self.plane(*field).component(*component))
            })
            .collect();
        let columns: Vec<(&str, Column<'_>)> = values
            .iter()
            .map(|(header, scalar, values)| (*header, Column::Typed(column_type(*scalar), values)))
            .collect();
        Ok(particle_csv::write(path, &self.labels, &columns)?)
    }

    /// Writes a frame: the substates that have columns, at their place on the map, whose corner is given.
    pub(super) fn write_frame(&self, path: &Path, time: f64, corner: [f64; 2]) -> Result<(), RecordError> {
        let schema = self.group.schema();
        let columns = self.columns();
        let fields: Vec<FrameField> = (0..schema.fields.len())
            .filter(|field| {
                schema.position != Some(*field) && columns.iter().any(|column| column.field == *field)
            })
            .map(|field| FrameField::new(&schema.fields[field], self.plane(field)))
            .collect();
        let mut arrays = vec![DataArray::new("label", self.labels.as_slice())];
        arrays.extend(fields.iter().map(FrameField::array));
        Ok(write_particles(path, time, self.positions().shifted(corner).as_values(), &arrays)?)
    }

    /// Where they are, and what colours them.
    pub(super) fn seen(&self) -> Seen {
        let schema = self.group.schema();
        let colour = self.view.colour(schema);
        let values = colour.map(|Drawn { part, .. }| {
            let drawn = DrawnPart::of(schema.fields[part.field].value_type, part.component);
            self.plane(part.field).drawn(drawn)
        });
        let values = values.unwrap_or_default();
        Seen::Items { positions: self.positions().to_points(), values }
    }
}

/// Floating numbers keep all their bits, whatever the precision of the run; bool and states have names.
pub fn column_type(scalar: ScalarType) -> ColumnType<'static> {
    match scalar {
        ScalarType::F32 | ScalarType::F64 | ScalarType::Real => ColumnType::Number,
        ScalarType::U8 => ColumnType::Whole { least: 0, largest: u8::MAX.into() },
        ScalarType::I32 => ColumnType::Whole { least: i32::MIN.into(), largest: i32::MAX.into() },
        ScalarType::U32 => ColumnType::Whole { least: 0, largest: u32::MAX.into() },
        ScalarType::Bool => ColumnType::Bool,
        ScalarType::State(names) => ColumnType::State { name: names.name, states: names.states },
    }
}
