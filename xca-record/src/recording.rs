//! A run under way: the steps, and what is written meanwhile.

mod finite;

pub use finite::check as check_finite;

use crate::failure::Failure;
use crate::monitor::Monitor;
use crate::record::{Recorder, RunFolder};
use crate::report::{self, Earlier, Report};
use std::path::Path;
use std::time::{Duration, Instant};
use xca_checkpoint::{Checkpoints, Description, Origin};
use xca_core::{Batch, Simulation};
use xca_io::numbers::significant;
use xca_machine::peak_memory;
use xca_observe::Observable;

/// A run in progress. [`crate::Run::begin`] and [`crate::Run::resume`] start one.
#[derive(Debug)]
pub struct Recording {
    pub(crate) simulation: Simulation,
    pub(crate) recorder: Recorder,
    pub(crate) report: Report,
    pub(crate) folder: RunFolder,
    pub(crate) origin: Origin,
    pub(crate) checkpoints: Option<Checkpoints>,
    /// Whether states with NaN or infinities are written too.
    pub(crate) allow_non_finite: bool,
    /// What the run had taken before it was resumed.
    pub(crate) earlier: Earlier,
    pub(crate) begin: Instant,
    pub(crate) set_up: Duration,
    pub(crate) stepping: Duration,
}

/// The end of a run without an error.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Outcome {
    /// All steps are done.
    Done,
    /// The model stopped the run. [`Simulation::stop_reason`] gives the reason.
    Stopped,
    /// The monitor ended the run. It can resume from its last checkpoint, if it has one.
    Interrupted,
}

impl Recording {
    /// The simulation.
    pub fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    /// The simulation, to read its state or to continue without records.
    pub fn into_simulation(self) -> Simulation {
        self.simulation
    }

    /// The output directory.
    pub fn folder(&self) -> &Path {
        self.folder.top.path()
    }

    /// The warnings of the last observables.
    #[doc(hidden)]
    pub fn final_warnings(&self) -> Vec<String> {
        let (_, _, last) = self.recorder.results();
        let warnings = self.recorder.set_up().final_warnings.iter();
        let due = warnings.filter_map(|warning| {
            let found = last.iter().find(|observable| observable.name == warning.observable)?;
            let Observable { name, unit, value, .. } = found;
            let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
            (*value != 0.0).then(|| format!("{} ({name}: {}{unit})", warning.text, significant(*value, 6)))
        });
        let infinite = last.iter().filter(|it| it.value.is_infinite() && !self.allow_non_finite);
        let told = |it: &Observable| format!("the observable `{}` is infinite: too large for f64", it.name);
        due.chain(infinite.map(told)).collect()
    }

    /// Whether the run writes checkpoints.
    pub fn has_checkpoints(&self) -> bool {
        self.checkpoints.is_some()
    }

    #[doc(hidden)]
    pub fn recorder(&self) -> &Recorder {
        &self.recorder
    }

    #[doc(hidden)]
    pub fn report(&self) -> &Report {
        &self.report
    }

    /// Runs the remaining steps and writes the final state. `run.json` reports the outcome, also after an
    /// error.
    ///
    /// # Errors
    /// Returns an error if a process faults, a state is not finite, or a file cannot be written. Files
    /// written before are complete.
    pub fn go(&mut self, monitor: &mut dyn Monitor) -> Result<Outcome, Failure> {
        self.complete_report();
        self.report.write(&self.folder.report())?;
        let result = self.steps(monitor);
        if let Err(error) = &result {
            self.report.progress.outcome = "failed";
            self.report.progress.reason = Some(error.to_string());
        }
        self.complete_report();
        let written = self.report.write(&self.folder.report());
        // The first error is the one to tell.
        let outcome = result?;
        written?;
        Ok(outcome)
    }

    /// Records the initial state, does the steps, and records the final state.
    fn steps(&mut self, monitor: &mut dyn Monitor) -> Result<Outcome, Failure> {
        let wanted = self.origin.steps_wanted;
        if !self.recorder.has_begun() {
            self.recorder.begin(self.folder.clone(), &mut self.simulation)?;
        }
        monitor.begin(self.simulation.step_number());
        let mut batch = Batch::long();
        while self.is_unfinished() && !monitor.is_interrupted() {
            let done = self.simulation.step_number();
            let begin = Instant::now();
            let steps = batch.steps.min(self.next_output(done) - done);
            let result = self.simulation.run(steps);
            self.stepping += begin.elapsed();
            batch.adapt(steps, begin.elapsed());
            result?;
            let done = self.simulation.step_number();
            monitor.at(done);
            if self.origin.every.is_due(done) {
                self.check_finite()?;
                self.recorder.record(&mut self.simulation)?;
            }
            if self.is_unfinished() && self.checkpoints.as_ref().is_some_and(|all| all.is_due(done)) {
                self.keep()?;
            }
        }
        if self.simulation.stop_reason().is_none() {
            // Before the end is recorded: a run that goes on from here does not end here, also one that is
            // given more steps.
            self.keep()?;
        }
        self.simulation.finish()?;
        self.check_finite()?;
        self.recorder.finish(&mut self.simulation)?;
        let warnings = self.final_warnings();
        self.report.warnings.extend(warnings);
        let done = self.simulation.step_number();
        let reason = self.simulation.stop_reason().map(str::to_owned);
        let (word, outcome) = match reason {
            Some(_) => ("stopped", Outcome::Stopped),
            None if done < wanted => ("interrupted", Outcome::Interrupted),
            None => ("done", Outcome::Done),
        };
        let progress = &mut self.report.progress;
        (progress.outcome, progress.reason) = (word, reason);
        Ok(outcome)
    }

    fn check_finite(&self) -> Result<(), Failure> {
        if self.allow_non_finite { Ok(()) } else { finite::check(&self.simulation) }
    }

    fn is_unfinished(&self) -> bool {
        self.simulation.step_number() < self.origin.steps_wanted && self.simulation.stop_reason().is_none()
    }

    /// The step up to which nothing has to be written.
    fn next_output(&self, done: u64) -> u64 {
        let record = self.origin.every.next(done);
        let checkpoint = self.checkpoints.as_ref().map_or(u64::MAX, |all| all.next(done));
        record.min(checkpoint).min(self.origin.steps_wanted)
    }

    /// Writes a checkpoint, where the run has any, and how far it has come.
    fn keep(&mut self) -> Result<(), Failure> {
        if self.checkpoints.is_some() {
            self.check_finite()?;
        }
        let Some(checkpoints) = &mut self.checkpoints else { return Ok(()) };
        let state = self.simulation.outline();
        let description = Description::new(
            self.origin.clone(),
            self.recorder.model(),
            self.recorder.set_up().missing(),
            self.recorder.time(state.step),
            &state,
            self.recorder.recorded()?,
        );
        checkpoints.write(&description, &self.simulation)?;
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
        let figures = self.simulation.figures().into_iter();
        progress.engine_figures = figures.map(|figure| (figure.name, figure.value)).collect();
    }
}
