//! Items: what is saved, and what is drawn of them.

use super::seen::Seen;
use super::substate_values::SubstateValues;
use super::values::Plane;
use crate::view::{AnyItemView, Quantity, StoredBytes, TableColumn};
use xca_checkpoint::components::{DrawnPart, Part};
use xca_core::engine::Population;
use xca_core::model::Group;
use xca_core::{Geometry, Precision, ScalarType, StoredType};
use xca_io::particle_csv::ColumnType;

/// What a view shows of the items in one state, by label.
#[derive(Debug)]
pub struct ItemState<'a> {
    view: &'a AnyItemView,
    group: &'a Group,
    geometry: &'a Geometry,
    precision: Precision,
    stored: Vec<StoredType>,
    population: &'a Population,
    /// The places of the items in the population.
    which: Vec<usize>,
    labels: Vec<u32>,
    /// The lower corner of the space on the map.
    corner: [f64; 2],
}

/// A column of a table of items.
#[derive(Debug, Clone, PartialEq)]
pub struct ItemColumn {
    /// What stands above it.
    pub header: String,
    /// What its values are.
    pub column_type: ColumnType<'static>,
    /// One for each item, by label.
    pub values: Vec<f64>,
}

impl<'a> ItemState<'a> {
    pub(super) fn new(
        view: &'a AnyItemView,
        group: &'a Group,
        geometry: &'a Geometry,
        precision: Precision,
        population: &'a Population,
        corner: [f64; 2],
    ) -> Self {
        let stored = group.stored(precision);
        let mut which: Vec<usize> = (0..population.labels.len()).collect();
        if let Some((field, value)) = view.only {
            let values = Plane::all(stored[field], &population.fields[field]).component(0);
            which.retain(|&place| values[place] == value);
        }
        which.sort_unstable_by_key(|&place| population.labels[place]);
        let labels = which.iter().map(|&place| population.labels[place]).collect();
        Self { view, group, geometry, precision, stored, population, which, labels, corner }
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

    /// The labels, in ascending order: the order of all values.
    pub fn labels(&self) -> &[u32] {
        &self.labels
    }

    /// Where the items are on the map: three numbers each, in metres.
    pub fn positions_on_map(&self) -> Plane {
        self.positions().shifted(self.corner)
    }

    /// The columns of the table: components with their headers.
    pub fn table(&self) -> Vec<ItemColumn> {
        let fields = self.group.schema().fields;
        let column = |TableColumn { header, field, component }: TableColumn| ItemColumn {
            header,
            column_type: column_type(fields[field].value_type.scalar),
            values: self.plane(field).component(component),
        };
        self.columns().into_iter().map(column).collect()
    }

    /// The substates that have columns, but for the position.
    pub fn substates(&self) -> Vec<SubstateValues> {
        let (schema, columns) = (self.group.schema(), self.columns());
        let is_saved = |field: &usize| {
            schema.position != Some(*field) && columns.iter().any(|column| column.field == *field)
        };
        let fields = (0..schema.fields.len()).filter(is_saved);
        fields.map(|field| SubstateValues::new(&schema.fields[field], self.plane(field))).collect()
    }

    /// The radius of an item in metres, if the view knows it.
    pub fn radius(&self) -> Option<f64> {
        self.view.radius
    }

    /// The space: its lower corner on the map, and its sides in metres.
    pub fn space(&self) -> [[f64; 3]; 2] {
        let side = self.geometry.side();
        let [x, y] = self.corner;
        [[x, y, 0.0], self.geometry.extents().map(|extent| extent as f64 * side)]
    }

    /// Where they are, and what colours them.
    pub(super) fn seen(&self) -> Seen {
        let schema = self.group.schema();
        let values = self.view.colour(schema).map(|drawn| match drawn.quantity {
            Quantity::Part(Part { field, component }) => {
                self.plane(field).drawn(DrawnPart::of(schema.fields[field].value_type, component))
            }
            Quantity::Computed(computation) => {
                let fields = self.stored.iter().zip(&self.population.fields);
                let fields: Vec<StoredBytes<'_>> =
                    fields.map(|(stored, bytes)| StoredBytes { stored: *stored, bytes }).collect();
                computation.values(self.precision, &fields, self.which.iter().copied())
            }
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
