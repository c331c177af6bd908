//! The whole state of a run, and whether it fits a model.

use crate::engine::input::{wrong_fields, wrong_items};
use crate::engine::{Part, Population};
use crate::model::{Group, GroupKind, Model};
use xca_process::ParameterValue;
use xca_values::{Field, Precision};

/// The whole state of a run between two steps. Equal snapshots are equal to the last bit.
///
/// ```
/// use xca_core::prelude::*;
///
/// #[derive(Substates, Clone)]
/// struct Site {
///     age: u32,
/// }
///
/// #[elementary_process]
/// fn grow(cell: &mut Cell<Site>) {
///     cell.age += 1;
/// }
///
/// let builder = Model::builder("site").extents([8, 8, 1]).substates::<Site>();
/// let model = builder.process(grow).build()?;
/// let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
/// simulation.run(3)?;
/// let third = simulation.snapshot()?;
/// simulation.run(2)?;
/// simulation.restore(&third)?;
/// assert_eq!(simulation.snapshot()?, third);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// With the model and the [`crate::RunOptions`] it determines the rest of the run, on any engine. Variables
/// that a steering operation keeps to itself, in a `Mutex` for example, are not part of it.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Snapshot {
    /// The number of steps done.
    pub step: u64,
    /// The groups in the model's order.
    pub groups: Vec<GroupSnapshot>,
    /// The components of each parameter, as the bits of an `f64`, which holds every scalar type exactly.
    pub parameters: Vec<Vec<u64>>,
    /// The reason of the steering operation that ended the run, if one did.
    pub stop: Option<String>,
    /// Whether the last step ended with a fault. The state is then that of an unfinished step.
    pub broken: bool,
}

/// The state of one group.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum GroupSnapshot {
    /// The stored bytes of each substate of cells.
    Cells(Vec<Vec<u8>>),
    /// The items, and the number of items that left.
    Population(Population, u64),
}

/// The state of a run between two steps without its planes. [`crate::Simulation::read_blocks`] gives these.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Outline {
    /// The number of steps done.
    pub step: u64,
    /// The numbers of items of each group in the model's order. `None` for a group of cells.
    pub populations: Vec<Option<ItemCounts>>,
    /// As in [`Snapshot::parameters`].
    pub parameters: Vec<Vec<u64>>,
    /// As in [`Snapshot::stop`].
    pub stop: Option<String>,
    /// As in [`Snapshot::broken`].
    pub broken: bool,
}

/// How many items a population has and had.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ItemCounts {
    /// The items in the space.
    pub items: usize,
    /// The items that left it.
    pub left: u64,
}

/// A snapshot from which a simulation cannot continue.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SnapshotError {
    /// The snapshot is from another model or another precision, or was modified.
    #[error("the snapshot does not fit the model `{model}`: {reason}")]
    DoesNotFit {
        /// The name of the model.
        model: String,
        /// The difference.
        reason: String,
    },
    /// The snapshot was taken after a fault.
    #[error("the snapshot was taken after a fault in step {step}; its state is that of an unfinished step")]
    Unfinished {
        /// The number of that step, from 1 for the first.
        step: u64,
    },
}

pub(super) fn does_not_fit(model: &Model, reason: String) -> SnapshotError {
    SnapshotError::DoesNotFit { model: model.name().to_owned(), reason }
}

impl Snapshot {
    /// The state without its planes.
    pub fn outline(&self) -> Outline {
        let of_group = |group: &GroupSnapshot| match group {
            GroupSnapshot::Cells(_) => None,
            GroupSnapshot::Population(population, left) => {
                Some(ItemCounts { items: population.labels.len(), left: *left })
            }
        };
        Outline {
            step: self.step,
            populations: self.groups.iter().map(of_group).collect(),
            parameters: self.parameters.clone(),
            stop: self.stop.clone(),
            broken: self.broken,
        }
    }

    /// Checks that a simulation of this model can go on from here: what engines rely on.
    pub(super) fn check(&self, model: &Model, precision: Precision) -> Result<(), SnapshotError> {
        self.outline().check(model, precision)?;
        let (cells, whole) = (model.geometry().cells(), Part::whole(model.geometry()));
        for (state, group) in self.groups.iter().zip(model.groups()) {
            let reason = match (state, group.kind()) {
                (GroupSnapshot::Population(population, _), GroupKind::Population { slots, .. }) => {
                    wrong_items(population, group, precision, *slots, (model, &whole))
                }
                (GroupSnapshot::Cells(fields), _) => wrong_fields(fields, group, precision, cells),
                (GroupSnapshot::Population(..), _) => None,
            };
            of_group(group, reason).map_or(Ok(()), |reason| Err(does_not_fit(model, reason)))?;
        }
        Ok(())
    }
}

impl Outline {
    /// Checks that a simulation of this model can go on from here, but for the planes.
    pub(super) fn check(&self, model: &Model, precision: Precision) -> Result<(), SnapshotError> {
        if self.broken {
            return Err(SnapshotError::Unfinished { step: self.step + 1 });
        }
        let reason = self.other_groups(model).or_else(|| self.other_parameters(model, precision));
        reason.map_or(Ok(()), |reason| Err(does_not_fit(model, reason)))
    }

    fn other_groups(&self, model: &Model) -> Option<String> {
        let (found, groups) = (&self.populations, model.groups());
        if found.len() != groups.len() {
            return Some(format!("it has {} structs of substates, not {}", found.len(), groups.len()));
        }
        found.iter().zip(groups).find_map(|(population, group)| {
            let is_population = matches!(group.kind(), GroupKind::Population { .. });
            let reason = "the one belong to cells, the other are a population".to_owned();
            of_group(group, (population.is_some() != is_population).then_some(reason))
        })
    }

    fn other_parameters(&self, model: &Model, precision: Precision) -> Option<String> {
        let fields: Vec<&'static Field> = model.parameters().fields().collect();
        let names: Vec<&str> = model.parameters().schemas().map(|schema| schema.name).collect();
        let others = || Some(format!("its parameters are not those of {}", names.join(" and ")));
        if self.parameters.len() != fields.len() {
            return others();
        }
        self.parameters.iter().zip(fields).find_map(|(bits, field)| {
            let numbers = bits.iter().map(|number| f64::from_bits(*number)).collect();
            match ParameterValue::from_components(field.value_type, numbers) {
                None => others(),
                Some(value) => value.check(field, precision).err().map(|error| error.to_string()),
            }
        })
    }
}

/// A reason with the name of the group.
fn of_group(group: &Group, reason: Option<String>) -> Option<String> {
    reason.map(|reason| format!("`{}`: {reason}", group.schema().name))
}
