//! The options of the command line that choose an engine: those of all kinds that the program offers.

use super::definition::Definition;
use super::outcome::{Ended, Unable};
use crate::engines::{EngineChoice, EngineKind, EngineOption, EngineOptions, EngineWords, Engines, Helper};
use clap::{Arg, ArgMatches, Command};
use xca_core::{Engine, Model};

/// The option that names the engine.
const ENGINE: &str = "engine";

/// Adds the options that choose the engine of a run.
pub(super) fn with_engine(command: Command, engines: &Engines) -> Command {
    let first = engines.kinds().next().map(EngineKind::name);
    let command = command.arg(engine(engines, "Engine").default_value(first));
    command.args(options(engines).into_iter().map(argument))
}

/// Adds the options that choose another engine for a run that goes on.
pub(super) fn with_other_engine(command: Command, engines: &Engines) -> Command {
    let other = engine(engines, "Engine [default: that of the run]");
    let options = options(engines).into_iter().map(argument);
    command.arg(other).args(options)
}

/// Adds the options that a comparison cannot take after the colon.
pub(super) fn with_shared_options(command: Command, engines: &Engines) -> Command {
    let is_detail = |name: &str| {
        let mut details = engines.kinds().filter_map(EngineKind::detail);
        details.any(|detail| detail.option.name == name)
    };
    command.args(options(engines).into_iter().filter(|option| !is_detail(option.name)).map(argument))
}

fn engine(engines: &Engines, about: &str) -> Arg {
    let words = EngineWords::new(engines);
    let help = format!("{about}: {}", words.forms());
    let long = format!("{about}:\n{}", words.about());
    let parse = move |text: &str| words.parse(text);
    Arg::new(ENGINE).long(ENGINE).value_name("ENGINE").help(help).long_help(long).value_parser(parse)
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

/// The engine that the command line chooses.
pub(super) fn chosen(engines: &Engines, matches: &ArgMatches) -> Result<EngineChoice, Unable> {
    let word = matches
        .get_one::<EngineChoice>(ENGINE)
        .cloned()
        .ok_or_else(|| Unable::refused("no engine is given"))?;
    word.with(&given(engines, matches)).map_err(Unable::refused)
}

/// The engine that the command line chooses for a run that was begun on another.
#[derive(Debug)]
pub(super) struct OtherChoice {
    /// Nothing where it is the run's own.
    word: Option<EngineChoice>,
    options: EngineOptions,
}

impl OtherChoice {
    pub(super) fn new(engines: &Engines, matches: &ArgMatches) -> Result<Self, Unable> {
        let (word, options) = (matches.get_one::<EngineChoice>(ENGINE).cloned(), given(engines, matches));
        if let Some(word) = &word {
            word.clone().with(&options).map_err(Unable::refused)?;
        }
        Ok(Self { word, options })
    }

    /// The engine of a run that was begun on this one.
    pub(super) fn or_as_begun(&self, begun: &EngineChoice) -> EngineChoice {
        let own = self.word.iter().fold(self.options.clone(), |options, word| options.or(&word.options));
        match &self.word {
            // Another engine need not be able to use what that one used.
            Some(word) if word.name != begun.name => EngineChoice { name: word.name.clone(), options: own },
            _ => EngineChoice { name: begun.name.clone(), options: own.or(&begun.options) },
        }
    }
}

impl EngineChoice {
    /// What this process does where it is only there to help another one.
    pub(super) fn helper(&self, definition: &Definition<'_>) -> Result<Option<Box<dyn Helper>>, Unable> {
        let kind = definition.engines.kind(&self.name).map_err(Unable::refused)?;
        kind.helper().map_err(Unable::Refused)
    }

    /// The engine.
    pub(super) fn engine(&self, definition: &Definition<'_>) -> Result<Box<dyn Engine>, Unable> {
        definition.engines.engine(&self.name, &self.options).map_err(Unable::refused)
    }
}

/// Helps another process with what it runs: a model that is made here when it is needed.
pub(super) fn help(
    helper: &dyn Helper,
    mut model: impl FnMut() -> Result<Model, Unable>,
) -> Result<Ended, Unable> {
    helper.help(&mut |_| model().map_err(Unable::into_failure)).map_err(Unable::failed)?;
    Ok(Ended::Done)
}
