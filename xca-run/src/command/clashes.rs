//! A model's own options, which must not have the names of the frame's.

use super::definition::Definition;
use super::{engine, subcommands};
use crate::engines::Engines;
use clap::{Arg, Command};
use std::collections::BTreeSet;

/// Options of a model that a command line could not give.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
pub(super) enum ClashError {
    #[error(
        "the program already has options with the names of the model's options: {0}; rename those of the model"
    )]
    Taken(String),
    #[error(
        "the {engine} engine's own option `--{option}` has a name that the program has already (of {taken}); rename it"
    )]
    Engine { engine: &'static str, option: &'static str, taken: String },
    #[error("the model's own option `{0}` has no `--` before its name: write #[arg(long)] at its field")]
    Positional(String),
}

/// Stands for the options of the model.
const MARK: &str = "options of the model";

/// Finds what of the options of engines and of the model is taken by the frame, in whichever subcommand: at
/// once, not when that subcommand is used.
pub(super) fn check(definition: &Definition<'_>) -> Result<(), ClashError> {
    check_engines(definition)?;
    let own = (definition.options)(Command::new(definition.name));
    if let Some(option) = own.get_arguments().find(|option| option.is_positional()) {
        return Err(ClashError::Positional(option.get_id().to_string()));
    }
    let options = |command: Command| command.arg(Arg::new(MARK).long(MARK));
    let frame = subcommands::command(&Definition { options, ..*definition });
    let with_model = |command: &&Command| command.get_arguments().any(|option| option.get_id() == MARK);
    let commands: Vec<(&str, BTreeSet<String>)> = frame
        .get_subcommands()
        .filter(with_model)
        .map(|command| (command.get_name(), taken(command)))
        .collect();
    let mut clashes = Vec::new();
    for name in names(&own) {
        let takers: Vec<&str> =
            commands.iter().filter(|(_, taken)| taken.contains(&name)).map(|(command, _)| *command).collect();
        if !takers.is_empty() {
            clashes.push(format!("{name} (of {})", takers.join(", ")));
        }
    }
    // A field and its option, which are mostly called alike, are one clash.
    if clashes.iter().any(|clash| !clash.starts_with(FIELD)) {
        clashes.retain(|clash| !clash.starts_with(FIELD));
    }
    if clashes.is_empty() { Ok(()) } else { Err(ClashError::Taken(clashes.join(", "))) }
}

/// Engines may share an option, but have none of the frame's.
fn check_engines(definition: &Definition<'_>) -> Result<(), ClashError> {
    let bare = Engines::default();
    let without = Definition { options: std::convert::identity, engines: &bare, ..*definition };
    let frame = subcommands::command(&without);
    let known = engine::options(&bare);
    for kind in definition.engines.kinds() {
        let others = kind.options().iter().filter(|own| known.iter().all(|option| option.name != own.name));
        for option in others {
            let name = format!("`--{}`", option.name);
            let takers = frame.get_subcommands().filter(|command| taken(command).contains(&name));
            let takers: Vec<&str> = takers.map(Command::get_name).collect();
            if !takers.is_empty() {
                let taken = takers.join(", ");
                return Err(ClashError::Engine { engine: kind.name(), option: option.name, taken });
            }
        }
    }
    Ok(())
}

/// Before the name of a field: options are told apart by these, too.
const FIELD: &str = "the field ";

/// What a command line, and its parser, know the options of a command by.
fn names(command: &Command) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for option in command.get_arguments().filter(|option| option.get_id() != MARK) {
        names.insert(format!("{FIELD}`{}`", option.get_id()));
        let long = option.get_long().into_iter().chain(option.get_all_aliases().into_iter().flatten());
        names.extend(long.map(|name| format!("`--{name}`")));
        let short =
            option.get_short().into_iter().chain(option.get_all_short_aliases().into_iter().flatten());
        names.extend(short.map(|name| format!("`-{name}`")));
    }
    names.extend(command.get_groups().map(|group| format!("the struct `{}`", group.get_id())));
    names
}

/// The names that a command has without the model.
fn taken(command: &Command) -> BTreeSet<String> {
    let of_help = ["`--help`", "`-h`"].map(str::to_owned).into_iter();
    names(command).into_iter().chain(of_help).chain([format!("{FIELD}`help`")]).collect()
}

#[cfg(test)]
mod tests {
    use super::super::{Unable, parse};
    use super::*;
    use crate::engines::{EngineKind, EngineOption, EngineOptions};
    use clap::Args;
    use std::ffi::OsString;
    use std::sync::LazyLock;
    use xca_core::Engine;
    use xca_record::Failure;

    static ENGINES: LazyLock<Engines> = LazyLock::new(Engines::default);

    fn definition(options: fn(Command) -> Command) -> Definition<'static> {
        Definition {
            engines: &ENGINES,
            name: "rock",
            about: "Layers of rock",
            version: "1.0.0",
            examples: "",
            options,
            set_up: &|_, _| Err(Unable::refused("not here")),
        }
    }

    #[derive(Args)]
    struct Layered {
        #[arg(long)]
        size: usize,
        /// The layer that is struck
        #[arg(long)]
        layer: usize,
    }

    #[derive(Args)]
    struct Short {
        #[arg(long, short)]
        quick: bool,
        #[arg(long = "depth", id = "engines")]
        depth: usize,
        #[arg(long = "help")]
        aid: bool,
    }

    #[derive(Args)]
    struct RunArguments {
        #[arg(long)]
        grain: usize,
    }

    #[derive(Args)]
    struct Field {
        #[arg(long = "grain")]
        every: usize,
    }

    #[derive(Args)]
    struct Bare {
        grain: usize,
    }

    #[derive(Args)]
    struct Fine {
        #[arg(long, short, alias = "corn", required = true)]
        grain: usize,
    }

    fn said(options: fn(Command) -> Command) -> String {
        check(&definition(options)).unwrap_err().to_string()
    }

    #[test]
    fn names_that_are_taken_are_told_with_who_takes_them() {
        let text = said(Layered::augment_args);
        assert!(text.contains("options: `--layer` (of render, watch); rename"), "{text}");
        let text = said(Short::augment_args);
        assert!(text.contains("`-q` (of run, render, compare, sweep)"), "{text}");
        assert!(text.contains("`--help` (of run, render, watch, list, compare, sweep)"), "{text}");
        assert!(said(Field::augment_args).contains("the field `every` (of run, render, watch)"));
        assert!(said(RunArguments::augment_args).contains("the struct `RunArguments` (of run)"));
        assert!(said(Bare::augment_args).contains("`grain` has no `--` before its name"));
        check(&definition(Fine::augment_args)).unwrap();
        check(&definition(std::convert::identity)).unwrap();
    }

    #[test]
    fn they_are_found_whatever_is_asked_for() {
        let definition = definition(Layered::augment_args);
        for words in
            [&["--help"][..], &[], &["run", "--size", "3"], &["inspect", "out"], &["render", "--layer", "1"]]
        {
            let words: Vec<OsString> = ["rock"].iter().chain(words).map(OsString::from).collect();
            let Err(Unable::Refused(error)) = parse::invocation(&definition, &words) else {
                panic!("{words:?}")
            };
            assert!(error.to_string().contains("`--layer` (of render, watch)"), "{error}");
        }
    }

    #[derive(Debug)]
    struct Loud;

    impl EngineKind for Loud {
        fn name(&self) -> &'static str {
            "loud"
        }

        fn about(&self) -> &'static str {
            "has an option of the frame"
        }

        fn options(&self) -> &'static [EngineOption] {
            &[EngineOption { name: "quiet", value_name: "N", about: "How", check: |_| Ok(()) }]
        }

        fn make(&self, _options: &EngineOptions) -> Result<Box<dyn Engine>, Failure> {
            Err("never made".into())
        }
    }

    #[test]
    fn an_engine_has_no_option_of_the_frame() {
        let engines = Engines::default().with(Loud);
        let error = check(&Definition { engines: &engines, ..definition(std::convert::identity) });
        let text = error.unwrap_err().to_string();
        assert!(text.starts_with("the loud engine's own option `--quiet` has a name that"), "{text}");
        assert!(text.contains("(of run, resume, render, compare, sweep, new)"), "{text}");
    }
}
