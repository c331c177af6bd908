//! Items: the table of the final state, the frames, and what is drawn of them.

use super::RecordError;
use super::seen::Seen;
use super::values::Plane;
use crate::output::particle_csv::{self, Column};
use crate::output::vtk::{DataArray, write_particles};
use crate::view::AnyItemView;
use std::path::Path;
use xca_core::engine::Population;
use xca_core::model::Group;
use xca_core::{Geometry, Precision, StoredType};

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
            let values = Plane::all(stored[field], &population.fields[field]).lane(0);
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

    /// Header, number of the substate and lane of each column of the table.
    fn columns(&self) -> Vec<(String, usize, usize)> {
        if !self.view.columns.is_empty() {
            return self.view.columns.clone();
        }
        let schema = self.group.schema();
        let mut columns = Vec::new();
        for field in 0..schema.fields.len() {
            let headers = schema.columns(field).into_iter().enumerate();
            columns.extend(headers.map(|(lane, header)| (header, field, lane)));
        }
        columns
    }

    /// Writes all columns of all items, by label.
    pub(super) fn write_table(&self, path: &Path) -> Result<(), RecordError> {
        let columns: Vec<(String, Vec<f64>)> = self
            .columns()
            .into_iter()
            .map(|(header, field, lane)| (header, self.plane(field).lane(lane)))
            .collect();
        let columns: Vec<(&str, Column<'_>)> =
            columns.iter().map(|(header, values)| (header.as_str(), Column::F64(values))).collect();
        Ok(particle_csv::write(path, &self.labels, &columns)?)
    }

    /// Writes a frame: the substates that have columns.
    pub(super) fn write_frame(&self, path: &Path, time: f64) -> Result<(), RecordError> {
        let schema = self.group.schema();
        let columns = self.columns();
        let fields: Vec<(&str, Plane)> = (0..schema.fields.len())
            .filter(|field| {
                schema.position != Some(*field) && columns.iter().any(|(_, shown, _)| shown == field)
            })
            .map(|field| (schema.fields[field].name, self.plane(field)))
            .collect();
        let mut arrays = vec![DataArray::new("label", self.labels.as_slice())];
        arrays.extend(fields.iter().map(|(name, plane)| DataArray::new(name, plane.as_values())));
        Ok(write_particles(path, time, self.positions().as_values(), &arrays)?)
    }

    /// Where they are, and what colours them.
    pub(super) fn seen(&self) -> Seen {
        let colour = self.view.colour(self.group.schema());
        let values = colour.map(|(field, _)| self.plane(field).magnitudes()).unwrap_or_default();
        Seen::Items { positions: self.positions().to_points(), values }
    }
}
