//! The subcommand `run`.

mod batch;
mod words;

use super::parse::Invocation;
use super::{Ended, Unable};
use crate::interrupt::Interrupt;
use crate::machine::{check_memory, peak_memory};
use crate::program::{Failure, Given};
use crate::progress;
use crate::record::{Recorder, RunFolder};
use crate::report::{self, Report};
use crate::set_up::SetUp;
use crate::terminal;
use batch::Batch;
use std::path::PathBuf;
use std::time::{Duration, Instant};
use xca_core::{Engine, RunError, RunOptions, Simulation};

/// How many times in a run something is written, unless the command line says how often.
const OUTPUTS: u64 = 20;

/// Runs the model of a program.
pub(super) fn run(invocation: Invocation<'_>) -> Result<Ended, Unable> {
    let begin = Instant::now();
    let engine = invocation.engine.engine.with_threads(invocation.engine.threads).map_err(Unable::refused)?;
    let given = invocation.model.given(invocation.run.steps);
    let set_up = set_up(&invocation, &given, &*engine)?;
    let steps = given.steps.unwrap_or(set_up.steps);
    let recorder = Recorder::new(set_up).map_err(Unable::refused)?;
    let path =
        invocation.run.out.clone().unwrap_or_else(|| PathBuf::from("out").join(invocation.definition.name));
    let folder = RunFolder::prepare(&path, &recorder.files(), &recorder.set_up().inputs);
    let folder = folder.map_err(Unable::refused)?;
    let options = RunOptions { precision: given.precision, seed: given.seed };
    let simulation = Simulation::new(recorder.model(), &*engine, options).map_err(not_started)?;
    let every = invocation.run.every.unwrap_or(steps.div_ceil(OUTPUTS).max(1));
    let report = first_report(&invocation, &recorder, &*engine, steps, every);
    let run = Run {
        simulation,
        recorder,
        report,
        folder,
        every,
        quiet: invocation.run.quiet,
        set_up: begin.elapsed(),
        stepping: Duration::ZERO,
        begin,
    };
    run.go()
}

/// The model with its parameters set.
fn set_up(invocation: &Invocation<'_>, given: &Given, engine: &dyn Engine) -> Result<SetUp, Unable> {
    let mut set_up = invocation.set_up(given.clone())?;
    if let (Some(parameter), []) = (given.parameters.first(), set_up.model.parameters().schema().fields) {
        return Err(Unable::refused(format!("this model has no parameters; `{parameter}` cannot be set")));
    }
    for parameter in &given.parameters {
        set_up.model.set_parameter(&parameter.name, &parameter.value).map_err(Unable::refused)?;
    }
    let memory = engine.least_memory(&set_up.model, given.precision);
    check_memory(memory, &format!("this model on the {} engine", engine.name())).map_err(Unable::refused)?;
    Ok(set_up)
}

/// An initial state that cannot be made is a mistake in what was given.
fn not_started(error: RunError) -> Unable {
    match error {
        RunError::Steering { step: 0, source } => Unable::Refused(source),
        other => Unable::refused(other),
    }
}

fn first_report(
    invocation: &Invocation<'_>,
    recorder: &Recorder,
    engine: &dyn Engine,
    steps: u64,
    every: u64,
) -> Report {
    let set_up = recorder.set_up();
    let given = invocation.model.given(None);
    Report {
        xca: env!("CARGO_PKG_VERSION"),
        program: invocation.definition.name,
        version: invocation.definition.version,
        command_line: invocation.command_line.clone(),
        options: invocation.options.clone(),
        notes: set_up.notes.clone(),
        model: report::of_model(&set_up.model),
        parameters: report::of_parameters(set_up.model.parameters()),
        engine: engine.name().to_owned(),
        threads: engine.threads(),
        precision: given.precision,
        seed: given.seed,
        every,
        host: report::of_host(),
        started: report::now(),
        progress: report::Progress {
            outcome: "running",
            reason: None,
            steps: 0,
            steps_wanted: steps,
            time: 0.0,
            time_step: set_up.time_step,
            frames: 0,
            set_up_seconds: 0.0,
            step_seconds: 0.0,
            output_seconds: 0.0,
            wall_seconds: 0.0,
            steps_per_second: None,
            state_bytes: None,
            peak_memory_bytes: None,
        },
        observables: Vec::new(),
        files: recorder.files(),
    }
}

/// A run under way.
struct Run {
    simulation: Simulation,
    recorder: Recorder,
    report: Report,
    folder: RunFolder,
    every: u64,
    quiet: bool,
    begin: Instant,
    set_up: Duration,
    stepping: Duration,
}

impl Run {
    fn go(mut self) -> Result<Ended, Unable> {
        let interrupt = Interrupt::install().map_err(Unable::failed)?;
        self.say(&self.headline());
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
            (Ok(ended), Ok(())) => {
                self.say(&self.summary());
                Ok(ended)
            }
        }
    }

    /// What is left of a run that failed.
    fn remains(&self) -> String {
        let folder = self.folder.top.path().display();
        format!(
            "{} steps are done; what was written until then is in {folder}",
            self.simulation.step_number()
        )
    }

    /// Records the initial state, does the steps, and records the final state.
    fn steps(&mut self, interrupt: &Interrupt) -> Result<Ended, Failure> {
        let wanted = self.report.progress.steps_wanted;
        self.recorder.begin(self.folder.clone(), &mut self.simulation)?;
        let line =
            if self.quiet { progress::Progress::hidden() } else { progress::Progress::new(Some(wanted)) };
        let mut batch = Batch::default();
        while self.simulation.step_number() < wanted
            && self.simulation.stop_reason().is_none()
            && !interrupt.is_raised()
        {
            let done = self.simulation.step_number();
            let next_output = (done / self.every + 1).saturating_mul(self.every).min(wanted);
            let begin = Instant::now();
            let result = self.simulation.run(batch.steps.min(next_output - done));
            self.stepping += begin.elapsed();
            batch.adapt(begin.elapsed());
            if result.is_err() {
                line.finish();
            }
            result?;
            let done = self.simulation.step_number();
            line.at(done);
            if done.is_multiple_of(self.every) {
                self.recorder.record(&mut self.simulation)?;
            }
        }
        line.finish();
        self.simulation.finish()?;
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

    fn complete_report(&mut self) {
        let (frames, first, last) = self.recorder.results();
        self.report.observables = report::of_observables(first, last);
        let steps = self.simulation.step_number();
        let progress = &mut self.report.progress;
        progress.steps = steps;
        progress.time = self.recorder.time(steps);
        progress.frames = frames;
        progress.set_up_seconds = self.set_up.as_secs_f64();
        progress.step_seconds = self.stepping.as_secs_f64();
        progress.wall_seconds = self.begin.elapsed().as_secs_f64();
        progress.output_seconds = progress.wall_seconds - progress.set_up_seconds - progress.step_seconds;
        progress.steps_per_second = (steps > 0).then(|| steps as f64 / progress.step_seconds.max(1e-9));
        progress.state_bytes = Some(self.simulation.memory());
        progress.peak_memory_bytes = peak_memory();
    }

    fn say(&self, text: &str) {
        if !self.quiet {
            terminal::say(text);
        }
    }
}

#[cfg(test)]
mod tests;
