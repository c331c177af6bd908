//! The subcommand `new`.

mod crate_name;
mod source;

use super::definition::Definition;
use super::help::with_help;
use super::outcome::{Ended, Unable};
use super::voice::Voice;
use clap::{Args, Command};
use crate_name::crate_name;
use serde_json::json;
use source::Source;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

pub(super) const NAME: &str = "new";

const ABOUT: &str = "Generate a starter crate: a model, its program, and a test on all engines";

/// The files of the crate, and what is in them. The crate `tests/new` of this workspace is built of the same
/// ones, and tests them.
const FILES: [(&str, &str); 6] = [
    ("Cargo.toml", include_str!("new/Cargo.toml.template")),
    ("README.md", include_str!("new/README.md.template")),
    (".gitignore", "/target\n/out\n"),
    ("src/lib.rs", include_str!("new/lib.rs")),
    ("src/main.rs", include_str!("new/main.rs")),
    ("tests/engines.rs", include_str!("new/engines.rs")),
];

/// What is made.
#[derive(Args, Debug, Clone)]
pub(super) struct NewArguments {
    /// Name of the crate and of its new directory
    #[arg(value_name = "NAME", value_parser = crate_name)]
    name: String,

    /// Use the xca in this directory. Without --xca-path and --xca-git, the crate uses the same xca as the
    /// package around the current directory, or else as the package around this program
    #[arg(long, value_name = "PATH")]
    xca_path: Option<PathBuf>,

    /// Use the xca of this Git repository
    #[arg(long, value_name = "URL", conflicts_with = "xca_path")]
    xca_git: Option<String>,

    #[command(flatten)]
    voice: Voice,
}

pub(super) fn command(definition: &Definition<'_>) -> Command {
    let name = definition.name;
    let examples = [format!("{name} new waves"), format!("{name} new waves --xca-path ../xca")];
    with_help(NewArguments::augment_args(Command::new(NAME)), ABOUT, &examples)
}

/// A folder that a crate cannot be written to, or depend on.
#[derive(Debug, thiserror::Error)]
enum NewError {
    #[error("{} exists already; give another name, or move it", .0.display())]
    Exists(PathBuf),
    #[error("{} is not a folder of xca: it has no crate `xca`", .0.display())]
    NotXca(PathBuf),
    #[error(
        "no xca found around the current folder or this program; give its folder with --xca-path PATH, \
         or its git repository with --xca-git URL"
    )]
    NoSource,
    #[error("cannot write {}", path.display())]
    Write { path: PathBuf, source: io::Error },
}

/// Writes the crate.
pub(super) fn new(arguments: &NewArguments) -> Result<Ended, Unable> {
    let NewArguments { name, xca_path, xca_git, voice } = arguments;
    let source = source_of(xca_path.as_deref(), xca_git.as_deref(), source::found);
    let source = source.map_err(Unable::refused)?;
    let files = FILES.map(|(file, template)| (file, filled(template, name, &source)));
    let folder = PathBuf::from(name);
    write(&folder, &files).map_err(|error| match error {
        NewError::Write { .. } => Unable::failed(error),
        _ => Unable::refused(error),
    })?;
    let paths: Vec<PathBuf> = files.iter().map(|(file, _)| folder.join(file)).collect();
    let text = || {
        let source = source.text();
        format!(
            "{name}/src/lib.rs holds a small model, {name}/Cargo.toml depends on xca with {source}\n\
             next:\n  cd {name}\n  cargo test\n  cargo run --release -- run"
        )
    };
    voice.tell(&json!({ "crate": name, "xca": source.table(), "files": paths }), text)?;
    Ok(Ended::Done)
}

/// Where the crate gets xca from: as the options say, else as is found.
fn source_of(
    path: Option<&Path>,
    git: Option<&str>,
    found: impl FnOnce() -> Option<Source>,
) -> Result<Source, NewError> {
    match (path, git) {
        (Some(path), _) => Source::of_path(path).ok_or_else(|| NewError::NotXca(path.to_owned())),
        (None, Some(url)) => Ok(Source::of_git(url)),
        (None, None) => found().ok_or(NewError::NoSource),
    }
}

/// Writes files to a new folder; leaves nothing behind if one cannot be written.
fn write(folder: &Path, files: &[(&str, String)]) -> Result<(), NewError> {
    let wrong = |path: &Path, source| NewError::Write { path: path.to_owned(), source };
    fs::create_dir(folder).map_err(|error| match error.kind() {
        io::ErrorKind::AlreadyExists => NewError::Exists(folder.to_owned()),
        _ => wrong(folder, error),
    })?;
    let result = files.iter().try_for_each(|(file, text)| {
        let path = folder.join(file);
        let parent = path.parent().unwrap_or(folder);
        fs::create_dir_all(parent).and_then(|()| fs::write(&path, text)).map_err(|error| wrong(&path, error))
    });
    if result.is_err() {
        // The first error is the one to tell.
        let _ = fs::remove_dir_all(folder);
    }
    result
}

/// A file of the crate.
fn filled(template: &str, name: &str, source: &Source) -> String {
    // The source comes last: a path may hold the words that a name stands for. The name without hyphens comes
    // first, for the same reason.
    template
        .replace("new_model", &name.replace('-', "_"))
        .replace("new-model", name)
        .replace("{xca}", &source.text())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn templates_are_filled_to_the_last_word() {
        let git = "https://o'hara@example.org/\"xca\" 1\\new-model";
        for source in [Source::of_git("https://example.org/xca"), Source::of_git(git)] {
            for (file, template) in &FILES[1..] {
                let text = filled(template, "my-waves", &source);
                for word in ["new-model", "new_model", "{xca"] {
                    assert!(!text.contains(word), "{file} has {word}");
                }
            }
            let manifest: toml::Table = filled(FILES[0].1, "my-waves", &source).parse().unwrap();
            assert_eq!(manifest["package"]["name"].as_str(), Some("my-waves"));
            let mut dependency = manifest["dependencies"]["xca"].as_table().unwrap().clone();
            assert_eq!(dependency.remove("features"), Some(vec!["run"].into()));
            assert_eq!(&dependency, source.table());
        }
        // A name that has the word in it that it replaces.
        let text = filled("new-model new_model", "a-new_model-b", &Source::of_git(git));
        assert_eq!(text, "a-new_model-b a_new_model_b");
    }

    #[test]
    fn without_a_source_the_error_says_what_to_give() {
        let git = || Source::of_git("https://example.org/xca");
        assert_eq!(source_of(None, None, || Some(git())).unwrap(), git());
        let given = source_of(None, Some("https://example.org/xca"), || panic!("it was given"));
        assert_eq!(given.unwrap(), git());
        let place = tempfile::tempdir().unwrap();
        let error = source_of(Some(place.path()), None, || Some(git())).unwrap_err();
        assert!(matches!(error, NewError::NotXca(_)), "{error}");
        let error = source_of(None, None, || None).unwrap_err().to_string();
        assert!(error.contains("--xca-path PATH") && error.contains("--xca-git URL"), "{error}");
    }

    #[test]
    fn a_failure_leaves_nothing_behind() {
        let place = tempfile::tempdir().unwrap();
        let folder = place.path().join("waves");
        let files = [("src", String::new()), ("src/lib.rs", String::new())];
        let error = write(&folder, &files).unwrap_err();
        assert!(matches!(&error, NewError::Write { path, .. } if path.ends_with("src/lib.rs")), "{error}");
        assert!(!folder.exists());
        // What was there before stays.
        fs::create_dir(&folder).unwrap();
        fs::write(folder.join("mine"), "").unwrap();
        assert!(matches!(write(&folder, &files[..1]).unwrap_err(), NewError::Exists(_)));
        assert!(folder.join("mine").exists() && !folder.join("src").exists());
    }
}
