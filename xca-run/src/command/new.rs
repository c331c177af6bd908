//! The subcommand `new`.

use super::parse::with_help;
use super::voice::Voice;
use super::{Definition, Ended, Unable};
use clap::{Args, Command};
use serde_json::json;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

pub(super) const NAME: &str = "new";

const ABOUT: &str = "Write a new crate: a small model, its program, and a test that runs it on all engines";

/// The files of the crate, and what is in them. The crate `tests/new` of this workspace is built of the same ones, and tests them.
const FILES: [(&str, &str); 6] = [
    ("Cargo.toml", include_str!("new/Cargo.toml.template")),
    ("README.md", include_str!("new/README.md.template")),
    (".gitignore", "/target\n/out\n"),
    ("src/lib.rs", include_str!("new/lib.rs")),
    ("src/main.rs", include_str!("new/main.rs")),
    ("tests/engines.rs", include_str!("new/engines.rs")),
];

/// Where this workspace was when the program was compiled.
const WORKSPACE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

/// What is made.
#[derive(Args, Debug, Clone)]
pub(super) struct NewArguments {
    /// The name of the crate, and of the folder that is made for it here
    #[arg(value_name = "NAME", value_parser = crate_name)]
    name: String,

    /// The folder of xca that the crate depends on; the one that this program was compiled from, or else the published version, unless it
    /// is given
    #[arg(long, value_name = "DIR")]
    xca: Option<PathBuf>,

    #[command(flatten)]
    voice: Voice,
}

pub(super) fn command(definition: &Definition<'_>) -> Command {
    let name = definition.name;
    let examples = [format!("{name} new waves"), format!("{name} new waves --xca ../xca")];
    with_help(NewArguments::augment_args(Command::new(NAME)), ABOUT, &examples)
}

/// A folder that a crate cannot be written to, or depend on.
#[derive(Debug, thiserror::Error)]
enum NewError {
    #[error("{} is there already; give another name, or move it away", .0.display())]
    Exists(PathBuf),
    #[error("{} is not the folder of xca: it has no xca-core and xca-run in it", .0.display())]
    NotXca(PathBuf),
    #[error("cannot write {}", path.display())]
    Write { path: PathBuf, source: io::Error },
}

/// Writes the crate.
pub(super) fn new(arguments: &NewArguments) -> Result<Ended, Unable> {
    let folder = PathBuf::from(&arguments.name);
    let xca = match &arguments.xca {
        Some(given) => {
            Some(workspace(given).ok_or_else(|| Unable::refused(NewError::NotXca(given.clone())))?)
        }
        None => workspace(Path::new(WORKSPACE)),
    };
    if folder.symlink_metadata().is_ok() {
        return Err(Unable::refused(NewError::Exists(folder)));
    }
    for (file, template) in FILES {
        let path = folder.join(file);
        let write = || -> io::Result<()> {
            if let Some(parent) = path.parent() {
                fs::create_dir_all(parent)?;
            }
            fs::write(&path, filled(template, &arguments.name, xca.as_deref()))
        };
        write().map_err(|source| Unable::failed(NewError::Write { path: path.clone(), source }))?;
    }
    let name = &arguments.name;
    let files: Vec<PathBuf> = FILES.iter().map(|(file, _)| folder.join(file)).collect();
    let text = || {
        format!(
            "{name}/src/lib.rs has a small model to begin with; try\n  cd {name}\n  cargo test\n  cargo run --release -- run"
        )
    };
    arguments.voice.tell(&json!({ "crate": name, "files": files }), text)?;
    Ok(Ended::Done)
}

/// The whole path of a folder that has the crates of xca in it.
fn workspace(folder: &Path) -> Option<PathBuf> {
    let is_crate = |name: &str| folder.join(name).join("Cargo.toml").is_file();
    (is_crate("xca-core") && is_crate("xca-run")).then(|| folder.canonicalize().ok()).flatten()
}

/// A file of the crate.
fn filled(template: &str, name: &str, xca: Option<&Path>) -> String {
    let dependency = |of: &str| match xca {
        // A literal of TOML, in which nothing is an escape; a path that has the quote itself needs the other kind.
        Some(xca) => format!("path = {}", toml::Value::String(xca.join(of).display().to_string())),
        None => format!("version = \"{}\"", env!("CARGO_PKG_VERSION")),
    };
    // The path comes last: it may have the words in it that a name stands for; and of the names that without hyphens comes first.
    template
        .replace("new_model", &name.replace('-', "_"))
        .replace("new-model", name)
        .replace("{xca-core}", &dependency("xca-core"))
        .replace("{xca-run}", &dependency("xca-run"))
}

/// Words that no crate can be named by: those of Rust, and crates that this one needs.
const RESERVED: &str = "abstract as async await become box break const continue crate do dyn else enum extern \
    false final fn for gen if impl in let loop macro match mod move mut override priv pub ref return self static struct \
    super trait true try type typeof unsafe unsized use virtual where while yield \
    alloc core proc-macro std test xca-core xca-run";

fn crate_name(text: &str) -> Result<String, &'static str> {
    let is_name = text.starts_with(|first: char| first.is_ascii_lowercase())
        && text
            .bytes()
            .all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit() || b"-_".contains(&byte));
    if !is_name || text.len() > 64 {
        return Err(
            "it must be the name of a crate: small letters, digits, `-` and `_`, a letter first, such as waves",
        );
    }
    if RESERVED.split_whitespace().any(|word| word.replace('-', "_") == text.replace('-', "_")) {
        return Err("that word has a meaning of its own to Rust or to xca; take another, such as waves");
    }
    Ok(text.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_crates() {
        for name in ["waves", "w", "excitable-medium_2"] {
            assert_eq!(crate_name(name).as_deref(), Ok(name));
        }
        for name in
            ["", "2d", "-x", "Waves", "a b", "a/b", "..", "wåves", "fn", "self", "test", "xca_core", "core"]
        {
            assert!(crate_name(name).is_err(), "{name}");
        }
    }

    #[test]
    fn templates_are_filled_to_the_last_word() {
        for xca in [None, Some(Path::new("/home/o'hara/\"xca\" 1"))] {
            for (file, template) in FILES {
                let text = filled(template, "my-waves", xca);
                for word in ["new-model", "new_model", "{xca-core}", "{xca-run}"] {
                    assert!(!text.contains(word), "{file} has {word}");
                }
            }
            let manifest: toml::Table = filled(FILES[0].1, "my-waves", xca).parse().unwrap();
            let of_core = &manifest["dependencies"]["xca-core"];
            match xca {
                Some(xca) => assert_eq!(of_core["path"].as_str(), xca.join("xca-core").to_str()),
                None => assert_eq!(of_core["version"].as_str(), Some(env!("CARGO_PKG_VERSION"))),
            }
        }
        // Names that have the word in them that they replace.
        let text = filled("new-model new_model", "a-new_model-b", None);
        assert_eq!(text, "a-new_model-b a_new_model_b");
        let text = filled(FILES[0].1, "waves", Some(Path::new("/home/new-model/xca")));
        assert!(text.contains("/home/new-model/xca/xca-core"), "{text}");
    }
}
