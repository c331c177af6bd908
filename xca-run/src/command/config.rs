//! Options from a file: each key of the TOML table is an option of the command line.

use clap::parser::ValueSource;
use clap::{ArgAction, ArgMatches, Command};
use std::ffi::OsString;
use std::io;
use std::path::{Path, PathBuf};
use toml::{Table, Value};
use xca_io::regular_file;

/// The option whose table of values adds to the command line's instead of being replaced by it.
const SET: &str = "set";

/// No configuration has more bytes.
const LONGEST: u64 = 16 << 20;

/// A configuration file that cannot be used.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages explain the fields")]
#[non_exhaustive]
pub enum ConfigError {
    #[error("cannot read the configuration {}", path.display())]
    Read { path: PathBuf, source: io::Error },
    #[error("{}:{line}: {message}", path.display())]
    Syntax { path: PathBuf, line: usize, message: String },
    #[error("{}: unknown key `{key}`; there are {known}, and parameters of the model below [set]", path.display())]
    UnknownKey { path: PathBuf, key: String, known: String },
    #[error("{}: the value of `{key}` must be {wanted}", path.display())]
    Type { path: PathBuf, key: String, wanted: &'static str },
    #[error("{}: {message}", path.display())]
    Value { path: PathBuf, message: String },
}

/// The options of a configuration file as arguments for `command`, which has been given `matches` already:
/// what stands on the command line is left out.
pub(super) fn arguments(
    path: &Path,
    command: &Command,
    matches: &ArgMatches,
) -> Result<Vec<OsString>, ConfigError> {
    let mut all = Vec::new();
    for (key, value) in read(path)? {
        let option = command
            .get_arguments()
            .find(|option| option.get_long() == Some(&key) && is_allowed(&key))
            .ok_or_else(|| ConfigError::UnknownKey {
                path: path.to_owned(),
                key: key.clone(),
                known: known(command),
            })?;
        let texts = match option.get_action() {
            ArgAction::SetTrue => {
                flag(&value).map(|on| if on { vec![format!("--{key}")] } else { Vec::new() })
            }
            ArgAction::Append if key == SET => assignments(&value),
            ArgAction::Append => list(&key, &value),
            _ => single(&value).map(|text| vec![format!("--{key}={text}")]),
        };
        let texts =
            texts.map_err(|wanted| ConfigError::Type { path: path.to_owned(), key: key.clone(), wanted })?;
        check(path, command, &texts)?;
        let on_command_line =
            matches.value_source(option.get_id().as_str()) == Some(ValueSource::CommandLine);
        if !on_command_line || key == SET {
            all.extend(texts.into_iter().map(OsString::from));
        }
    }
    Ok(all)
}

fn is_allowed(key: &str) -> bool {
    !["config", "help", "version"].contains(&key)
}

fn known(command: &Command) -> String {
    let names: Vec<&str> =
        command.get_arguments().filter_map(clap::Arg::get_long).filter(|name| is_allowed(name)).collect();
    names.join(", ")
}

fn read(path: &Path) -> Result<Table, ConfigError> {
    let failed = |source| ConfigError::Read { path: path.to_owned(), source };
    let no_text = |_| failed(io::Error::new(io::ErrorKind::InvalidData, "it is not UTF-8 text"));
    let text = String::from_utf8(regular_file::read(path, LONGEST).map_err(failed)?).map_err(no_text)?;
    text.parse().map_err(|error: toml::de::Error| {
        let before = error.span().map_or(0, |span| span.start.min(text.len()));
        let line = 1 + text.as_bytes()[..before].iter().filter(|&&byte| byte == b'\n').count();
        ConfigError::Syntax { path: path.to_owned(), line, message: error.message().to_owned() }
    })
}

type Texts<T> = Result<T, &'static str>;

fn single(value: &Value) -> Texts<String> {
    match value {
        Value::String(text) => Ok(text.clone()),
        Value::Integer(number) => Ok(number.to_string()),
        Value::Float(number) => Ok(number.to_string()),
        Value::Boolean(value) => Ok(value.to_string()),
        _ => Err("a string or a number"),
    }
}

fn flag(value: &Value) -> Texts<bool> {
    value.as_bool().ok_or("true or false")
}

fn list(key: &str, value: &Value) -> Texts<Vec<String>> {
    let wanted = "a string, a number, or a list of these";
    let values = value.as_array().map_or_else(|| vec![value], |values| values.iter().collect());
    values.into_iter().map(|value| Ok(format!("--{key}={}", single(value).map_err(|_| wanted)?))).collect()
}

/// `[set]` with a line for each parameter; a vector or an array is a list, an array of vectors a list of
/// lists.
fn assignments(value: &Value) -> Texts<Vec<String>> {
    let wanted = "a table with a line `name = value` for each parameter";
    let table = value.as_table().ok_or(wanted)?;
    let assignment = |(name, value)| {
        let components = components(value).map_err(|_| wanted)?;
        Ok(format!("--{SET}={name}={}", components.join(",")))
    };
    table.iter().map(assignment).collect()
}

fn components(value: &Value) -> Texts<Vec<String>> {
    match value {
        Value::Array(values) => Ok(values.iter().map(components).collect::<Result<Vec<_>, _>>()?.concat()),
        value => Ok(vec![single(value)?]),
    }
}

/// Lets the command check the options of one key, so that an error can name the file.
fn check(path: &Path, command: &Command, texts: &[String]) -> Result<(), ConfigError> {
    use clap::error::ErrorKind;
    let arguments = std::iter::once("run").chain(texts.iter().map(String::as_str));
    match command.clone().no_binary_name(false).try_get_matches_from(arguments) {
        // Others may give what is missing.
        Err(error) if error.kind() != ErrorKind::MissingRequiredArgument => {
            let text = error.to_string();
            let first = text.split("\n\n").next().unwrap_or_default();
            let message =
                first.trim_start_matches("error: ").split_whitespace().collect::<Vec<_>>().join(" ");
            Err(ConfigError::Value { path: path.to_owned(), message })
        }
        _ => Ok(()),
    }
}
