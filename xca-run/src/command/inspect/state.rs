//! What a checkpoint says of the state.

use crate::checkpoint::{Checkpoint, GroupShape};
use crate::numbers::Exact;
use crate::record::Plane;
use serde::Serialize;
use xca_core::{GroupSnapshot, StoredType};

/// A substate, or one lane of a vector, over all cells or items.
#[derive(Debug, Serialize)]
pub(super) struct Statistics {
    /// `Struct.field`, with `.x` to `.w` of a vector.
    pub(super) name: String,
    #[serde(rename = "type")]
    pub(super) value_type: String,
    pub(super) count: usize,
    /// Of those that are numbers.
    pub(super) least: Option<Exact>,
    pub(super) mean: Option<Exact>,
    pub(super) largest: Option<Exact>,
    /// How many are none.
    pub(super) not_numbers: usize,
}

/// A cell or an item with its values.
#[derive(Debug, Serialize)]
pub(super) struct Place {
    /// The struct of its substates.
    pub(super) of: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) cell: Option<[usize; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) label: Option<u32>,
    pub(super) values: Vec<NamedValue>,
}

/// A substate of one cell or item.
#[derive(Debug, Serialize)]
pub(super) struct NamedValue {
    pub(super) name: String,
    pub(super) lanes: Vec<Exact>,
}

const LANES: [&str; 4] = ["x", "y", "z", "w"];

/// The groups of a checkpoint, each with the bytes of its fields.
fn groups(checkpoint: &Checkpoint) -> impl Iterator<Item = (&GroupShape, &GroupSnapshot, &[Vec<u8>])> {
    checkpoint.description.groups.iter().zip(&checkpoint.snapshot.groups).map(|(shape, state)| {
        let fields = match state {
            GroupSnapshot::Cells(fields) => fields,
            GroupSnapshot::Population(population, _) => &population.fields,
        };
        (shape, state, fields.as_slice())
    })
}

/// All substates, lane by lane.
pub(super) fn statistics(checkpoint: &Checkpoint) -> Vec<Statistics> {
    let mut all = Vec::new();
    for (shape, _, fields) in groups(checkpoint) {
        for (substate, bytes) in shape.substates.iter().zip(fields) {
            let name = format!("{}.{}", shape.name, substate.name);
            let plane = Plane::all(substate.stored, bytes);
            all.extend(Statistics::of_plane(&name, &substate.value_type, &plane));
        }
    }
    all
}

impl Statistics {
    /// Of each lane.
    pub(super) fn of_plane(name: &str, value_type: &str, plane: &Plane) -> Vec<Self> {
        let lanes = LANES.into_iter().enumerate().take(plane.lanes());
        let of_lane = |(lane, letter): (usize, &str)| {
            let name = if plane.lanes() > 1 { format!("{name}.{letter}") } else { name.to_owned() };
            Self::of(name, value_type.to_owned(), &plane.lane(lane))
        };
        lanes.map(of_lane).collect()
    }

    fn of(name: String, value_type: String, values: &[f64]) -> Self {
        let numbers = || values.iter().copied().filter(|value| !value.is_nan());
        let found = numbers().count();
        Self {
            name,
            value_type,
            count: values.len(),
            least: numbers().reduce(f64::min).map(Exact),
            mean: (found > 0).then(|| Exact(numbers().sum::<f64>() / found as f64)),
            largest: numbers().reduce(f64::max).map(Exact),
            not_numbers: values.len() - found,
        }
    }
}

/// The cells along each axis.
fn extents(checkpoint: &Checkpoint) -> [usize; 3] {
    let cells = checkpoint.description.run.model.get("cells").cloned();
    cells.and_then(|cells| serde_json::from_value(cells).ok()).unwrap_or_default()
}

fn values(shape: &GroupShape, fields: &[Vec<u8>], index: usize) -> Vec<NamedValue> {
    let value = |stored: StoredType, bytes: &[u8]| -> Vec<Exact> {
        let plane = Plane::chosen(stored, bytes, &[index]);
        (0..usize::from(stored.lanes)).flat_map(|lane| plane.lane(lane)).map(Exact).collect()
    };
    let substates = shape.substates.iter().zip(fields);
    substates
        .map(|(substate, bytes)| NamedValue {
            name: substate.name.clone(),
            lanes: value(substate.stored, bytes),
        })
        .collect()
}

/// The number of a cell, x fastest.
pub(super) fn linear(extents: [usize; 3], cell: [usize; 3]) -> Result<usize, String> {
    if cell.iter().zip(extents).any(|(index, extent)| *index >= extent) {
        return Err(format!("the space of {extents:?} cells has no cell {cell:?}"));
    }
    Ok((cell[2] * extents[1] + cell[1]) * extents[0] + cell[0])
}

/// A cell, and the items in it.
pub(super) fn cell(checkpoint: &Checkpoint, cell: [usize; 3]) -> Result<Vec<Place>, String> {
    let extents = extents(checkpoint);
    let linear = linear(extents, cell)?;
    let mut places = Vec::new();
    for (shape, state, fields) in groups(checkpoint) {
        let place = |label, index| Place {
            of: shape.name.clone(),
            cell: Some(cell),
            label,
            values: values(shape, fields, index),
        };
        match state {
            GroupSnapshot::Cells(_) => places.push(place(None, linear)),
            GroupSnapshot::Population(population, _) => {
                let before = population.counts.iter().take(linear).map(|count| *count as usize).sum();
                let count = population.counts.get(linear).map_or(0, |count| *count as usize);
                let items = population.labels.iter().enumerate().skip(before).take(count);
                places.extend(items.map(|(index, label)| place(Some(*label), index)));
            }
        }
    }
    Ok(places)
}

/// The items with a label: one at most of each population.
pub(super) fn items(checkpoint: &Checkpoint, label: u32) -> Result<Vec<Place>, String> {
    let [width, height, _] = extents(checkpoint).map(|extent| extent.max(1));
    let mut places = Vec::new();
    for (shape, state, fields) in groups(checkpoint) {
        let GroupSnapshot::Population(population, _) = state else { continue };
        let Some(index) = population.labels.iter().position(|other| *other == label) else { continue };
        let cells = population.counts.iter().enumerate();
        let mut ends = cells.scan(0, |end, (cell, count)| {
            *end += *count as usize;
            Some((cell, *end))
        });
        let cell = ends.find(|(_, end)| index < *end).map_or(0, |(cell, _)| cell);
        places.push(Place {
            of: shape.name.clone(),
            cell: Some([cell % width, cell / width % height, cell / (width * height)]),
            label: Some(label),
            values: values(shape, fields, index),
        });
    }
    if places.is_empty() { Err(format!("there is no item with the label {label}")) } else { Ok(places) }
}
