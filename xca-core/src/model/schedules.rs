//! What happens between the steps of a model: steering, stop criteria, and checks for NaN and infinities.

use super::{ModelBuilder, ModelError};
use crate::engine::SubstateId;
use crate::state::State;
use crate::steering::{Schedule, Steering, SteeringError};
use std::any::TypeId;
use xca_process::HostValue;
use xca_process::{Substate, Substates};

impl ModelBuilder {
    /// Adds a global operation. The schedule says when it runs.
    pub fn steer(
        mut self,
        schedule: Schedule,
        operation: impl Fn(&mut State<'_>) -> Result<(), SteeringError> + Send + Sync + 'static,
    ) -> Self {
        self.check_schedule(&schedule);
        self.steering.push(Steering::new(schedule, operation));
        self
    }

    fn check_schedule(&mut self, schedule: &Schedule) {
        if matches!(schedule, Schedule::Every(0) | Schedule::EveryFromStart(0)) {
            self.mistake.get_or_insert(ModelError::ZeroInterval);
        }
    }

    /// Adds a global operation that makes the initial state. [`Self::fill`] and [`Self::populate`] do so cell
    /// by cell.
    pub fn initialise(
        self,
        operation: impl Fn(&mut State<'_>) -> Result<(), SteeringError> + Send + Sync + 'static,
    ) -> Self {
        self.steer(Schedule::Start, operation)
    }

    /// Stops the run when the condition returns a reason.
    ///
    /// ```
    /// # use xca_core::prelude::*;
    /// # #[derive(Substates, Clone, Copy)]
    /// # struct Lava { speed: Real }
    /// # let builder = Model::builder("lava").extents([4, 4, 1]).substates::<Lava>();
    /// builder.stop_when(Schedule::Every(10), |state| {
    ///     let fastest = state.maximum(Lava::SPEED)?.unwrap_or(0.0);
    ///     Ok((fastest < 1e-6).then(|| "the lava stands still".to_owned()))
    /// });
    /// ```
    ///
    /// If a reduction in the condition gives NaN, the run checks all substates. A NaN or an infinity ends the
    /// run with the fault [`crate::Fault::NotFinite`], which names the cell. Substates of
    /// [`Self::allow_non_finite`] are exempt.
    pub fn stop_when(
        self,
        schedule: Schedule,
        condition: impl Fn(&mut State<'_>) -> Result<Option<String>, SteeringError> + Send + Sync + 'static,
    ) -> Self {
        self.steer(schedule, move |state| {
            if let Some(reason) = condition(state)? {
                state.stop(reason);
            }
            state.undecided = state.reduced_nan.get();
            Ok(())
        })
    }

    /// Checks at these times that all floating-point substates are finite. A NaN or an infinity ends the run
    /// with the fault [`crate::Fault::NotFinite`], which names step, substate, cell and item.
    ///
    /// The check comes before the steering of its step, so no stop criterion sees a NaN. With `Start` it
    /// follows the initial state, with `End` the last steering. It reads each substate once.
    /// [`crate::Simulation::check_finite`] checks at any other time.
    pub fn watch_finite(mut self, schedule: Schedule) -> Self {
        self.check_schedule(&schedule);
        self.watches.push(schedule);
        self
    }

    /// Exempts a substate from all checks for NaN and infinities.
    pub fn allow_non_finite<S: Substates, V: HostValue>(mut self, substate: Substate<S, V>) -> Self {
        match self.groups.iter().position(|group| group.type_id == TypeId::of::<S>()) {
            Some(group) => self.may_be_non_finite.push(SubstateId { group, field: substate.index() }),
            None => {
                self.mistake.get_or_insert(ModelError::NotAdded { substates: S::SCHEMA.name });
            }
        }
        self
    }
}
