//! Items: what is saved, and what is drawn of them.

use super::cells::{centre, lattice, sides};
use super::seen::Seen;
use super::source::Source;
use super::substate_values::SubstateValues;
use super::values::Plane;
use crate::view::{AnyItemView, Quantity, StoredBytes, TableColumn};
use std::cell::OnceCell;
use xca_checkpoint::components::{DrawnPart, Part};
use xca_core::engine::LabelledItems;
use xca_core::model::Group;
use xca_core::{EngineFailure, Geometry, Model, Precision, ScalarType, StoredType};
use xca_io::lattice::Lattice;
use xca_io::particle_csv::ColumnType;

/// What a view shows of the items in one state.
#[derive(Debug)]
pub struct ItemState<'a> {
    view: &'a AnyItemView,
    number: usize,
    group: &'a Group,
    geometry: &'a Geometry,
    precision: Precision,
    stored: Vec<StoredType>,
    source: Source<'a>,
    /// All items, if the engine gives them at once.
    whole: OnceCell<LabelledItems>,
    /// The lower corner of the space on the map.
    corner: [f64; 2],
}

/// Some of the items, by label.
#[derive(Debug)]
pub struct ItemBlock<'a> {
    of: &'a ItemState<'a>,
    items: &'a LabelledItems,
    /// The places of those that are shown.
    which: Vec<usize>,
    labels: Vec<u32>,
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
        number: usize,
        model: &'a Model,
        (precision, source): (Precision, Source<'a>),
        corner: [f64; 2],
    ) -> Self {
        let (group, geometry) = (&model.groups()[number], model.geometry());
        let (stored, whole) = (group.stored(precision), OnceCell::new());
        Self { view, number, group, geometry, precision, stored, source, whole, corner }
    }

    /// Passes on all items, by label: in blocks from an engine with parts of the space, from others at once.
    ///
    /// # Errors
    /// Where the engine has lost its state, or that of `take`.
    pub fn blocks<E: From<EngineFailure>>(
        &self,
        mut take: impl FnMut(&ItemBlock<'_>) -> Result<(), E>,
    ) -> Result<(), E> {
        if let Some(items) = self.whole.get() {
            return take(&self.block(items));
        }
        let sizes = self.group.sizes(self.precision);
        let (mut blocks, mut last) = (0, None);
        self.source.items(self.number, &sizes, |items| {
            take(&self.block(&items))?;
            blocks += 1;
            last = Some(items).filter(|_| blocks == 1);
            Ok::<(), E>(())
        })?;
        // What has come at once need not come again.
        if let Some(items) = last {
            let _ = self.whole.set(items);
        }
        Ok(())
    }

    /// How many items there are.
    ///
    /// # Errors
    /// Where the engine has lost its state.
    pub fn count(&self) -> Result<usize, EngineFailure> {
        let mut count = 0;
        self.blocks(|block| {
            count += block.labels.len();
            Ok::<(), EngineFailure>(())
        })?;
        Ok(count)
    }

    /// A block of no items, whose values have the types of all.
    pub(crate) fn with_none<T>(&self, work: impl FnOnce(&ItemBlock<'_>) -> T) -> T {
        let fields = vec![Vec::new(); self.stored.len()];
        work(&self.block(&LabelledItems { fields, ..LabelledItems::default() }))
    }

    fn block<'b>(&'b self, items: &'b LabelledItems) -> ItemBlock<'b> {
        let mut which: Vec<usize> = (0..items.labels.len()).collect();
        if let Some((field, value)) = self.view.only {
            let values = Plane::all(self.stored[field], &items.fields[field]).component(0);
            which.retain(|place| values[*place] == value);
        }
        let labels = which.iter().map(|place| items.labels[*place]).collect();
        ItemBlock { of: self, items, which, labels }
    }

    /// The headers of the columns of the table.
    pub fn headers(&self) -> Vec<String> {
        self.columns().into_iter().map(|column| column.header).collect()
    }

    /// The columns of the table.
    fn columns(&self) -> Vec<TableColumn> {
        if !self.view.columns.is_empty() {
            return self.view.columns.clone();
        }
        TableColumn::all(self.group.schema())
    }

    /// The substates that have columns, but for the position of items among squares.
    pub(crate) fn fields(&self) -> Vec<usize> {
        let (schema, columns) = (self.group.schema(), self.columns());
        // Among hexagons an item is drawn elsewhere than at its position, which is saved too.
        let is_apart =
            |field: usize| schema.position != Some(field) || lattice(self.geometry) != Lattice::Squares;
        let is_saved =
            |field: &usize| is_apart(*field) && columns.iter().any(|column| column.field == *field);
        (0..schema.fields.len()).filter(is_saved).collect()
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
    pub(super) fn seen(&self) -> Result<Seen, EngineFailure> {
        let (mut positions, mut values) = (Vec::new(), Vec::new());
        self.blocks(|block| {
            positions.extend(block.positions().to_points());
            values.extend(block.colours());
            Ok::<(), EngineFailure>(())
        })?;
        Ok(Seen::Items { positions, values })
    }
}

impl ItemBlock<'_> {
    /// The values of a substate.
    pub(crate) fn plane(&self, field: usize) -> Plane {
        Plane::chosen(self.of.stored[field], &self.items.fields[field], &self.which)
    }

    /// Where the items are; those without a position are in the centres of their cells.
    ///
    /// A model takes its cells for boxes, also where they are hexagons. An item is as far from the centre of
    /// its hexagon as it is from that of its box.
    fn positions(&self) -> Plane {
        let (group, geometry) = (self.of.group, self.of.geometry);
        let position = group.schema().position.map(|field| self.plane(field));
        match position {
            Some(position) if lattice(geometry) == Lattice::Squares => position,
            Some(position) => {
                let positions = position.to_points();
                let moved = |(position, cell): (&[f64; 3], [usize; 3])| {
                    let (from, to) = (geometry.centre(cell), centre(geometry, cell));
                    std::array::from_fn(|axis| position[axis] + (to[axis] - from[axis]))
                };
                Plane::points(positions.iter().zip(self.cells()).map(moved).collect())
            }
            None => Plane::points(self.cells().map(|cell| centre(geometry, cell)).collect()),
        }
    }

    /// The cells of the items.
    fn cells(&self) -> impl Iterator<Item = [usize; 3]> {
        self.which.iter().map(|place| self.of.geometry.indices(self.items.cells[*place] as usize))
    }

    /// The labels, in ascending order: the order of all values.
    pub fn labels(&self) -> &[u32] {
        &self.labels
    }

    /// Where the items are on the map: three numbers each, in metres.
    pub fn positions_on_map(&self) -> Plane {
        self.positions().shifted(self.of.corner)
    }

    /// The columns of the table: components with their headers.
    pub fn table(&self) -> Vec<ItemColumn> {
        let fields = self.of.group.schema().fields;
        let column = |TableColumn { header, field, component }: TableColumn| ItemColumn {
            header,
            column_type: column_type(fields[field].value_type.scalar),
            values: self.plane(field).component(component),
        };
        self.of.columns().into_iter().map(column).collect()
    }

    /// The substates that have columns, but for the position of items among squares.
    pub fn substates(&self) -> Vec<SubstateValues> {
        let fields = self.of.group.schema().fields;
        let of_field = |field: usize| SubstateValues::new(&fields[field], self.plane(field));
        self.of.fields().into_iter().map(of_field).collect()
    }

    /// What colours them; nothing where they have no colour.
    fn colours(&self) -> Vec<f64> {
        let ItemState { view, group, precision, stored, .. } = self.of;
        let schema = group.schema();
        let values = view.colour(schema).map(|drawn| match drawn.quantity {
            Quantity::Part(Part { field, component }) => {
                self.plane(field).drawn(DrawnPart::of(schema.fields[field].value_type, component))
            }
            Quantity::Computed(computation) => {
                let fields = stored.iter().zip(&self.items.fields);
                let fields: Vec<StoredBytes<'_>> =
                    fields.map(|(stored, bytes)| StoredBytes { stored: *stored, bytes }).collect();
                computation.values(*precision, &fields, self.which.iter().copied())
            }
        });
        values.unwrap_or_default()
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
