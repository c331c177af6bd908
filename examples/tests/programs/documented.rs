//! The commands of the documents have subcommands and options that the programs know.

use crate::running::CADEM;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A line of a document that runs a program of the examples.
struct Documented {
    document: PathBuf,
    program: String,
    words: Vec<String>,
}

impl Documented {
    /// Of all documents.
    fn all() -> Vec<Self> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let folders = [root.clone(), root.join("docs")];
        let files = folders.iter().flat_map(|folder| fs::read_dir(folder).unwrap());
        let paths = files.map(|entry| entry.unwrap().path());
        let documents = paths.filter(|path| path.extension().is_some_and(|extension| extension == "md"));
        documents.flat_map(|document| Self::of(&document)).collect()
    }

    fn of(document: &Path) -> Vec<Self> {
        let text = fs::read_to_string(document).unwrap().replace("\\\n", " ");
        let commands = text.lines().filter_map(|line| {
            let (program, words) = line.strip_prefix("cargo run --release --bin ")?.split_once(" -- ")?;
            let words = words.split(" #").next()?.split_whitespace().map(str::to_owned);
            Some(Self { document: document.to_owned(), program: program.to_owned(), words: words.collect() })
        });
        commands.collect()
    }

    fn options(&self) -> impl Iterator<Item = &str> {
        let options = self.words.iter().filter(|word| word.starts_with("--"));
        options.map(|word| word.split('=').next().unwrap_or(word))
    }
}

/// The options that the help of a subcommand shows.
fn known(program: &str, subcommand: &str) -> BTreeSet<String> {
    let output = Command::new(Path::new(CADEM).with_file_name(program))
        .args([subcommand, "--help"])
        .output()
        .unwrap_or_else(|error| panic!("{program}: {error}"));
    assert!(output.status.success(), "{program} has no {subcommand}");
    let help = String::from_utf8(output.stdout).unwrap();
    let words = help.split(|sign: char| !sign.is_alphanumeric() && sign != '-' && sign != '_');
    words.filter(|word| word.starts_with("--")).map(str::to_owned).collect()
}

#[test]
fn commands_have_options_that_programs_know() {
    let mut helps: BTreeMap<[String; 2], BTreeSet<String>> = BTreeMap::new();
    let mut options = 0;
    for command in Documented::all() {
        let (program, subcommand) = (&command.program, &command.words[0]);
        let help =
            helps.entry([program.clone(), subcommand.clone()]).or_insert_with(|| known(program, subcommand));
        for option in command.options() {
            let place = command.document.display();
            assert!(help.contains(option), "{place}: `{program} {subcommand}` has no {option}");
            options += 1;
        }
    }
    assert!(options > 50 && helps.len() > 20, "{options} {}", helps.len());
}
