//! What a checkpoint says of the state.

use super::numbers::Numbers;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt;
use xca_checkpoint::Exact;
use xca_checkpoint::components::{state_name, text};
use xca_checkpoint::{Checkpoint, GroupShape, Kind};
use xca_core::{GroupSnapshot, statistics::mean};

/// One component of a substate over all cells or items.
#[derive(Debug, Serialize)]
pub(super) struct Statistics {
    /// `Struct.field`, with `.x` of a vector, `[3]` of an array, `[3].x` of an array of vectors.
    pub(super) name: String,
    #[serde(rename = "type")]
    pub(super) value_type: String,
    pub(super) count: usize,
    #[serde(flatten)]
    pub(super) values: Spread,
}

/// How values are spread.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub(super) enum Spread {
    Numbers {
        /// Of those that are not NaN.
        least: Option<Exact>,
        mean: Option<Exact>,
        largest: Option<Exact>,
        /// How many are NaN.
        not_numbers: usize,
    },
    States {
        states: Vec<StateCount>,
    },
}

/// How many cells or items are in a state.
#[derive(Debug, Serialize)]
pub(super) struct StateCount {
    pub(super) state: String,
    pub(super) count: usize,
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
    pub(super) components: Vec<Component>,
}

/// A number, or the name of a state.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub(super) enum Component {
    Number(Exact),
    State(String),
}

impl Component {
    pub(super) fn new(states: &[String], number: f64) -> Self {
        let name = state_name(states, number);
        name.map_or(Self::Number(Exact(number)), |name| Self::State(name.to_owned()))
    }
}

impl fmt::Display for Component {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{:?}", number.0),
            Self::State(name) => f.write_str(name),
        }
    }
}

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

/// All substates, component by component.
pub(super) fn statistics(checkpoint: &Checkpoint) -> Vec<Statistics> {
    let mut all = Vec::new();
    for (shape, _, fields) in groups(checkpoint) {
        let missing = match shape.kind {
            Kind::Cells { .. } => checkpoint.description.mask(),
            Kind::Items { .. } => None,
        };
        for (substate, bytes) in shape.substates.iter().zip(fields) {
            let described = Described {
                name: format!("{}.{}", shape.name, substate.name),
                value_type: &substate.value_type,
                components: &substate.components,
                states: &substate.states,
            };
            all.extend(described.statistics(Numbers::new(substate.stored, bytes), missing.as_deref()));
        }
    }
    all
}

/// What is said of a substate.
pub(super) struct Described<'a> {
    pub(super) name: String,
    pub(super) value_type: &'a str,
    /// What follows the name for each component.
    pub(super) components: &'a [String],
    pub(super) states: &'a [String],
}

impl Described<'_> {
    /// Of each component, without the cells that have no ground.
    pub(super) fn statistics(&self, numbers: Numbers<'_>, missing: Option<&[bool]>) -> Vec<Statistics> {
        let is_kept = |index: usize| missing.is_none_or(|missing| missing.get(index) != Some(&true));
        let of_component = |component: usize| {
            let values = numbers.component(component).enumerate();
            let values = values.filter(|(index, _)| is_kept(*index)).map(|(_, value)| value);
            let count = values.clone().count();
            let suffix = self.components.get(component).map_or("", String::as_str);
            Statistics {
                name: format!("{}{suffix}", self.name),
                value_type: self.value_type.to_owned(),
                count,
                values: if self.states.is_empty() { Spread::new(count, values) } else { self.counts(values) },
            }
        };
        (0..numbers.components()).map(of_component).collect()
    }

    /// How often each state occurs, and each value that is none.
    fn counts(&self, values: impl Iterator<Item = f64>) -> Spread {
        let mut counts: BTreeMap<usize, usize> = (0..self.states.len()).map(|state| (state, 0)).collect();
        for value in values {
            *counts.entry(value as usize).or_default() += 1;
        }
        let name = |state: usize| text(self.states, state as f64);
        let states = counts.into_iter().map(|(state, count)| StateCount { state: name(state), count });
        Spread::States { states: states.collect() }
    }
}

impl Spread {
    /// Of so many values.
    fn new(count: usize, values: impl Iterator<Item = f64> + Clone) -> Self {
        let numbers = || values.clone().filter(|value| !value.is_nan());
        let found = numbers().count();
        Self::Numbers {
            least: numbers().reduce(f64::min).map(Exact),
            mean: (found > 0).then(|| Exact(mean(numbers()))),
            largest: numbers().reduce(f64::max).map(Exact),
            not_numbers: count - found,
        }
    }
}

/// Without `ground` there are no values: numbers are NaN.
fn values(shape: &GroupShape, fields: &[Vec<u8>], index: usize, ground: bool) -> Vec<NamedValue> {
    let substates = shape.substates.iter().zip(fields);
    substates
        .map(|(substate, bytes)| {
            let numbers = Numbers::new(substate.stored, bytes);
            let value = if ground { numbers.value(index) } else { numbers.nothing() };
            NamedValue::new(substate.name.clone(), &substate.states, &value)
        })
        .collect()
}

impl NamedValue {
    /// A value with these components.
    pub(super) fn new(name: String, states: &[String], components: &[f64]) -> Self {
        Self { name, components: components.iter().map(|number| Component::new(states, *number)).collect() }
    }
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
    let extents = checkpoint.description.extents().unwrap_or_default();
    let linear = linear(extents, cell)?;
    let mask = checkpoint.description.mask();
    let has_ground = mask.is_none_or(|mask| mask.get(linear) != Some(&true));
    let mut places = Vec::new();
    for (shape, state, fields) in groups(checkpoint) {
        let place = |label, index| Place {
            of: shape.name.clone(),
            cell: Some(cell),
            label,
            values: values(shape, fields, index, label.is_some() || has_ground),
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
    let extents = checkpoint.description.extents().unwrap_or_default();
    let [width, height, _] = extents.map(|extent| extent.max(1));
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
            values: values(shape, fields, index, true),
        });
    }
    if places.is_empty() { Err(format!("there is no item with the label {label}")) } else { Ok(places) }
}
