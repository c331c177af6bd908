//! The whole state of a run, taken out of a simulation and put back into one.

use super::{RunError, RunOptions, Simulation};
use crate::engine::input::{wrong_fields, wrong_items};
use crate::engine::{Engine, Fault, Part, Population, SubstateId};
use crate::model::{Group, GroupKind, Model};
use xca_process::ParameterValue;
use xca_values::Field;

/// The whole state of a run between two steps. Equal snapshots are equal to the last bit.
///
/// With the model and the [`RunOptions`] it determines the rest of the run, on any engine. Variables that a
/// steering operation keeps to itself, in a `Mutex` for example, are not part of it.
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

impl Simulation {
    /// The whole state, to compare or to save.
    ///
    /// # Errors
    /// Returns an error if the engine lost its state.
    pub fn snapshot(&self) -> Result<Snapshot, RunError> {
        let execution = &self.execution;
        let of_group = |(group, definition): (usize, &Group)| match definition.kind() {
            GroupKind::Cells { .. } => {
                let fields = 0..definition.schema().fields.len();
                let read = fields.map(|field| execution.read(SubstateId { group, field }));
                read.collect::<Result<_, _>>().map(GroupSnapshot::Cells)
            }
            GroupKind::Population { .. } => {
                let left = self.left_before[group].wrapping_add(execution.left(group));
                execution.population(group).map(|items| GroupSnapshot::Population(items, left))
            }
        };
        Ok(Snapshot {
            step: self.step,
            groups: self.model.groups().iter().enumerate().map(of_group).collect::<Result<_, _>>()?,
            parameters: self.parameters.bits(),
            stop: self.stop.clone(),
            broken: self.faulty.is_some_and(|step| step > self.step),
        })
    }

    /// Starts a model on an engine in the state of a snapshot.
    ///
    /// With the same options the run continues with the same bits, on any engine.
    ///
    /// ```
    /// use xca_core::prelude::*;
    ///
    /// #[derive(Substates, Clone, Copy)]
    /// struct Counter {
    ///     count: u32,
    /// }
    ///
    /// #[elementary_process]
    /// fn count(cell: &mut Cell<Counter>) {
    ///     cell.count += 1;
    /// }
    ///
    /// let builder = Model::builder("counters").extents([4, 1, 1]);
    /// let model = builder.substates::<Counter>().process(count).build()?;
    /// let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
    /// simulation.run(3)?;
    /// let snapshot = simulation.snapshot()?;
    ///
    /// // Later, perhaps in another process: a snapshot can be saved with any format of serde.
    /// let mut resumed = Simulation::resume(&model, &Reference, RunOptions::default(), &snapshot)?;
    /// resumed.run(2)?;
    /// assert_eq!(resumed.step_number(), 5);
    /// assert_eq!(resumed.state().get(Counter::COUNT, [0, 0, 0])?, 5);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error if the engine cannot run the model, or as [`Self::restore`].
    pub fn resume(
        model: &Model,
        engine: &dyn Engine,
        options: RunOptions,
        snapshot: &Snapshot,
    ) -> Result<Self, RunError> {
        snapshot.check(model, options)?;
        let mut simulation = Self::empty(model, engine, options)?;
        simulation.restore(snapshot)?;
        Ok(simulation)
    }

    /// Replaces the state by that of a snapshot, also after a fault.
    ///
    /// # Errors
    /// Returns [`RunError::Snapshot`] if the snapshot is from another model or another precision, or was
    /// taken after a fault. The state then does not change.
    pub fn restore(&mut self, snapshot: &Snapshot) -> Result<(), RunError> {
        snapshot.check(&self.model, self.options)?;
        for (group, state) in snapshot.groups.iter().enumerate() {
            match state {
                GroupSnapshot::Cells(fields) => {
                    for (field, values) in fields.iter().enumerate() {
                        self.execution.write(SubstateId { group, field }, values)?;
                    }
                }
                GroupSnapshot::Population(population, left) => {
                    let set = self.execution.set_population(group, population);
                    set.map_err(|fault| match fault {
                        Fault::Engine(failure) => RunError::Engine(failure),
                        other => does_not_fit(&self.model, other.to_string()).into(),
                    })?;
                    self.left_before[group] = left.wrapping_sub(self.execution.left(group));
                }
            }
        }
        self.parameters.set_bits(&snapshot.parameters);
        self.step = snapshot.step;
        self.stop.clone_from(&snapshot.stop);
        self.faulty = None;
        Ok(())
    }
}

fn does_not_fit(model: &Model, reason: String) -> SnapshotError {
    SnapshotError::DoesNotFit { model: model.name().to_owned(), reason }
}

impl Snapshot {
    /// Checks that a simulation of this model can go on from here: what engines rely on.
    fn check(&self, model: &Model, options: RunOptions) -> Result<(), SnapshotError> {
        if self.broken {
            return Err(SnapshotError::Unfinished { step: self.step + 1 });
        }
        self.mismatch(model, options).map_or(Ok(()), |reason| Err(does_not_fit(model, reason)))
    }

    fn mismatch(&self, model: &Model, options: RunOptions) -> Option<String> {
        let groups = model.groups();
        if self.groups.len() != groups.len() {
            return Some(format!("it has {} structs of substates, not {}", self.groups.len(), groups.len()));
        }
        let (cells, whole) = (model.geometry().cells(), Part::whole(model.geometry()));
        let mut pairs = self.groups.iter().zip(groups);
        let of_groups = pairs.find_map(|(state, group)| {
            let name = group.schema().name;
            let reason = match (state, group.kind()) {
                (GroupSnapshot::Cells(fields), GroupKind::Cells { .. }) => {
                    wrong_fields(fields, group, options.precision, cells)
                }
                (GroupSnapshot::Population(population, _), GroupKind::Population { slots, .. }) => {
                    wrong_items(population, group, options.precision, *slots, (model, &whole))
                }
                _ => Some("the one belong to cells, the other are a population".to_owned()),
            };
            reason.map(|reason| format!("`{name}`: {reason}"))
        });
        of_groups.or_else(|| {
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
                    Some(value) => value.check(field, options.precision).err().map(|error| error.to_string()),
                }
            })
        })
    }
}
