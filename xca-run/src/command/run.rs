//! The subcommand `run`.

use super::arguments::{EngineArguments, RunArguments};
use super::parse::{RunInvocation, with_help, with_model};
use super::prepare::Prepared;
use super::under_way::{Checkpoints, UnderWay};
use super::{Definition, Ended, Unable};
use crate::checkpoint::CheckpointFolder;
use crate::record::{Claim, Kind, RunFolder};
use crate::report::Earlier;
use crate::terminal;
use clap::{Args, Command};
use std::path::PathBuf;
use std::time::{Duration, Instant};
use xca_core::{Model, Precision, RunError, Simulation};

pub(super) const NAME: &str = "run";

pub(super) const ABOUT: &str = "Run the model, and write what comes of it to a folder";

pub(super) fn command(definition: &Definition<'_>) -> Command {
    let Definition { name, examples, .. } = definition;
    let command = EngineArguments::augment_args(with_model(Command::new(NAME), definition));
    let command = RunArguments::augment_args(command).next_help_heading(None::<&str>);
    let of_model = examples.lines().map(|line| format!("{name} run {}", line.trim()));
    let examples: Vec<String> = [format!("{name} run")].into_iter().chain(of_model).collect();
    with_help(command, ABOUT, &examples)
}

/// Runs the model of a program.
pub(super) fn run(invocation: RunInvocation<'_>) -> Result<Ended, Unable> {
    let begin = Instant::now();
    if invocation.run.print_wgsl {
        let given = invocation.model.arguments.given(invocation.run.steps);
        let model = invocation.model.set_up(&given)?.model;
        terminal::say(&wgsl(&model, given.precision)?).map_err(Unable::failed)?;
        return Ok(Ended::Done);
    }
    let Prepared { engine, recorder, options, origin, mut report } =
        Prepared::new(&invocation, &invocation.engine)?;
    let RunInvocation { model, run, .. } = invocation;
    report.checkpoint_every = run.checkpoint_every.map(|interval| interval.to_string());
    if run.checkpoint_every.is_some() {
        // The first, so that they are gone first when another run takes the folder: without their files they are of no use.
        report.files.insert(0, CheckpointFolder::files());
    }
    let path = run.out.unwrap_or_else(|| PathBuf::from("out").join(model.definition.name));
    let claim = Claim { kind: Kind::Run, files: &report.files, inputs: &recorder.set_up().inputs };
    let folder = RunFolder::prepare(&path, &claim).map_err(Unable::refused)?;
    let simulation = Simulation::new(recorder.model(), &*engine, options).map_err(not_started)?;
    let checkpoints = run.checkpoint_every.map(|interval| Checkpoints::new(interval, &folder, None));
    let checkpoints = checkpoints.transpose().map_err(Unable::refused)?;
    let under_way = UnderWay {
        simulation,
        recorder,
        report,
        folder,
        origin,
        checkpoints,
        allow_non_finite: run.allow_non_finite,
        voice: run.voice,
        note: engine.note(),
        earlier: Earlier::default(),
        begin,
        set_up: begin.elapsed(),
        stepping: Duration::ZERO,
    };
    under_way.go()
}

/// The processes as the gpu engine compiles them.
#[cfg(feature = "gpu")]
fn wgsl(model: &Model, precision: Precision) -> Result<String, Unable> {
    xca_gpu::wgsl(model, precision).map_err(Unable::failed)
}

#[cfg(not(feature = "gpu"))]
fn wgsl(_model: &Model, _precision: Precision) -> Result<String, Unable> {
    Err(Unable::refused(crate::engines::MissingFeature::GPU))
}

/// An initial state that cannot be made is a mistake in what was given.
pub(super) fn not_started(error: RunError) -> Unable {
    match error {
        RunError::Steering { step: 0, source } => Unable::Refused(source),
        other => Unable::refused(other),
    }
}

#[cfg(test)]
mod tests;
