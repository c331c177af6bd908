//! The whole state of a run, taken out of a simulation and put back into one.

use super::{RunError, RunOptions, Simulation};
use crate::engine::{Engine, Fault, Population, SubstateId};
use crate::model::{Group, GroupKind, Model};
use crate::parameters::ParameterValue;
use crate::schema::Field;
use crate::value::ScalarType;

/// The whole state of a run between two steps: equal snapshots are equal to the last bit.
///
/// Together with the model and the [`RunOptions`] it is everything that the rest of the run depends on, whatever the engine: random
/// numbers are a function of seed and step, and schedules one of the step. What steering operations and observables keep to themselves,
/// in a `Mutex` for example, is not part of it.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Snapshot {
    /// The number of steps done.
    pub step: u64,
    /// The groups in the model's order.
    pub groups: Vec<GroupSnapshot>,
    /// The components of each parameter, as the bits of an `f64`, into which every scalar type fits exactly.
    pub parameters: Vec<Vec<u64>>,
    /// Why a steering operation has ended the run, if one has.
    pub stop: Option<String>,
    /// Whether the last step ended with a fault, so that the state is that of an unfinished step.
    pub broken: bool,
}

/// The state of one group.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum GroupSnapshot {
    /// The stored bytes of each substate of cells.
    Cells(Vec<Vec<u8>>),
    /// The items, and how many have left.
    Population(Population, u64),
}

/// A snapshot that a simulation cannot go on from.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SnapshotError {
    /// It was taken of another model, at another precision, or changed since.
    #[error("the snapshot does not fit the model `{model}`: {reason}")]
    DoesNotFit {
        /// The name of the model.
        model: String,
        /// What does not fit.
        reason: String,
    },
    /// It was taken after a fault.
    #[error("the snapshot was taken after a fault in step {step}; its state is that of an unfinished step")]
    Unfinished {
        /// The number of that step, from 1 for the first.
        step: u64,
    },
}

impl Simulation {
    /// The whole state, to compare it or to keep it.
    ///
    /// # Errors
    /// Where the engine cannot reach its state any more.
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
        let parameter =
            |field| self.parameters.value_of(field).components().iter().map(|number| number.to_bits()).collect();
        Ok(Snapshot {
            step: self.step,
            groups: self.model.groups().iter().enumerate().map(of_group).collect::<Result<_, _>>()?,
            parameters: (0..self.parameters.schema().fields.len()).map(parameter).collect(),
            stop: self.stop.clone(),
            broken: self.broken,
        })
    }

    /// Puts a model on an engine in the state of a snapshot; the initial state is not made.
    ///
    /// With the options of the simulation that the snapshot was taken of, the run goes on as that one would have, to the last bit,
    /// on any engine.
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
    /// let model = Model::builder("counters").extents([4, 1, 1]).substates::<Counter>().process(count).build()?;
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
    /// Where the engine cannot run the model, or as [`Self::restore`].
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
    /// [`RunError::Snapshot`] where it is a snapshot of another model or another precision, or was taken after a fault. The state is then
    /// what it was.
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
        for (field, bits) in snapshot.parameters.iter().enumerate() {
            let value_type = self.parameters.schema().fields[field].value_type;
            let components = bits.iter().map(|number| f64::from_bits(*number)).collect();
            if let Some(value) = ParameterValue::from_components(value_type, components) {
                self.parameters.set_value_of(field, &value);
            }
        }
        self.step = snapshot.step;
        self.stop.clone_from(&snapshot.stop);
        self.broken = false;
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
        let cells = model.geometry().cells();
        let mut pairs = self.groups.iter().zip(groups);
        let of_groups = pairs.find_map(|(state, group)| {
            let name = group.schema().name;
            let reason = match (state, group.kind()) {
                (GroupSnapshot::Cells(fields), GroupKind::Cells { .. }) => {
                    wrong_fields(fields, group, options, cells)
                }
                (GroupSnapshot::Population(population, _), GroupKind::Population { slots, .. }) => {
                    wrong_fields(&population.fields, group, options, population.labels.len())
                        .or_else(|| wrong_items(population, *slots, model))
                }
                _ => Some("the one belong to cells, the other are a population".to_owned()),
            };
            reason.map(|reason| format!("`{name}`: {reason}"))
        });
        of_groups.or_else(|| {
            let fields = model.parameters().schema().fields;
            let are_values = |(bits, field): (&Vec<u64>, &Field)| {
                let numbers = bits.iter().map(|number| f64::from_bits(*number)).collect();
                ParameterValue::from_components(field.value_type, numbers).is_some()
            };
            let same = self.parameters.len() == fields.len()
                && self.parameters.iter().zip(fields).all(are_values);
            (!same).then(|| format!("its parameters are not those of {}", model.parameters().schema().name))
        })
    }
}

/// What is wrong with the fields of a group that has so many cells or items.
fn wrong_fields(fields: &[Vec<u8>], group: &Group, options: RunOptions, count: usize) -> Option<String> {
    let wanted = group.schema().fields;
    if fields.len() != wanted.len() {
        return Some(format!("it has {} substates, not {}", fields.len(), wanted.len()));
    }
    let sizes = group.stored(options.precision).into_iter().map(|stored| stored.size() * count);
    let mut wrong = fields.iter().zip(sizes).zip(wanted).filter(|((bytes, size), _)| bytes.len() != *size);
    let wrong_size = wrong.next().map(|((bytes, size), field)| {
        let precision = options.precision;
        format!("`{}` takes {} bytes, not the {size} of a run in {precision}", field.name, bytes.len())
    });
    wrong_size.or_else(|| fields.iter().zip(wanted).find_map(|(bytes, field)| wrong_state(bytes, field)))
}

/// What is wrong with the values of a field that has only some: bool and states.
fn wrong_state(bytes: &[u8], field: &Field) -> Option<String> {
    let largest = match field.value_type.scalar {
        ScalarType::Bool => 1,
        ScalarType::State(names) => names.largest(),
        _ => return None,
    };
    let wrong = bytes.iter().find(|byte| **byte > largest)?;
    Some(format!("`{}` is {}, which {wrong} is not", field.name, field.value_type.described()))
}

/// What is wrong with the cells and labels of items.
fn wrong_items(population: &Population, slots: usize, model: &Model) -> Option<String> {
    let cells = model.geometry().cells();
    if population.counts.len() != cells {
        return Some(format!("it has {} cells, not {cells}", population.counts.len()));
    }
    let items: u64 = population.counts.iter().map(|count| u64::from(*count)).sum();
    if items != population.labels.len() as u64 {
        return Some(format!("it has {} items, but {items} in its cells", population.labels.len()));
    }
    let mut first = 0;
    for (cell, count) in population.counts.iter().enumerate() {
        let labels = &population.labels[first..first + *count as usize];
        first += labels.len();
        let place = || format!("cell {:?}", model.geometry().indices(cell));
        if labels.len() > slots {
            return Some(format!("{} has {} items in {slots} slots", place(), labels.len()));
        }
        if !labels.is_sorted() {
            return Some(format!("the items of {} are not in the order of their labels", place()));
        }
    }
    let mut labels = population.labels.clone();
    labels.sort_unstable();
    let twice = labels.windows(2).find(|pair| pair[0] == pair[1]);
    twice.map(|pair| format!("the label {} stands on two items", pair[0]))
}
