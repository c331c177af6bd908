//! Items: what is saved, and what is drawn of them.

use super::cells::{centre, lattice, sides};
use super::seen::Seen;
use super::substate_values::SubstateValues;
use super::values::Plane;
use crate::view::{AnyItemView, Quantity, StoredBytes, TableColumn};
use std::borrow::Cow;
use xca_checkpoint::components::{DrawnPart, Part};
use xca_core::engine::Population;
use xca_core::model::Group;
use xca_core::{Geometry, Precision, ScalarType, StoredType};
use xca_io::lattice::Lattice;
use xca_io::particle_csv::ColumnType;

/// What a view shows of the items in one state, by label.
#[derive(Debug)]
pub struct ItemState<'a> {
    view: &'a AnyItemView,
    group: &'a Group,
    geometry: &'a Geometry,
    precision: Precision,
    stored: Vec<StoredType>,
    population: Cow<'a, Population>,
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
        population: Cow<'a, Population>,
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

    /// Where the items are; those without a position are in the centres of their cells.
    ///
    /// A model takes its cells for boxes, also where they are hexagons. An item is as far from the centre of
    /// its hexagon as it is from that of its box.
    fn positions(&self) -> Plane {
        let field = self.group.schema().position;
        let position = field.map(|field| self.plane(field));
        match position {
            Some(position) if lattice(self.geometry) == Lattice::Squares => position,
            Some(position) => {
                let positions = position.to_points();
                let cells = self.cells();
                let moved = |(position, cell): (&[f64; 3], &[usize; 3])| {
                    let (from, to) = (self.geometry.centre(*cell), centre(self.geometry, *cell));
                    std::array::from_fn(|axis| position[axis] + (to[axis] - from[axis]))
                };
                Plane::points(positions.iter().zip(&cells).map(moved).collect())
            }
            None => {
                let cells = self.cells();
                Plane::points(cells.iter().map(|cell| centre(self.geometry, *cell)).collect())
            }
        }
    }

    /// The cells of the items.
    fn cells(&self) -> Vec<[usize; 3]> {
        let mut cells = Vec::with_capacity(self.population.labels.len());
        for (cell, count) in self.population.counts.iter().enumerate() {
            cells.extend(std::iter::repeat_n(cell, *count as usize));
        }
        self.which.iter().map(|place| self.geometry.indices(cells[*place])).collect()
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

    /// The substates that have columns, but for the position of items among squares.
    pub fn substates(&self) -> Vec<SubstateValues> {
        let (schema, columns) = (self.group.schema(), self.columns());
        // Among hexagons an item is drawn elsewhere than at its position, which is saved too.
        let is_apart =
            |field: usize| schema.position != Some(field) || lattice(self.geometry) != Lattice::Squares;
        let is_saved =
            |field: &usize| is_apart(*field) && columns.iter().any(|column| column.field == *field);
        let fields = (0..schema.fields.len()).filter(is_saved);
        fields.map(|field| SubstateValues::new(&schema.fields[field], self.plane(field))).collect()
    }

    /// The radius of an item in metres, if the view knows it.
    pub fn radius(&self) -> Option<f64> {
        self.view.radius
    }

    /// The space: its lower corner on the map, and its sides in metres.
    pub fn space(&self) -> [[f64; 3]; 2] {
        let [x, y] = self.corner;
        [[x, y, 0.0], sides(self.geometry)]
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

#[cfg(test)]
mod tests {
    use crate::record::{Look, Recorder, SavedRun, Seen};
    use crate::{Run, SetUp};
    use xca_core::prelude::*;
    use xca_io::vtk::read_particles;

    #[derive(Substates, Clone, Copy, Debug, PartialEq)]
    struct Ground {
        height: Real,
    }

    #[derive(Substates, Clone, Copy, Debug, PartialEq)]
    struct Grain {
        #[position]
        position: Vector3<Real>,
        row: u32,
    }

    #[elementary_process]
    fn rest(cell: &mut Cell<Ground>) {
        cell.height += 0.0;
    }

    /// One item a cell, a tenth of a side to the east of its centre.
    fn set_up() -> SetUp {
        let model = Model::builder("hexagons")
            .extents([3, 4, 1])
            .cell_side(2.0)
            .neighbourhood(Neighbourhood::hexagonal(Hexagons::CornerUp))
            .substates::<Ground>()
            .population::<Grain>(1)
            .process(rest)
            .populate(|site| {
                let position = site.centre() + Vector3::new(0.2, 0.0, 0.0);
                [Grain { position, row: site.cell()[1] as u32 }]
            })
            .build()
            .unwrap();
        SetUp::new(model, 1)
    }

    fn is_near(one: [f64; 3], other: [f64; 3]) -> bool {
        one.iter().zip(other).all(|(one, other)| (one - other).abs() < 1e-12)
    }

    /// The centres of hexagons with a corner up: rows are half the root of 3 apart, and odd ones are shifted.
    #[test]
    fn items_lie_in_their_hexagons() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("out");
        Run::new(set_up()).unwrap().begin(&out, &Reference).unwrap().go(&mut ()).unwrap();
        let found = read_particles(&out.join("frames/grain_00000001.vtp"), u64::MAX).unwrap();
        let numbers = |bytes: &[u8]| -> Vec<f64> {
            bytes.as_chunks().0.iter().map(|bytes| f64::from_ne_bytes(*bytes)).collect()
        };
        let points = numbers(&found.positions.bytes).as_chunks::<3>().0.to_vec();
        assert_eq!(points.len(), 12);
        let root = 3.0_f64.sqrt();
        for (number, point) in points.iter().enumerate() {
            let (i, j) = ((number % 3) as f64, number / 3);
            let x = 2.0 * (i + 0.5 + 0.5 * (j % 2) as f64) + 0.2;
            assert!(is_near(*point, [x, 2.0 / root + j as f64 * root, 1.0]), "{number}: {point:?}");
        }
        // The positions of the model are saved beside, and the picture is of what lies among the hexagons.
        let saved = found.arrays.iter().find(|array| array.name == "position").unwrap();
        assert!(is_near(numbers(&saved.bytes)[9..12].try_into().unwrap(), [1.2, 3.0, 1.0]));
        let recorder = Recorder::new(set_up()).unwrap();
        let look = Look { substate: Some("position.y".to_owned()), ..Look::default() };
        let drawing = recorder.drawing(&[look], None).unwrap();
        let run = SavedRun { folder: out, precision: Precision::F64, last_step: 1 };
        let [Seen::Items { positions, values }] = &drawing.seen_in(&run, 1).unwrap()[..] else {
            panic!("no items")
        };
        assert_eq!(*positions, points);
        assert!((values[3] - 3.0).abs() < 1e-12, "{values:?}");
    }
}
