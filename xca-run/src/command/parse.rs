//! From the words of a command line to what they mean.

use super::arguments::RunArguments;
use super::choice::{Choice, RunInvocation, parsed};
use super::compare::CompareArguments;
use super::definition::Definition;
use super::engine::{OtherChoice, chosen, given};
use super::inspect::InspectArguments;
use super::list::ListArguments;
use super::new::NewArguments;
use super::outcome::Unable;
use super::render::RenderArguments;
use super::resume::ResumeArguments;
use super::subcommands::command;
use super::sweep::SweepArguments;
use super::watch::WatchArguments;
use super::{clashes, compare, config, inspect, list, new, render, resume, run, sweep, watch};
use crate::engines::{EngineChoice, EngineOptions};
use clap::error::ErrorKind;
use clap::{ArgMatches, Command};
use std::ffi::OsString;
use std::path::PathBuf;

/// What a command line asks for.
pub(super) enum Invocation<'a> {
    Run(Box<RunInvocation<'a>>),
    /// With what is said of the engine.
    Resume(&'a Definition<'a>, ResumeArguments, OtherChoice),
    Render(Box<RunInvocation<'a>>, RenderArguments),
    /// With what has to be drawn, and with the whole command line.
    Draw(&'a Definition<'a>, PathBuf, RenderArguments, Vec<String>),
    Watch(Box<RunInvocation<'a>>, WatchArguments),
    List(Box<Choice<'a>>, ListArguments),
    Inspect(&'a Definition<'a>, InspectArguments),
    /// With what is chosen of the engines, and with the whole command line.
    Compare(Box<Choice<'a>>, Box<CompareArguments>, EngineOptions, Vec<String>),
    Sweep(Box<Choice<'a>>, EngineChoice, SweepArguments),
    New(NewArguments),
}

/// Reads the command line, and the configuration file that it names.
pub(super) fn invocation<'a>(
    definition: &'a Definition<'a>,
    arguments: &[OsString],
) -> Result<Invocation<'a>, Unable> {
    clashes::check(definition).map_err(Unable::refused)?;
    // A report could not tell them, nor `resume` go on with them. The first is the program itself.
    if let Some(word) = arguments.iter().skip(1).find(|word| word.to_str().is_none()) {
        let word = word.display();
        return Err(Unable::refused(format!(
            "`{word}` on the command line is not UTF-8; rename the file or the folder"
        )));
    }
    let command = command(definition);
    let mut arguments = arguments.to_vec();
    if let Some(path) = config_file(&command, &arguments)? {
        let lenient = command.clone().ignore_errors(true).try_get_matches_from(&arguments);
        let lenient = lenient.map_err(Unable::CommandLine)?;
        let chosen = lenient.subcommand();
        let chosen = chosen.and_then(|(name, matches)| Some((name, matches, command.find_subcommand(name)?)));
        if let Some((name, matches, subcommand)) = chosen {
            let from_file = config::arguments(&path, subcommand, matches).map_err(Unable::refused)?;
            let place =
                1 + arguments.iter().position(|argument| argument.to_str() == Some(name)).unwrap_or(0);
            arguments.splice(place..place, from_file);
        }
    }
    let invocation = complete(definition, &command, &arguments)?;
    // An earlier run may have used an engine that this process cannot: `resume` can choose another.
    let (engine, subcommand) = match &invocation {
        Invocation::Run(run) => (&run.engine, run::NAME),
        Invocation::Render(run, _) => (&run.engine, render::NAME),
        Invocation::Watch(run, _) => (&run.engine, watch::NAME),
        Invocation::Sweep(_, engine, _) => (engine, sweep::NAME),
        _ => return Ok(invocation),
    };
    definition.engines.check([&*engine.name], subcommand).map_err(Unable::refused)?;
    Ok(invocation)
}

/// Reads a command line to which nothing is to be added: that of an earlier run, as a file of this kind tells
/// it.
pub(super) fn recorded<'a>(
    definition: &'a Definition<'a>,
    command_line: &[String],
    of: &str,
) -> Result<RunInvocation<'a>, Unable> {
    let arguments: Vec<OsString> = command_line.iter().map(OsString::from).collect();
    match complete(definition, &command(definition), &arguments) {
        Ok(Invocation::Run(run)) => Ok(*run),
        Ok(_) => Err(Unable::refused(format!("the command line of the {of} is not that of a run"))),
        Err(Unable::CommandLine(error)) => {
            let text = error.to_string();
            let first = text.split("\n\n").next().unwrap_or_default().trim_start_matches("error: ");
            Err(Unable::refused(format!("the command line of the {of} does not fit this program: {first}")))
        }
        Err(other) => Err(other),
    }
}

fn complete<'a>(
    definition: &'a Definition<'a>,
    command: &Command,
    arguments: &[OsString],
) -> Result<Invocation<'a>, Unable> {
    let matches = command.clone().try_get_matches_from(arguments).map_err(Unable::CommandLine)?;
    match matches.subcommand() {
        Some((run::NAME, matches)) => {
            Ok(Invocation::Run(run_of(definition, matches, parsed(matches)?, arguments)?))
        }
        Some((compare::NAME, matches)) => Ok(Invocation::Compare(
            Box::new(Choice::new(definition, matches)?),
            Box::new(parsed(matches)?),
            given(definition.engines, matches),
            words(arguments),
        )),
        Some((sweep::NAME, matches)) => {
            let on = chosen(definition.engines, matches)?;
            Ok(Invocation::Sweep(Box::new(Choice::new(definition, matches)?), on, parsed(matches)?))
        }
        Some((render::NAME, matches)) => {
            let render: RenderArguments = parsed(matches)?;
            if let Some(path) = render.saved() {
                render::check_saved(command, matches, &path)?;
                return Ok(Invocation::Draw(definition, path, render, words(arguments)));
            }
            let run = run_of(definition, matches, render.as_of_run(), arguments)?;
            Ok(Invocation::Render(run, render))
        }
        Some((watch::NAME, matches)) => {
            let watch: WatchArguments = parsed(matches)?;
            let run = run_of(definition, matches, watch.as_of_run(), arguments)?;
            Ok(Invocation::Watch(run, watch))
        }
        Some((list::NAME, matches)) => {
            Ok(Invocation::List(Box::new(Choice::new(definition, matches)?), parsed(matches)?))
        }
        Some((inspect::NAME, matches)) => Ok(Invocation::Inspect(definition, parsed(matches)?)),
        Some((new::NAME, matches)) => Ok(Invocation::New(parsed(matches)?)),
        Some((resume::NAME, matches)) => {
            let on = OtherChoice::new(definition.engines, matches)?;
            Ok(Invocation::Resume(definition, parsed(matches)?, on))
        }
        _ => Err(Unable::refused("no command is given")),
    }
}

fn run_of<'a>(
    definition: &'a Definition<'a>,
    matches: &ArgMatches,
    run: RunArguments,
    arguments: &[OsString],
) -> Result<Box<RunInvocation<'a>>, Unable> {
    let (model, engine) = (Choice::new(definition, matches)?, chosen(definition.engines, matches)?);
    Ok(Box::new(RunInvocation { model, engine, run, command_line: words(arguments) }))
}

fn words(arguments: &[OsString]) -> Vec<String> {
    arguments.iter().map(|argument| argument.to_string_lossy().into_owned()).collect()
}

/// The configuration file that the command line names. Mistakes on the command line are found before the file
/// is read; only what is missing may come from the file.
fn config_file(command: &Command, arguments: &[OsString]) -> Result<Option<PathBuf>, Unable> {
    let matches = match command.clone().try_get_matches_from(arguments) {
        Err(error) if error.kind() == ErrorKind::MissingRequiredArgument => {
            command.clone().ignore_errors(true).try_get_matches_from(arguments)
        }
        other => other,
    };
    let matches = matches.map_err(Unable::CommandLine)?;
    let config = |matches: &ArgMatches| matches.try_get_one::<PathBuf>("config").ok().flatten().cloned();
    Ok(matches.subcommand().and_then(|(_, matches)| config(matches)))
}

#[cfg(test)]
mod tests;
