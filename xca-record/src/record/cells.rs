//! Substates of cells: what is saved, and what is drawn of them.

use super::seen::Seen;
use super::source::Source;
use super::substate_values::CellSubstate;
use super::values::Plane;
use crate::view::{AnyCellView, Quantity, StoredBytes};
use xca_checkpoint::components::{DrawnPart, Part};
use xca_core::engine::SubstateId;
use xca_core::model::Group;
use xca_core::{EngineFailure, Field, Geometry, Model, Parity, Precision, StoredScalar, StoredType};
use xca_io::lattice::Lattice;

/// What a view shows of cells in one state: their substates.
#[derive(Debug)]
pub struct CellState<'a> {
    view: &'a AnyCellView,
    number: usize,
    group: &'a Group,
    geometry: &'a Geometry,
    precision: Precision,
    source: Source<'a>,
    /// The lower corner of the space on the map, and the cells without ground.
    ground: Ground<'a>,
}

/// Where the cells lie on the map, and which of them have no ground.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Ground<'a> {
    pub(super) corner: [f64; 2],
    pub(super) missing: Option<&'a [bool]>,
}

impl<'a> CellState<'a> {
    /// What a view shows of the group with this number.
    pub(super) fn new(
        view: &'a AnyCellView,
        number: usize,
        model: &'a Model,
        (precision, source): (Precision, Source<'a>),
        ground: Ground<'a>,
    ) -> Self {
        let (group, geometry) = (&model.groups()[number], model.geometry());
        Self { view, number, group, geometry, precision, source, ground }
    }

    /// How many cells there are along each axis.
    pub fn extents(&self) -> [usize; 3] {
        self.geometry.extents()
    }

    /// How the cells of a layer lie.
    pub fn lattice(&self) -> Lattice {
        lattice(self.geometry)
    }

    /// The side of a cell, of a hexagon the distance to its neighbours, in metres.
    pub fn side(&self) -> f64 {
        self.geometry.side()
    }

    /// The lower corner of the space on the map.
    pub fn corner(&self) -> [f64; 2] {
        self.ground.corner
    }

    /// Of each cell, whether it has no ground; nothing where all have.
    pub fn missing(&self) -> Option<&'a [bool]> {
        self.ground.missing
    }

    /// All substates.
    pub fn substates(&self) -> Vec<CellSubstate<'a>> {
        let fields = self.group.schema().fields.iter().enumerate();
        let substate = |(number, field): (usize, &'static Field)| {
            let (stored, cells) = (field.value_type.stored(self.precision), self.geometry.cells());
            let of = (self.source, self.substate(number));
            CellSubstate::new(field, of, stored, cells, self.ground.missing)
        };
        fields.map(substate).collect()
    }

    fn substate(&self, field: usize) -> SubstateId {
        SubstateId { group: self.number, field }
    }

    /// What is drawn.
    pub(super) fn seen(&self) -> Result<Seen, EngineFailure> {
        let schema = self.group.schema();
        let stored = self.group.stored(self.precision);
        // Where all are drawn, it is in their order.
        let is_whole = self.view.block || self.geometry.extents()[self.view.axis] == 1;
        let cells: Option<Vec<usize>> = (!is_whole).then(|| drawn_cells(self.view, self.geometry).collect());
        let bytes = |field: usize| match &cells {
            None => self.source.values(self.substate(field)),
            Some(cells) => self.source.values_in(self.substate(field), stored[field].size(), cells),
        };
        let plane = |field: usize| Ok::<Plane, EngineFailure>(Plane::all(stored[field], &bytes(field)?));
        let drawn = match self.view.quantity() {
            Quantity::Part(Part { field, component }) => {
                let part = DrawnPart::of(schema.fields[field].value_type, component);
                DrawnValues::of_part(&plane(field)?, part)
            }
            Quantity::Computed(computation) => {
                let all = (0..stored.len()).map(bytes).collect::<Result<Vec<_>, _>>()?;
                let fields = stored.iter().zip(&all);
                let fields: Vec<StoredBytes<'_>> =
                    fields.map(|(stored, bytes)| StoredBytes { stored: *stored, bytes }).collect();
                let count = cells.as_ref().map_or(self.geometry.cells(), Vec::len);
                DrawnValues::of_numbers(computation.values(self.precision, &fields, 0..count))
            }
        };
        let heights = self.view.relief.map(|(field, _)| plane(field)).transpose()?;
        let hidden = self.ground.missing.map(|missing| drawn_mask(self.view, self.geometry, missing));
        Ok(seen(drawn, heights, hidden))
    }
}

/// How the cells of a layer lie.
pub(crate) fn lattice(geometry: &Geometry) -> Lattice {
    match geometry.neighbourhood().parity() {
        Parity::None => Lattice::Squares,
        Parity::Row => Lattice::HexagonRows,
        Parity::Column => Lattice::HexagonColumns,
    }
}

/// The sides of the space in sides of a cell. Of hexagons it is the box around them.
pub(super) fn sides_in_cells(geometry: &Geometry) -> [f64; 3] {
    let [columns, rows, layers] = geometry.extents();
    let [x, y] = lattice(geometry).size([columns, rows]);
    [x, y, layers as f64]
}

/// The same in the unit of the side of a cell.
pub(super) fn sides(geometry: &Geometry) -> [f64; 3] {
    sides_in_cells(geometry).map(|cells| cells * geometry.side())
}

/// The centre of a cell, where the lattice has it.
pub(super) fn centre(geometry: &Geometry, cell: [usize; 3]) -> [f64; 3] {
    let [x, y] = lattice(geometry).centre([cell[0], cell[1]]);
    [x, y, cell[2] as f64 + 0.5].map(|cells| cells * geometry.side())
}

/// The numbers that are drawn, one for each cell that is.
#[derive(Debug, Default)]
pub(super) struct DrawnValues {
    is_float: bool,
    values: Vec<f64>,
}

impl DrawnValues {
    pub(super) fn of_part(plane: &Plane, part: DrawnPart) -> Self {
        Self { is_float: plane.is_float(), values: plane.drawn(part) }
    }

    pub(super) fn of_numbers(values: Vec<f64>) -> Self {
        Self { is_float: true, values }
    }
}

/// What is seen of them, over the heights of the ground.
pub(super) fn seen(drawn: DrawnValues, heights: Option<Plane>, hidden: Option<Vec<bool>>) -> Seen {
    let masked = |mut values: Vec<f64>| {
        let masked = values.iter_mut().zip(hidden.as_deref().unwrap_or_default());
        masked.filter(|(_, is_hidden)| **is_hidden).for_each(|(value, _)| *value = f64::NAN);
        values
    };
    Seen::Cells {
        is_float: drawn.is_float,
        values: masked(drawn.values),
        heights: heights.map(|heights| masked(heights.component(0))),
        hidden,
    }
}

/// What a view draws of a mask of all cells.
pub(super) fn drawn_mask(view: &AnyCellView, geometry: &Geometry, mask: &[bool]) -> Vec<bool> {
    const BYTES: StoredType = StoredType { scalar: StoredScalar::U8, lanes: 1, length: 1 };
    let bytes: Vec<u8> = mask.iter().map(|is_set| u8::from(*is_set)).collect();
    drawn(view, geometry, BYTES, &bytes).component(0).into_iter().map(|byte| byte != 0.0).collect()
}

/// The cells that a view draws: those of its layer, or all of them.
pub(super) fn drawn_cells(view: &AnyCellView, geometry: &Geometry) -> Box<dyn Iterator<Item = usize>> {
    let [columns, rows, layers] = geometry.extents();
    let (layer, plane) = (view.drawn_layer(geometry), columns * rows);
    match view.axis {
        _ if view.block => Box::new(0..plane * layers),
        0 => Box::new((0..rows * layers).map(move |row| row * columns + layer)),
        1 => {
            Box::new((0..columns * layers).map(move |i| i / columns * plane + layer * columns + i % columns))
        }
        _ => Box::new(layer * plane..(layer + 1) * plane),
    }
}

/// What a view draws of the stored bytes of a substate.
pub(super) fn drawn(view: &AnyCellView, geometry: &Geometry, stored: StoredType, bytes: &[u8]) -> Plane {
    let [columns, rows, _] = geometry.extents();
    // Cells that follow each other are taken at once.
    if view.block {
        Plane::all(stored, bytes)
    } else if view.axis == 2 {
        let (layer, size) = (view.drawn_layer(geometry), columns * rows * stored.size());
        Plane::all(stored, &bytes[layer * size..(layer + 1) * size])
    } else {
        Plane::chosen(stored, bytes, &drawn_cells(view, geometry).collect::<Vec<_>>())
    }
}
