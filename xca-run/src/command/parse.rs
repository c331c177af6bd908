//! From the words of a command line to what they mean.

use super::arguments::{EngineArguments, ModelArguments, RunArguments};
use super::{Definition, EXIT_CODES, Unable, config};
use crate::program::Given;
use crate::set_up::SetUp;
use clap::error::ErrorKind;
use clap::{ArgMatches, Args, Command, FromArgMatches};
use serde_json::{Map, Value};
use std::ffi::OsString;
use std::path::PathBuf;

/// The name of the subcommand.
pub(super) const RUN: &str = "run";

const RUN_ABOUT: &str = "Run the model, and write what comes of it to a folder";

/// What a command line asks for.
pub(super) struct Invocation<'a> {
    pub(super) definition: &'a Definition<'a>,
    pub(super) model: ModelArguments,
    pub(super) engine: EngineArguments,
    pub(super) run: RunArguments,
    /// The model's own options, for the report.
    pub(super) options: Map<String, Value>,
    pub(super) command_line: Vec<String>,
    matches: ArgMatches,
}

impl Invocation<'_> {
    /// Makes the model.
    pub(super) fn set_up(&self, given: Given) -> Result<SetUp, Unable> {
        (self.definition.set_up)(&self.matches, given)
    }
}

/// The whole command.
pub(super) fn command(definition: &Definition<'_>) -> Command {
    let Definition { name, about, version, examples, options, .. } = definition;
    let run = Command::new(RUN);
    let run = options(run.next_help_heading("Options of this model"));
    let run = ModelArguments::augment_args(run.next_help_heading("Options of every model"));
    let run = EngineArguments::augment_args(run);
    let run = RunArguments::augment_args(run).next_help_heading(None::<&str>);
    let examples: String = examples.lines().map(|line| format!("\n  {name} run {}", line.trim())).collect();
    let run = run
        // An option's text comes from its own description, never from that of the struct.
        .about(RUN_ABOUT)
        .long_about(None::<&str>)
        .mut_args(|option| {
            // `--steps -1` is a wrong number, not an unknown option.
            let takes_values = option.get_action().takes_values();
            if takes_values { option.allow_negative_numbers(true) } else { option }
        })
        .after_help(format!("Examples:\n  {name} run{examples}\n\n{EXIT_CODES}"));
    Command::new(*name)
        .about(*about)
        .version(*version)
        .subcommand_required(true)
        .arg_required_else_help(true)
        .after_help(format!("`{name} run --help` lists the options of a run.\n\n{EXIT_CODES}"))
        .subcommand(run)
}

/// Reads the command line, and the configuration file that it names.
pub(super) fn invocation<'a>(
    definition: &'a Definition<'a>,
    arguments: &[OsString],
) -> Result<Invocation<'a>, Unable> {
    let command = command(definition);
    let mut arguments = arguments.to_vec();
    if let Some(path) = config_file(&command, &arguments)? {
        let lenient = command.clone().ignore_errors(true).try_get_matches_from(&arguments);
        let lenient = lenient.map_err(Unable::CommandLine)?;
        if let (Some((name, matches)), Some(run)) = (lenient.subcommand(), command.find_subcommand(RUN)) {
            let from_file = config::arguments(&path, run, matches).map_err(Unable::refused)?;
            let place =
                1 + arguments.iter().position(|argument| argument.to_str() == Some(name)).unwrap_or(0);
            arguments.splice(place..place, from_file);
        }
    }
    let matches = command.try_get_matches_from(&arguments).map_err(Unable::CommandLine)?;
    let (_, matches) = matches.subcommand().ok_or_else(|| Unable::refused("no command is given"))?;
    let command_line = arguments.iter().map(|argument| argument.to_string_lossy().into_owned()).collect();
    Ok(Invocation {
        definition,
        model: from(matches)?,
        engine: from(matches)?,
        run: from(matches)?,
        options: options(definition, matches),
        command_line,
        matches: matches.clone(),
    })
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
    Ok(matches.subcommand().and_then(|(_, run)| run.get_one::<PathBuf>("config").cloned()))
}

/// The values of a model's own options: numbers and truth values as such, all others as text.
fn options(definition: &Definition<'_>, matches: &ArgMatches) -> Map<String, Value> {
    let own = (definition.options)(Command::new(RUN));
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
