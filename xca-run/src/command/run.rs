//! The subcommand `run`.

use super::arguments::{EngineArguments, RunArguments};
use super::parse::{RunInvocation, with_help, with_model};
use super::prepare::{Prepared, not_begun};
use super::under_way::UnderWay;
use super::{Definition, Ended, Unable};
use crate::terminal;
use clap::{Args, Command};
use std::path::PathBuf;
use xca_core::{Model, Precision, RunError};

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
    if invocation.run.print_wgsl {
        let given = invocation.model.arguments.given(invocation.run.steps);
        let model = invocation.model.set_up(&given)?.model;
        terminal::say(&wgsl(&model, given.precision)?).map_err(Unable::failed)?;
        return Ok(Ended::Done);
    }
    let Prepared { engine, run } = Prepared::new(&invocation, &invocation.engine)?;
    let RunInvocation { model, run: arguments, .. } = invocation;
    let folder = arguments.out.unwrap_or_else(|| PathBuf::from("out").join(model.definition.name));
    let recording = run.begin(folder, &*engine).map_err(not_begun)?;
    UnderWay { recording, voice: arguments.voice, note: engine.note() }.go()
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
