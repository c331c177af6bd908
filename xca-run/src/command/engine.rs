//! The options of the command line that choose an engine: those of all kinds that the program offers.

use super::definition::Definition;
use super::outcome::Unable;
use crate::engines::{EngineKind, EngineOption, EngineOptions, Engines};
use clap::builder::{PossibleValue, PossibleValuesParser};
use clap::{Arg, ArgMatches, Command};
use xca_core::Engine;

/// An engine as the command line chooses it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct EngineChoice {
    pub(crate) name: String,
    pub(crate) options: EngineOptions,
}

/// The option that names the engine.
const ENGINE: &str = "engine";

/// Adds the options that choose the engine of a run.
pub(super) fn with_engine(command: Command, engines: &Engines) -> Command {
    let first = engines.kinds().next().map(EngineKind::name);
    let command = command.arg(engine(engines).help("What runs the model").default_value(first));
    command.args(options(engines).into_iter().map(argument))
}

/// Adds the options that choose another engine for a run that goes on.
pub(super) fn with_other_engine(command: Command, engines: &Engines) -> Command {
    let other = engine(engines).help("What runs the model; the run's own engine unless it is given");
    let options = options(engines).into_iter().map(argument);
    command.arg(other).args(options)
}

/// Adds the options that a comparison cannot take after the colon.
pub(super) fn with_shared_options(command: Command, engines: &Engines) -> Command {
    let first = |name: &str| {
        let mut first = engines.kinds().filter_map(|kind| kind.options().first());
        first.any(|option| option.name == name)
    };
    command.args(options(engines).into_iter().filter(|option| !first(option.name)).map(argument))
}

fn engine(engines: &Engines) -> Arg {
    let named = engines.kinds().map(|kind| PossibleValue::new(kind.name()).help(kind.about()));
    Arg::new(ENGINE).long(ENGINE).value_name("ENGINE").value_parser(PossibleValuesParser::new(named))
}

/// The options of all kinds, each once.
pub(super) fn options(engines: &Engines) -> Vec<EngineOption> {
    let mut all: Vec<EngineOption> = Vec::new();
    for option in engines.kinds().flat_map(EngineKind::options) {
        if all.iter().all(|other| other.name != option.name) {
            all.push(*option);
        }
    }
    all
}

fn argument(option: EngineOption) -> Arg {
    let EngineOption { name, value_name, about, check } = option;
    let parse = move |text: &str| check(text).map(|()| text.to_owned());
    Arg::new(name).long(name).value_name(value_name).help(about).value_parser(parse)
}

/// What of these options is given.
pub(super) fn given(engines: &Engines, matches: &ArgMatches) -> EngineOptions {
    let mut given = EngineOptions::default();
    for EngineOption { name, .. } in options(engines) {
        if let Ok(Some(value)) = matches.try_get_one::<String>(name) {
            given = given.with(name, value);
        }
    }
    given
}

impl EngineChoice {
    /// What the command line says.
    pub(super) fn of(engines: &Engines, matches: &ArgMatches) -> Self {
        let name = matches.get_one::<String>(ENGINE).cloned().unwrap_or_default();
        Self { name, options: given(engines, matches) }
    }

    /// What the command line says for a run that was begun on this engine.
    pub(super) fn or_as_begun(&self, begun: &Self) -> Self {
        if self.name.is_empty() || self.name == begun.name {
            return Self { name: begun.name.clone(), options: self.options.clone().or(&begun.options) };
        }
        // Another engine need not be able to use what that one used.
        self.clone()
    }

    /// The engine.
    pub(super) fn engine(&self, definition: &Definition<'_>) -> Result<Box<dyn Engine>, Unable> {
        definition.engines.engine(&self.name, &self.options).map_err(Unable::refused)
    }
}
