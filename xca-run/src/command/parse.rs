//! From the words of a command line to what they mean.

use super::arguments::{ModelArguments, ResumeArguments, RunArguments};
use super::compare::CompareArguments;
use super::engine::{EngineChoice, given};
use super::inspect::InspectArguments;
use super::list::ListArguments;
use super::new::NewArguments;
use super::render::RenderArguments;
use super::sweep::SweepArguments;
use super::watch::WatchArguments;
use super::{
    Definition, EXIT_CODES, Unable, clashes, compare, config, initial, inspect, list, new, render, resume,
    run, sweep, watch,
};
use crate::engines::EngineOptions;
use crate::program::Given;
use clap::error::ErrorKind;
use clap::{ArgMatches, Args, Command, FromArgMatches};
use serde_json::{Map, Value};
use std::ffi::OsString;
use std::path::PathBuf;
use xca_record::SetUp;

/// What a command line asks for.
pub(super) enum Invocation<'a> {
    Run(Box<RunInvocation<'a>>),
    /// With what is said of the engine.
    Resume(&'a Definition<'a>, ResumeArguments, EngineChoice),
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

/// A model with the options that the command line gives it.
pub(super) struct Choice<'a> {
    pub(super) definition: &'a Definition<'a>,
    pub(super) arguments: ModelArguments,
    /// The model's own options, for the report.
    pub(super) options: Map<String, Value>,
    matches: ArgMatches,
}

/// A run.
pub(super) struct RunInvocation<'a> {
    pub(super) model: Choice<'a>,
    pub(super) engine: EngineChoice,
    pub(super) run: RunArguments,
    /// The command line, with what a configuration file added to it.
    pub(super) command_line: Vec<String>,
}

impl<'a> Choice<'a> {
    fn new(definition: &'a Definition<'a>, matches: &ArgMatches) -> Result<Self, Unable> {
        let (arguments, options) = (from(matches)?, options(definition, matches));
        Ok(Self { definition, arguments, options, matches: matches.clone() })
    }

    /// Makes the model, with its parameters set.
    pub(super) fn set_up(&self, given: &Given) -> Result<SetUp, Unable> {
        let mut set_up = (self.definition.set_up)(&self.matches, given.clone())?;
        set_up.check().map_err(Unable::refused)?;
        if let (Some(parameter), 0) = (given.parameters.first(), set_up.model.parameters().count()) {
            return Err(Unable::refused(format!(
                "this model has no parameters; `{parameter}` cannot be set"
            )));
        }
        for parameter in &given.parameters {
            set_up.model.set_parameter(&parameter.name, &parameter.value).map_err(Unable::refused)?;
        }
        initial::apply(&mut set_up, &self.arguments.initial).map_err(Unable::refused)?;
        Ok(set_up)
    }
}

/// The whole command.
pub(super) fn command(definition: &Definition<'_>) -> Command {
    let Definition { name, about, version, .. } = definition;
    let examples = format!(
        "Examples:\n  {name} run\n  {name} resume out/{name}\n  {name} compare\n  {name} sweep --seeds 10\n  {name} render\n  {name} watch\n  {name} list\n  {name} inspect out/{name}\n  {name} new waves"
    );
    Command::new(*name)
        .about(*about)
        .version(*version)
        .subcommand_required(true)
        .arg_required_else_help(true)
        .after_help(format!(
            "`{name} run --help` lists the options of a run, and so for each command.\n\n{examples}\n\n{EXIT_CODES}"
        ))
        .subcommands([
            run::command(definition),
            resume::command(definition),
            render::command(definition),
            watch::command(definition),
            list::command(definition),
            inspect::command(definition),
            compare::command(definition),
            sweep::command(definition),
            new::command(definition),
        ])
}

/// Adds the options of the model, its own and those of every model.
pub(super) fn with_model(command: Command, definition: &Definition<'_>) -> Command {
    let command = (definition.options)(command.next_help_heading("Options of this model"));
    ModelArguments::augment_args(command.next_help_heading("Options of every model"))
}

/// What is the same in the help of all subcommands.
pub(super) fn with_help(command: Command, about: &'static str, examples: &[String]) -> Command {
    let examples: String = examples.iter().map(|example| format!("\n  {example}")).collect();
    command
        // An option's text comes from its own description, never from that of the struct.
        .about(about)
        .long_about(None::<&str>)
        .mut_args(|option| {
            // `--steps -1` is a wrong number, not an unknown option.
            let takes_values = option.get_action().takes_values();
            if takes_values { option.allow_negative_numbers(true) } else { option }
        })
        .after_help(format!("Examples:{examples}\n\n{EXIT_CODES}"))
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
    complete(definition, &command, &arguments)
}

/// Reads a command line to which nothing is to be added: that of an earlier run, as a file of this kind tells it.
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
            Err(Unable::refused(format!("the command line of the {of} is not one of this program: {first}")))
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
        Some((run::NAME, matches)) => Ok(Invocation::Run(Box::new(RunInvocation {
            model: Choice::new(definition, matches)?,
            engine: EngineChoice::of(definition.engines, matches),
            run: from(matches)?,
            command_line: words(arguments),
        }))),
        Some((compare::NAME, matches)) => Ok(Invocation::Compare(
            Box::new(Choice::new(definition, matches)?),
            Box::new(from(matches)?),
            given(definition.engines, matches),
            words(arguments),
        )),
        Some((sweep::NAME, matches)) => {
            let on = EngineChoice::of(definition.engines, matches);
            Ok(Invocation::Sweep(Box::new(Choice::new(definition, matches)?), on, from(matches)?))
        }
        Some((render::NAME, matches)) => {
            let render: RenderArguments = from(matches)?;
            if let Some(path) = render.saved() {
                render::check_saved(command, matches, &path)?;
                return Ok(Invocation::Draw(definition, path, render, words(arguments)));
            }
            let run = RunInvocation {
                model: Choice::new(definition, matches)?,
                engine: EngineChoice::of(definition.engines, matches),
                run: render.as_of_run(),
                command_line: words(arguments),
            };
            Ok(Invocation::Render(Box::new(run), render))
        }
        Some((watch::NAME, matches)) => {
            let watch: WatchArguments = from(matches)?;
            let run = RunInvocation {
                model: Choice::new(definition, matches)?,
                engine: EngineChoice::of(definition.engines, matches),
                run: watch.as_of_run(),
                command_line: words(arguments),
            };
            Ok(Invocation::Watch(Box::new(run), watch))
        }
        Some((list::NAME, matches)) => {
            Ok(Invocation::List(Box::new(Choice::new(definition, matches)?), from(matches)?))
        }
        Some((inspect::NAME, matches)) => Ok(Invocation::Inspect(definition, from(matches)?)),
        Some((new::NAME, matches)) => Ok(Invocation::New(from(matches)?)),
        Some((resume::NAME, matches)) => {
            let on = EngineChoice::of(definition.engines, matches);
            Ok(Invocation::Resume(definition, from(matches)?, on))
        }
        _ => Err(Unable::refused("no command is given")),
    }
}

fn words(arguments: &[OsString]) -> Vec<String> {
    arguments.iter().map(|argument| argument.to_string_lossy().into_owned()).collect()
}

fn from<A: FromArgMatches>(matches: &ArgMatches) -> Result<A, Unable> {
    A::from_arg_matches(matches).map_err(Unable::CommandLine)
}

/// The configuration file that the command line names. Mistakes on the command line are found before the file is read; only what is missing may
/// come from the file.
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

/// The values of a model's own options: numbers and truth values as such, all others as text.
fn options(definition: &Definition<'_>, matches: &ArgMatches) -> Map<String, Value> {
    let own = (definition.options)(Command::new(run::NAME));
    let name = |option: &clap::Arg| option.get_long().unwrap_or(option.get_id().as_str()).to_owned();
    own.get_arguments()
        .map(|option| {
            let is_list = matches!(option.get_action(), clap::ArgAction::Append);
            let raw = matches.get_raw(option.get_id().as_str()).into_iter().flatten();
            let mut values: Vec<Value> = raw.map(|text| value(&text.to_string_lossy())).collect();
            let value = if is_list { Value::Array(values) } else { values.pop().unwrap_or(Value::Null) };
            (name(option), value)
        })
        .collect()
}

fn value(text: &str) -> Value {
    match serde_json::from_str(text) {
        Ok(value @ (Value::Number(_) | Value::Bool(_))) => value,
        _ => Value::String(text.to_owned()),
    }
}

#[cfg(test)]
mod tests;
