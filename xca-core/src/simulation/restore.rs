//! Takes the whole state out of a simulation, and puts it back into one.

use super::snapshot::{GroupSnapshot, Outline, Snapshot, does_not_fit};
use super::{RunError, RunOptions, Simulation};
use crate::engine::{Engine, EngineFailure, Fault, Population, SubstateId};
use crate::model::{Group, GroupKind, Model};

impl Simulation {
    /// The whole state, to compare or to save.
    ///
    /// # Errors
    /// Returns an error if the engine lost its state.
    pub fn snapshot(&self) -> Result<Snapshot, RunError> {
        let groups = self.model.groups().iter().enumerate();
        Ok(Snapshot {
            step: self.step,
            groups: groups
                .map(|(number, group)| self.snapshot_of(number, group))
                .collect::<Result<_, _>>()?,
            parameters: self.parameters.bits(),
            stop: self.stop.clone(),
            broken: self.is_broken(),
        })
    }

    /// The state of the group with this number.
    pub(super) fn snapshot_of(
        &self,
        group: usize,
        definition: &Group,
    ) -> Result<GroupSnapshot, EngineFailure> {
        match definition.kind() {
            GroupKind::Cells { .. } => {
                let fields = 0..definition.schema().fields.len();
                let read = fields.map(|field| self.execution.read(SubstateId { group, field }));
                read.collect::<Result<_, _>>().map(GroupSnapshot::Cells)
            }
            GroupKind::Population { .. } => {
                let items = self.execution.population(group)?;
                Ok(GroupSnapshot::Population(items, self.left(group)))
            }
        }
    }

    /// The number of items of a population that left.
    pub(super) fn left(&self, group: usize) -> u64 {
        self.left_before[group].wrapping_add(self.execution.left(group))
    }

    /// Whether the last step ended with a fault.
    pub(super) fn is_broken(&self) -> bool {
        self.faulty.is_some_and(|step| step > self.step)
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
        snapshot.check(model, options.precision)?;
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
        snapshot.check(&self.model, self.options.precision)?;
        for (group, state) in snapshot.groups.iter().enumerate() {
            match state {
                GroupSnapshot::Cells(fields) => {
                    for (field, values) in fields.iter().enumerate() {
                        self.execution.write(SubstateId { group, field }, values)?;
                    }
                }
                GroupSnapshot::Population(population, left) => self.put_items(group, population, *left)?,
            }
        }
        self.take_over(&snapshot.outline());
        Ok(())
    }

    /// Replaces the items of a population, `left` of which have left before.
    pub(super) fn put_items(
        &mut self,
        group: usize,
        population: &Population,
        left: u64,
    ) -> Result<(), RunError> {
        let set = self.execution.set_population(group, population);
        set.map_err(|fault| self.unfit_items(fault))?;
        self.left_before[group] = left.wrapping_sub(self.execution.left(group));
        Ok(())
    }

    /// The error of an engine that takes over a state.
    pub(super) fn unfit(&self, failure: EngineFailure) -> RunError {
        match failure {
            EngineFailure::Input(error) => self.unfit_because(error.to_string()),
            other => other.into(),
        }
    }

    /// The error of a state that does not fit the model.
    pub(super) fn unfit_because(&self, reason: String) -> RunError {
        does_not_fit(&self.model, reason).into()
    }

    /// The error of an engine that takes over items.
    pub(super) fn unfit_items(&self, fault: Fault) -> RunError {
        match fault {
            Fault::Engine(failure) => self.unfit(failure),
            other => self.unfit_because(other.to_string()),
        }
    }

    /// Takes over what a state has besides its planes.
    pub(super) fn take_over(&mut self, outline: &Outline) {
        self.parameters.set_bits(&outline.parameters);
        self.step = outline.step;
        self.stop.clone_from(&outline.stop);
        self.faulty = None;
    }
}
