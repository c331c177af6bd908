//! A run under way: the steps, and what is written meanwhile.

mod batch;
mod checkpoints;
mod finite;
mod words;

pub(super) use batch::Batch;
pub(super) use checkpoints::Checkpoints;
#[cfg(feature = "terminal")]
pub(super) use words::engine_words;

use super::voice::Voice;
use super::{Ended, Unable};
use crate::checkpoint::{Checkpoint, Description, Origin};
use crate::interrupt::Interrupt;
use crate::machine::peak_memory;
use crate::program::Failure;
use crate::record::{Recorder, RunFolder};
use crate::report::{self, Earlier, Report};
use std::time::{Duration, Instant};
use xca_core::Simulation;

/// A run under way.
pub(super) struct UnderWay {
    pub(super) simulation: Simulation,
    pub(super) recorder: Recorder,
    pub(super) report: Report,
    pub(super) folder: RunFolder,
    pub(super) origin: Origin,
    pub(super) checkpoints: Option<Checkpoints>,
    /// Whether states with NaN or infinities are written too.
    pub(super) allow_non_finite: bool,
    pub(super) voice: Voice,
    /// What has to be known of the engine.
    pub(super) note: Option<String>,
    /// What the run had taken before it was resumed.
    pub(super) earlier: Earlier,
    pub(super) begin: Instant,
    pub(super) set_up: Duration,
    pub(super) stepping: Duration,
}

impl UnderWay {
    pub(super) fn go(mut self) -> Result<Ended, Unable> {
        let interrupt = Interrupt::install().map_err(Unable::failed)?;
        self.voice.say(&self.headline());
        if let Some(note) = &self.note {
            self.voice.say(&format!("note: {note}"));
        }
        self.complete_report();
        self.report.write(&self.folder.report()).map_err(Unable::failed)?;
        let result = self.steps(&interrupt);
        if let Err(error) = &result {
            self.report.progress.outcome = "failed";
            self.report.progress.reason = Some(error.to_string());
        }
        self.complete_report();
        let written = self.report.write(&self.folder.report());
        // The first error is the one to tell.
        match (result, written) {
            (Err(error), _) => Err(Unable::FailedLeaving(error, self.remains())),
            (Ok(_), Err(error)) => Err(Unable::FailedLeaving(error.into(), self.remains())),
            (Ok(ended), Ok(())) => match self.voice.tell(&self.report, || self.summary()) {
                Err(Unable::Failed(error)) => Err(Unable::FailedLeaving(error, self.remains())),
                told => told.map(|()| ended),
            },
        }
    }

    /// Records the initial state, does the steps, and records the final state.
    fn steps(&mut self, interrupt: &Interrupt) -> Result<Ended, Failure> {
        let wanted = self.origin.steps_wanted;
        if !self.recorder.has_begun() {
            self.check_finite()?;
            self.recorder.begin(self.folder.clone(), &mut self.simulation)?;
        }
        let line = self.voice.line(wanted);
        line.begin_at(self.simulation.step_number());
        let mut batch = Batch::default();
        while self.is_unfinished() && !interrupt.is_raised() {
            let done = self.simulation.step_number();
            let begin = Instant::now();
            let result = self.simulation.run(batch.steps.min(self.next_output(done) - done));
            self.stepping += begin.elapsed();
            batch.adapt(begin.elapsed());
            if result.is_err() {
                line.finish();
            }
            result?;
            let done = self.simulation.step_number();
            line.at(done);
            if done.is_multiple_of(self.origin.every) {
                self.check_finite().inspect_err(|_| line.finish())?;
                self.recorder.record(&mut self.simulation)?;
            }
            if self.is_unfinished() && self.checkpoints.as_ref().is_some_and(|all| all.is_due(done)) {
                self.keep().inspect_err(|_| line.finish())?;
            }
        }
        line.finish();
        if self.is_unfinished() {
            // Before the end is recorded: the run that goes on from here does not end here.
            self.keep()?;
        }
        self.simulation.finish()?;
        self.check_finite()?;
        self.recorder.finish(&mut self.simulation)?;
        let done = self.simulation.step_number();
        let progress = &mut self.report.progress;
        if let Some(reason) = self.simulation.stop_reason() {
            progress.outcome = "stopped";
            progress.reason = Some(reason.to_owned());
        } else if done < wanted {
            progress.outcome = "interrupted";
            return Ok(Ended::Interrupted);
        } else {
            progress.outcome = "done";
        }
        Ok(Ended::Done)
    }

    fn check_finite(&self) -> Result<(), Failure> {
        if self.allow_non_finite { Ok(()) } else { finite::check(&self.simulation) }
    }

    fn is_unfinished(&self) -> bool {
        self.simulation.step_number() < self.origin.steps_wanted && self.simulation.stop_reason().is_none()
    }

    /// The step up to which nothing has to be written.
    fn next_output(&self, done: u64) -> u64 {
        let record = (done / self.origin.every + 1).saturating_mul(self.origin.every);
        let checkpoint = self.checkpoints.as_ref().map_or(u64::MAX, |all| all.next(done));
        record.min(checkpoint).min(self.origin.steps_wanted)
    }

    /// Writes a checkpoint, where the run has any, and how far it has come.
    fn keep(&mut self) -> Result<(), Failure> {
        if self.checkpoints.is_some() {
            self.check_finite()?;
        }
        let Some(checkpoints) = &mut self.checkpoints else { return Ok(()) };
        let snapshot = self.simulation.snapshot()?;
        let recorded = self.recorder.recorded()?;
        let description = Description::new(self.origin.clone(), &self.recorder, &snapshot, recorded);
        checkpoints.write(&Checkpoint { description, snapshot })?;
        self.complete_report();
        self.report.write(&self.folder.report())?;
        Ok(())
    }

    fn complete_report(&mut self) {
        let (frames, first, last) = self.recorder.results();
        self.report.observables = report::of_observables(first, last);
        let steps = self.simulation.step_number();
        let (progress, taken) = (&mut self.report.progress, self.earlier.taken());
        progress.steps = steps;
        progress.time = self.recorder.time(steps);
        progress.frames = frames;
        progress.set_up_seconds = taken.set_up_seconds + self.set_up.as_secs_f64();
        progress.step_seconds = taken.step_seconds + self.stepping.as_secs_f64();
        progress.wall_seconds = taken.wall_seconds + self.begin.elapsed().as_secs_f64();
        progress.output_seconds = progress.wall_seconds - progress.set_up_seconds - progress.step_seconds;
        progress.steps_per_second = (steps > 0).then(|| steps as f64 / progress.step_seconds.max(1e-9));
        progress.state_bytes = Some(self.simulation.memory());
        progress.peak_memory_bytes = peak_memory();
    }
}
