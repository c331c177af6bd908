//! Steps in a part of a space.

use super::GpuExecution;
use crate::cause::Stop;
use crate::device::Recorder;
use xca_core::engine::{
    EngineFailure, InputError, Interruption, Phase, STEPS_TO_AGREE, StepContext, Stopped, SubstateId, agree,
    check_cells_of_part,
};

impl GpuExecution {
    /// Runs whole steps. All other parts do the same. They compare their faults now and then, and at the end.
    pub(super) fn steps_of_part(
        &mut self,
        steps: u64,
        context: &StepContext<'_>,
    ) -> Result<(), Interruption> {
        let mut done = 0;
        while done < steps {
            let first = StepContext { step: context.step + done, ..*context };
            let now = STEPS_TO_AGREE.min(steps - done);
            let outcome = self.batches(now, &first, &mut 0);
            self.agree(outcome, first.step)
                .map_err(|stopped| Interruption { done: done + stopped.done, ..stopped })?;
            done += now;
        }
        Ok(())
    }

    /// Compares the faults of all parts. `first` is the first step since the last time.
    pub(super) fn agree(
        &mut self,
        outcome: Result<Option<Stop>, EngineFailure>,
        first: u64,
    ) -> Result<(), Interruption> {
        let Some(edges) = &mut self.edges else { return Ok(()) };
        let stopped = match outcome {
            Ok(None) => None,
            Ok(Some(Stop { step, process, at, fault })) => {
                Some((step.saturating_sub(first), Stopped::new(process, Phase::Rows, at, fault)))
            }
            Err(failure) => Some((0, failure.into())),
        };
        let agreed = agree(&mut *edges.border, stopped);
        if agreed.is_err() {
            edges.forget();
            // The device may have a later fault, and may be in any of the steps.
            self.stopped = true;
        }
        agreed
    }

    /// Has the other parts send what a process reads of them. Says whether the device goes on.
    pub(super) fn exchange(
        &mut self,
        recorder: &mut Recorder,
        process: usize,
    ) -> Result<bool, EngineFailure> {
        let Some(edges) = &mut self.edges else { return Ok(true) };
        let needed = edges.needed(&self.model, process);
        if needed.is_empty() {
            return Ok(true);
        }
        let recorded = std::mem::replace(recorder, self.device.recorder());
        let next = edges.exchange(&self.device, recorded, &mut self.services, &self.groups, &needed)?;
        let goes_on = next.is_some();
        if let Some(next) = next {
            *recorder = next;
        }
        Ok(goes_on)
    }

    /// Notes that all parts change a substate.
    pub(crate) fn others_change(&mut self, substate: SubstateId) {
        if let Some(edges) = &mut self.edges {
            edges.changed(substate);
        }
    }

    pub(crate) fn check_own(&self, cells: &[usize]) -> Result<(), InputError> {
        self.edges.as_ref().map_or(Ok(()), |_| check_cells_of_part(&self.model, self.space.part(), cells))
    }
}
