//! The description in a checkpoint: its run, its progress, and the layout of its data.

use super::origin::{Origin, Parameter};
use crate::components::state_names;
use crate::{Exact, Recorded};
use serde::{Deserialize, Serialize};
use xca_core::model::Group;
use xca_core::{ItemCounts, Model, Outline, Precision, StoredScalar, StoredType};

/// The JSON part of a checkpoint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Description {
    /// The run that it belongs to.
    pub run: Origin,
    /// The number of steps done.
    pub step: u64,
    /// Simulated time, in seconds if the model gives it.
    pub time: Exact,
    /// The reason, if a steering operation has ended the run.
    pub stop: Option<String>,
    /// The current values of the parameters.
    pub parameters: Vec<Parameter>,
    /// The layout of the data, one struct after the other.
    pub groups: Vec<GroupShape>,
    /// The cells without ground.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) missing: Vec<Run>,
    /// The files that the run has written.
    pub recorded: Recorded,
}

/// Consecutive cells by linear index.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Run {
    first: usize,
    cells: usize,
}

impl Run {
    /// The cells where a mask is true.
    pub(super) fn all(mask: &[bool]) -> Vec<Self> {
        let mut first = 0;
        let mut runs = Vec::new();
        for chunk in mask.chunk_by(|one, other| one == other) {
            if chunk[0] {
                runs.push(Self { first, cells: chunk.len() });
            }
            first += chunk.len();
        }
        runs
    }
}

/// The substates of one struct.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GroupShape {
    /// The name of the struct.
    pub name: String,
    /// The cells or items that they belong to.
    #[serde(flatten)]
    pub kind: Kind,
    /// The substates in the order of the struct.
    pub substates: Vec<SubstateShape>,
}

/// The owners of substates, and their number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "of", rename_all = "lowercase")]
pub enum Kind {
    /// Cells.
    Cells {
        /// The number of cells.
        cells: usize,
    },
    /// Items of a population.
    Items {
        /// The number of cells.
        cells: usize,
        /// The number of items.
        items: usize,
        /// The number of items that have left the space.
        left: u64,
    },
}

/// A substate.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct SubstateShape {
    pub name: String,
    /// The type in the model.
    #[serde(rename = "type")]
    pub value_type: String,
    /// The names of the values of `bool` and states, by number.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub states: Vec<String>,
    /// The suffixes of the names of its components: `.x`, `[3]`.
    pub components: Vec<String>,
    /// The stored type.
    #[serde(flatten)]
    pub stored: StoredType,
}

impl Description {
    /// The description of a run in a state. `missing` is the mask of the cells without ground. `time` is
    /// in seconds if the model gives it.
    pub fn new(
        run: Origin,
        model: &Model,
        missing: Option<&[bool]>,
        time: f64,
        state: &Outline,
        recorded: Recorded,
    ) -> Self {
        let groups = model.groups().iter().zip(&state.populations);
        let components =
            state.parameters.iter().map(|bits| bits.iter().copied().map(f64::from_bits).collect());
        Self {
            step: state.step,
            time: Exact(time),
            stop: state.stop.clone(),
            parameters: Parameter::with_values(model.parameters(), components),
            groups: groups
                .map(|(group, population)| GroupShape::new(group, *population, model, run.precision))
                .collect(),
            missing: missing.map(Run::all).unwrap_or_default(),
            run,
            recorded,
        }
    }

    /// The number of cells along each axis.
    pub fn extents(&self) -> Option<[usize; 3]> {
        serde_json::from_value(self.run.model.get("cells")?.clone()).ok()
    }

    /// The number of cells. `None` if it overflows.
    pub(super) fn cells(&self) -> Option<usize> {
        self.extents()?.into_iter().try_fold(1, usize::checked_mul)
    }

    /// Whether a run can have this description, with `data` bytes of data. The checksum does not ensure this,
    /// because it can be forged.
    pub(super) fn makes_sense(&self, data: u64) -> bool {
        let space = self.cells();
        let components = self.parameters.iter().flat_map(|parameter| &parameter.components);
        let mut substates = self.groups.iter().flat_map(|group| &group.substates);
        // Each cell has at least one byte.
        let has_mask = self.missing.is_empty() || space.is_some_and(|cells| cells as u64 <= data);
        self.step <= self.run.steps_wanted
            && self.recorded.can_be_after(self.step)
            && components.into_iter().all(|component| !component.0.is_nan())
            && substates.all(SubstateShape::makes_sense)
            && has_mask
            && self.groups.iter().all(|group| Some(group.kind.cells()) == space)
            && self.data_bytes() == u128::from(data)
    }

    /// The state without its planes.
    pub(super) fn outline(&self) -> Outline {
        let counts = |group: &GroupShape| match group.kind {
            Kind::Cells { .. } => None,
            Kind::Items { items, left, .. } => Some(ItemCounts { items, left }),
        };
        Outline {
            step: self.step,
            populations: self.groups.iter().map(counts).collect(),
            parameters: self.parameters.iter().map(Parameter::bits).collect(),
            stop: self.stop.clone(),
            broken: false,
        }
    }

    /// The mask of the cells without ground. `None` if all cells have ground.
    pub fn mask(&self) -> Option<Vec<bool>> {
        let mut mask =
            (!self.missing.is_empty()).then(|| self.cells()).flatten().map(|cells| vec![false; cells])?;
        for Run { first, cells } in &self.missing {
            mask.iter_mut().skip(*first).take(*cells).for_each(|is_missing| *is_missing = true);
        }
        Some(mask)
    }

    /// The size of the data in bytes, which no description can make overflow.
    pub(super) fn data_bytes(&self) -> u128 {
        let number = size_of::<u32>() as u128;
        let of_group = |group: &GroupShape| {
            let size: u128 = group.substates.iter().map(|substate| substate.stored.size() as u128).sum();
            match group.kind {
                Kind::Cells { cells } => cells as u128 * size,
                Kind::Items { cells, items, .. } => cells as u128 * number + items as u128 * (number + size),
            }
        };
        self.groups.iter().map(of_group).sum()
    }
}

impl Kind {
    /// The number of cells.
    fn cells(self) -> usize {
        match self {
            Self::Cells { cells } | Self::Items { cells, .. } => cells,
        }
    }
}

impl SubstateShape {
    /// Whether the description of the substate is consistent.
    fn makes_sense(&self) -> bool {
        let Self { states, components, stored, .. } = self;
        (1..=4).contains(&stored.lanes)
            && stored.length > 0
            && components.len() == stored.components()
            && (states.is_empty() || stored.scalar == StoredScalar::U8)
    }
}

impl GroupShape {
    fn new(group: &Group, population: Option<ItemCounts>, model: &Model, precision: Precision) -> Self {
        let cells = model.geometry().cells();
        let kind = match population {
            None => Kind::Cells { cells },
            Some(ItemCounts { items, left }) => Kind::Items { cells, items, left },
        };
        let substates = group.schema().fields.iter().map(|field| SubstateShape {
            name: field.name.to_owned(),
            value_type: field.value_type.to_string(),
            states: state_names(field.value_type.scalar),
            components: field.value_type.component_suffixes(),
            stored: field.value_type.stored(precision),
        });
        Self { name: group.schema().name.to_owned(), kind, substates: substates.collect() }
    }
}
