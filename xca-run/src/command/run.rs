//! The subcommand `run`.

use super::arguments::RunArguments;
use super::choice::RunInvocation;
use super::definition::Definition;
use super::engine::{help, with_engine};
use super::help::{with_help, with_model};
use super::outcome::{Ended, Unable};
use super::prepare::{Prepared, described, not_begun};
use super::under_way::UnderWay;
use crate::terminal;
use clap::{Args, Command};
use std::path::PathBuf;

pub(super) const NAME: &str = "run";

pub(super) const ABOUT: &str = "Run the model and write its output";

pub(super) fn command(definition: &Definition<'_>) -> Command {
    let Definition { name, examples, .. } = definition;
    let command = with_engine(with_model(Command::new(NAME), definition), definition.engines);
    let command = RunArguments::augment_args(command).next_help_heading(None::<&str>);
    let of_model = examples.lines().map(|line| format!("{name} run {}", line.trim()));
    let examples: Vec<String> = [format!("{name} run")].into_iter().chain(of_model).collect();
    with_help(command, ABOUT, &examples)
}

/// Runs the model of a program.
pub(super) fn run(invocation: RunInvocation<'_>) -> Result<Ended, Unable> {
    if invocation.run.print_source {
        terminal::say(&source(&invocation)?).map_err(Unable::failed)?;
        return Ok(Ended::Done);
    }
    if let Some(helper) = invocation.engine.helper(invocation.model.definition)? {
        return help(&*helper, || Ok(described(&invocation)?.model().clone()));
    }
    let Prepared { engine, run } = Prepared::new(&invocation, &invocation.engine)?;
    let RunInvocation { model, run: arguments, .. } = invocation;
    let folder = arguments.out.unwrap_or_else(|| PathBuf::from("out").join(model.definition.name));
    let recording = run.begin(folder, &*engine).map_err(|error| not_begun(model.definition.name, error))?;
    UnderWay { recording, voice: arguments.voice, note: engine.note() }.go()
}

/// What the engine makes of the processes.
fn source(invocation: &RunInvocation<'_>) -> Result<String, Unable> {
    let given = invocation.model.arguments.given(invocation.run.steps);
    let name = &invocation.engine.name;
    let kind = invocation.model.definition.engines.kind(name).map_err(Unable::refused)?;
    let model = invocation.model.set_up(&given)?.model;
    let source = kind.source(&model, given.precision).ok_or_else(|| {
        Unable::refused(format!("the {name} engine generates no code; --engine gpu generates shaders"))
    })?;
    source.map_err(Unable::Refused)
}

#[cfg(test)]
mod tests;
