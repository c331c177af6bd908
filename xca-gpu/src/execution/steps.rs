//! Steps, and several of them in one submission.

use super::GpuExecution;
use crate::cause::Stop;
use crate::service::ADVANCE;
use std::ops::Range;
use std::time::Instant;
use xca_core::engine::{EngineFailure, Fault, Interruption, StepContext};

impl GpuExecution {
    /// Runs processes of one step.
    pub(crate) fn run_processes(
        &mut self,
        processes: Range<usize>,
        context: &StepContext<'_>,
    ) -> Result<(), Fault> {
        let outcome = self.processes(processes, context);
        if self.edges.is_some() {
            return self.agree(outcome, context.step).map_err(|interruption| interruption.fault);
        }
        outcome?.map_or(Ok(()), |stop| Err(stop.fault))
    }

    fn processes(
        &mut self,
        processes: Range<usize>,
        context: &StepContext<'_>,
    ) -> Result<Option<Stop>, EngineFailure> {
        self.prepare(context)?;
        let mut recorder = self.device.recorder();
        for index in processes {
            if self.programs[index].process.is_due(context.step) && !self.record(&mut recorder, index)? {
                break;
            }
        }
        Ok(self.finish(recorder, 1)?)
    }

    /// Runs whole steps.
    pub(crate) fn steps(&mut self, steps: u64, context: &StepContext<'_>) -> Result<(), Interruption> {
        if self.edges.is_some() {
            return self.steps_of_part(steps, context);
        }
        let mut done = 0;
        match self.batches(steps, context, &mut done) {
            Ok(None) => Ok(()),
            Ok(Some(Stop { step, fault, .. })) => {
                Err(Interruption { done: step.saturating_sub(context.step), fault })
            }
            Err(failure) => Err(Interruption { done, fault: failure.into() }),
        }
    }

    /// Runs whole steps, several in one submission. Counts those that are done.
    pub(super) fn batches(
        &mut self,
        steps: u64,
        context: &StepContext<'_>,
        done: &mut u64,
    ) -> Result<Option<Stop>, EngineFailure> {
        while *done < steps {
            let several = self.pace.steps(steps - *done);
            let started = Instant::now();
            let context = StepContext { step: context.step + *done, ..*context };
            if let Some(stop) = self.several(several, &context)? {
                return Ok(Some(stop));
            }
            self.pace.learn(several, started);
            *done += several;
        }
        Ok(None)
    }

    fn several(&mut self, steps: u64, context: &StepContext<'_>) -> Result<Option<Stop>, EngineFailure> {
        self.prepare(context)?;
        let mut recorder = self.device.recorder();
        'steps: for done in 0..steps {
            for index in 0..self.programs.len() {
                if !self.programs[index].process.is_due(context.step + done) {
                    continue;
                }
                if !self.record(&mut recorder, index)? {
                    break 'steps;
                }
                if self.pace.apart() {
                    let recorded = std::mem::replace(&mut recorder, self.device.recorder());
                    self.device.submit(recorded)?;
                    self.device.wait()?;
                }
            }
            let parts = [self.groups.journals().into(), self.groups.faults().into()];
            let journals = self.model.groups().len() + 1;
            self.services.run(&self.device, &mut recorder, ADVANCE, (&[], &parts), journals)?;
        }
        self.step = self.step.map(|step| step + steps);
        Ok(self.finish(recorder, steps)?)
    }
}
