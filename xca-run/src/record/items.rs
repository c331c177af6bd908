//! Items: the table of the final state, the frames, the picture.

use super::RecordError;
use super::values::Plane;
use crate::output::particle_csv::{self, Column};
use crate::output::picture::{Domain, ParticlePicture, Picture, Scalar};
use crate::output::vtk::{DataArray, write_particles};
use crate::view::AnyItemView;
use std::path::Path;
use xca_core::engine::Population;
use xca_core::model::Group;
use xca_core::{Geometry, Precision, StoredType};

/// The share of items that may be beyond the scale: a few fast ones must not make all others look alike.
const FAST: f64 = 0.02;

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

    pub(super) fn len(&self) -> usize {
        self.which.len()
    }

    pub(super) fn plane(&self, field: usize) -> Plane {
        Plane::chosen(self.stored[field], &self.population.fields[field], &self.which)
    }

    /// The positions; of items without one, the centres of their cells.
    pub(super) fn positions(&self) -> Plane {
        if let Some(field) = self.group.schema().position {
            return self.plane(field);
        }
        let mut cells = Vec::with_capacity(self.population.labels.len());
        for (cell, count) in self.population.counts.iter().enumerate() {
            cells.extend(std::iter::repeat_n(cell, *count as usize));
        }
        let centre = |place: &usize| {
            self.geometry.indices(cells[*place]).map(|index| (index as f64 + 0.5) * self.geometry.side())
        };
        Plane::points(self.which.iter().map(centre).collect())
    }

    /// Header, number of the substate and lane of each column of the table.
    fn columns(&self) -> Vec<(String, usize, usize)> {
        if !self.view.columns.is_empty() {
            return self.view.columns.clone();
        }
        let schema = self.group.schema();
        let mut columns = Vec::new();
        for (field, definition) in schema.fields.iter().enumerate() {
            let lanes = usize::from(definition.value_type.lanes);
            columns.extend(["x", "y", "z", "w"].into_iter().take(lanes).enumerate().map(|(lane, letter)| {
                let header = match (lanes, schema.position == Some(field)) {
                    (1, _) => definition.name.to_owned(),
                    (_, true) => letter.to_owned(),
                    (_, false) => format!("{}_{letter}", definition.name),
                };
                (header, field, lane)
            }));
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

    /// The scale of their colours in this state alone.
    pub(super) fn range(&self) -> Option<[f64; 2]> {
        let values = self.plane(self.colour()?.0).magnitudes();
        Scalar::new("", &values).without_largest(FAST).range
    }

    /// Draws the items as spheres, on the scale of this state unless another is given; likewise their size.
    pub(super) fn draw(
        &self,
        title: &str,
        caption: &str,
        range: Option<[f64; 2]>,
        size: Option<[usize; 2]>,
    ) -> Result<Picture, RecordError> {
        let positions = self.positions().to_points();
        let side = self.geometry.side();
        let upper = self.geometry.extents().map(|extent| extent as f64 * side);
        let radius = self.radius();
        let colour = self.colour();
        let values = colour.as_ref().map(|(field, _)| self.plane(*field).magnitudes()).unwrap_or_default();
        let mut picture = ParticlePicture::new(&positions, radius, Domain { lower: [0.0; 3], upper });
        picture.colour = colour.as_ref().map(|(_, label)| {
            let scalar = Scalar::new(label, &values);
            if range.is_some() { Scalar { range, ..scalar } } else { scalar.without_largest(FAST) }
        });
        picture.size = size.unwrap_or(picture.size);
        picture.title = title;
        picture.caption = caption;
        Ok(picture.render()?)
    }

    /// The radius of an item.
    pub(super) fn radius(&self) -> f64 {
        self.view.radius.unwrap_or(self.geometry.side() / 4.0)
    }

    /// The substate that colours the items, and what it is called.
    pub(super) fn colour(&self) -> Option<(usize, String)> {
        let schema = self.group.schema();
        let default = || {
            let other = |field: &usize| schema.position != Some(*field);
            let vector = (0..schema.fields.len())
                .filter(other)
                .find(|&field| schema.fields[field].value_type.lanes > 1);
            let field = vector.or_else(|| (0..schema.fields.len()).find(other))?;
            let name = schema.fields[field].name;
            Some((field, if vector.is_some() { format!("length of {name}") } else { name.to_owned() }))
        };
        self.view.colour.clone().or_else(default)
    }
}
