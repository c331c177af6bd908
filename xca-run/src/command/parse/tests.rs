use super::*;
use crate::command::voice::Voice;
use crate::engines::EngineOptions;
use clap::{Args, FromArgMatches};
use std::fs;
use std::path::Path;
use xca_core::Precision;

/// The options of some model.
#[derive(clap::Args)]
struct Forest {
    /// Cells along each side
    #[arg(long, default_value_t = 200)]
    size: usize,
    #[arg(long)]
    name: Option<String>,
    #[arg(long)]
    wet: bool,
    #[arg(long)]
    tree: Vec<String>,
}

fn definition() -> &'static Definition<'static> {
    Box::leak(Box::new(Definition {
        name: "forest",
        about: "A fire in a forest",
        version: "1.2.3",
        examples: "--size 10\n--wet",
        options: Forest::augment_args,
        set_up: &|_, _| Err(Unable::refused("not here")),
        engines: Box::leak(Box::default()),
    }))
}

fn parsed(words: &[&str]) -> Result<RunInvocation<'static>, Unable> {
    let arguments: Vec<OsString> = ["forest", "run"].iter().chain(words).map(OsString::from).collect();
    match invocation(definition(), &arguments)? {
        Invocation::Run(run) => Ok(*run),
        _ => panic!("this is no run"),
    }
}

fn message(words: &[&str]) -> String {
    match parsed(words) {
        Err(Unable::CommandLine(error)) => error.to_string(),
        Err(
            Unable::Refused(error)
            | Unable::RefusedOffering(error, _)
            | Unable::Failed(error)
            | Unable::FailedLeaving(error, _),
        ) => error.to_string(),
        Ok(_) => "no error".to_owned(),
    }
}

/// The program of the options of a struct.
fn forest(invocation: &RunInvocation<'_>) -> Forest {
    Forest::from_arg_matches(&invocation.model.matches).unwrap()
}

#[test]
fn the_definition_of_the_command_is_sound() {
    command(definition()).debug_assert();
}

#[test]
fn what_is_not_given_has_a_default() {
    let invocation = parsed(&[]).unwrap();
    let given = invocation.model.arguments.given(None);
    assert_eq!((given.seed, given.precision, given.parameters.len()), (1, Precision::F64, 0));
    assert_eq!(invocation.engine.name, "cpu");
    assert_eq!(invocation.engine.options, EngineOptions::default());
    assert_eq!(invocation.run.every, None);
    assert_eq!(invocation.run.voice, Voice::default());
    assert_eq!(forest(&invocation).size, 200);
    let options = serde_json::to_string(&invocation.model.options).unwrap();
    assert_eq!(options, r#"{"name":null,"size":200,"tree":[],"wet":false}"#);
}

#[test]
fn options_are_told_as_what_they_are() {
    let words = [
        "--size",
        "7",
        "--name",
        "8 a",
        "--wet",
        "--tree",
        "oak",
        "--tree",
        "fir",
        "--set",
        "a=1",
        "--set=b=2",
    ];
    let invocation = parsed(&words).unwrap();
    let options = serde_json::to_string(&invocation.model.options).unwrap();
    assert_eq!(options, r#"{"name":"8 a","size":7,"tree":["oak","fir"],"wet":true}"#);
    let set: Vec<String> =
        invocation.model.arguments.given(None).parameters.iter().map(ToString::to_string).collect();
    assert_eq!(set, ["a=1", "b=2"]);
}

#[test]
fn wrong_values_are_named() {
    assert!(message(&["--threads", "0"]).contains("the number of threads must be at least 1"));
    assert!(message(&["--threads", "99999"]).contains("the maximum is 1024"));
    assert!(
        message(&["--steps", "-1"])
            .contains("'-1' for '--steps <N>': the number of steps must be a whole number")
    );
    assert!(message(&["--every=0"]).contains("the interval must be at least 1 step"));
    assert!(message(&["--precision", "f16"]).contains("use f32 or f64"));
    assert!(
        message(&["--engine", "abacus"])
            .contains("unknown engine `abacus`; there are cpu[:N], gpu[:N|NAME], ")
    );
    assert!(message(&["--set", "alpha"]).contains("write NAME=VALUE"));
    assert!(message(&["--siez", "3"]).contains("unexpected argument '--siez'"));
}

fn config(text: &str) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.toml");
    fs::write(&path, text).unwrap();
    let path = path.to_str().unwrap().to_owned();
    (folder, path)
}

fn with_config(text: &str, words: &[&str]) -> Result<RunInvocation<'static>, Unable> {
    let (_folder, path) = config(text);
    let words: Vec<&str> = words.iter().copied().chain(["--config", &path]).collect();
    parsed(&words)
}

#[test]
fn a_file_gives_options_and_the_command_line_wins() {
    let text = r#"
        size = 50
        wet = true
        quiet = false
        tree = ["oak", "fir"]
        threads = 2
        engine = "cpu"
        seed = 9
        [set]
        alpha = 0.25
        wind = [1, -2.5]
    "#;
    let invocation = with_config(text, &["--seed", "4", "--set", "alpha=0.5"]).unwrap();
    let forest = forest(&invocation);
    assert_eq!((forest.size, forest.wet, forest.tree.len()), (50, true, 2));
    assert_eq!(invocation.engine.options.get("threads"), Some("2"));
    assert_eq!(invocation.run.voice, Voice::default());
    let given = invocation.model.arguments.given(None);
    assert_eq!(given.seed, 4);
    let set: Vec<String> = given.parameters.iter().map(ToString::to_string).collect();
    assert_eq!(set, ["alpha=0.25", "wind=1,-2.5", "alpha=0.5"]);
    // A list on the command line takes the place of the file's.
    let invocation = with_config(text, &["--tree", "elm"]).unwrap();
    assert_eq!(invocation.model.options["tree"], serde_json::json!(["elm"]));
}

#[test]
fn mistakes_in_a_file_name_it() {
    let said = |text: &str| match with_config(text, &[]) {
        Err(Unable::Refused(error)) => {
            let text = error.to_string();
            text[text.find("run.toml").unwrap()..].to_owned()
        }
        _ => "no such error".to_owned(),
    };
    let unknown = said("siez = 3");
    assert!(
        unknown.starts_with("run.toml: unknown key `siez`; there are size, name, wet, tree, precision"),
        "{unknown}"
    );
    assert!(said("config = 'x'").contains("unknown key `config`"));
    assert!(said("help = true").contains("unknown key `help`"));
    assert_eq!(
        said("size = 'x'"),
        "run.toml: invalid value 'x' for '--size <SIZE>': invalid digit found in string"
    );
    assert!(said("threads = 0").contains("the number of threads must be at least 1"));
    assert_eq!(said("size = [1]"), "run.toml: the value of `size` must be a string or a number");
    assert_eq!(said("wet = 1"), "run.toml: the value of `wet` must be true or false");
    assert!(said("set = 3").contains("must be a table with a line `name = value`"));
    assert!(said("[set]\na = {}").contains("must be a table with a line `name = value`"));
    assert!(said("size = 1\n\nwet =").starts_with("run.toml:3: "), "{}", said("size = 1\n\nwet ="));
    assert!(said("size = 1\nsize = 2").starts_with("run.toml:2: "), "{}", said("size = 1\nsize = 2"));
    assert!(
        message(&["--config", "/nowhere/run.toml"])
            .contains("cannot read the configuration /nowhere/run.toml")
    );
}

#[test]
fn mistakes_on_the_command_line_come_first() {
    let (_folder, path) = config("siez = 3");
    assert!(Path::new(&path).exists());
    assert!(message(&["--config", &path, "--threads", "0"]).contains("the number of threads"));
}

#[test]
fn the_help_tells_options_examples_and_exit_codes() {
    let help = message(&["--help"]);
    for text in ["Options of this model", "--size", "--engine", "forest run --wet", "130  interrupted"] {
        assert!(help.contains(text), "{text}: {help}");
    }
    // Not the description of the struct of options.
    assert!(help.starts_with(run::ABOUT), "{help}");
}
