//! The model and the run that a command line chooses.

use super::arguments::{ModelArguments, RunArguments};
use super::definition::Definition;
use super::initial;
use super::outcome::Unable;
use crate::engines::EngineChoice;
use crate::program::Given;
use clap::{ArgMatches, Command, FromArgMatches};
use serde_json::{Map, Value};
use xca_record::SetUp;

/// A model with the options that the command line gives it.
pub(super) struct Choice<'a> {
    pub(super) definition: &'a Definition<'a>,
    pub(super) arguments: ModelArguments,
    /// The model's own options, for the report.
    pub(super) options: Map<String, Value>,
    pub(super) matches: ArgMatches,
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
    pub(super) fn new(definition: &'a Definition<'a>, matches: &ArgMatches) -> Result<Self, Unable> {
        let (arguments, options) = (parsed(matches)?, options(definition, matches));
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

/// The values of a model's own options: numbers and truth values as such, all others as text.
fn options(definition: &Definition<'_>, matches: &ArgMatches) -> Map<String, Value> {
    let own = (definition.options)(Command::new(definition.name));
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

/// The arguments of a command.
pub(super) fn parsed<A: FromArgMatches>(matches: &ArgMatches) -> Result<A, Unable> {
    A::from_arg_matches(matches).map_err(Unable::CommandLine)
}
