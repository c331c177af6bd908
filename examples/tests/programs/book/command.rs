//! A command of a page: which program it starts, with which words.

use std::fmt;
use std::path::{Path, PathBuf};

/// Programs that commands in running text begin with, beside those of the gallery.
const TOOLS: [&str; 7] = ["apt", "apt-get", "bash", "cargo", "mpirun", "srun", "sudo"];

/// The root of the workspace.
pub(super) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// What a command starts.
pub(crate) enum Start {
    /// A program of the gallery.
    Program(Invocation),
    /// A program of the gallery, by `mpirun` with these words.
    Mpi(Vec<String>, Invocation),
    /// A line for the shell.
    Shell,
    /// Something that this test does not start: see `elsewhere`.
    Other,
}

/// A program of the gallery with its words, the first of which is a subcommand.
#[derive(Clone)]
pub(crate) struct Invocation {
    pub(crate) program: String,
    pub(crate) words: Vec<String>,
}

impl fmt::Display for Invocation {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{} {}", self.program, self.words.join(" "))
    }
}

/// A command, and where it stands.
pub(crate) struct Command {
    pub(crate) page: String,
    pub(crate) line: usize,
    pub(crate) text: String,
    pub(crate) start: Start,
}

impl fmt::Display for Command {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}:{}: `{}`", self.page, self.line, self.text)
    }
}

impl Command {
    pub(super) fn read(page: &str, line: usize, text: &str) -> Self {
        let text = text.replace("\\|", "|");
        let start = Start::of(&text);
        Self { page: page.to_owned(), line, text, start }
    }

    /// The program that is started, by whatever means.
    pub(crate) fn invocation(&self) -> Option<&Invocation> {
        match &self.start {
            Start::Program(invocation) | Start::Mpi(_, invocation) => Some(invocation),
            Start::Shell | Start::Other => None,
        }
    }
}

impl Start {
    fn of(text: &str) -> Self {
        if text.starts_with('(') {
            return Self::Shell;
        }
        let words = words(text);
        // The program that is named here, with the words from there on.
        let invocation = |named: usize, rest: usize| {
            let program = program(words.get(named)?)?.to_owned();
            let words = words.get(rest..).filter(|words| !words.is_empty())?.to_owned();
            Some(Invocation { program, words })
        };
        let found = match words.iter().map(String::as_str).collect::<Vec<_>>()[..] {
            ["cargo", "run", "--release", "--bin", _, "--", ..] => invocation(4, 6).map(Self::Program),
            ["mpirun", ..] => words
                .iter()
                .position(|word| program(word).is_some())
                .and_then(|place| Some(Self::Mpi(words[1..place].to_owned(), invocation(place, place + 1)?))),
            _ => invocation(0, 1).map(Self::Program),
        };
        found.unwrap_or(Self::Other)
    }
}

fn is_program(name: &str) -> bool {
    root().join(format!("examples/src/bin/{name}.rs")).is_file()
}

/// The program of the gallery that the first word of a command names.
fn program(word: &str) -> Option<&str> {
    let name = word.strip_prefix("target/release/").unwrap_or(word);
    is_program(name).then_some(name)
}

/// Whether code in running text is a whole command. `heat --size 256` names a model and its size, `run DIR`
/// a subcommand; an ellipsis stands for the rest of a command.
pub(super) fn is_command(text: &str) -> bool {
    const SUBCOMMANDS: [&str; 9] =
        ["compare", "inspect", "list", "new", "render", "resume", "run", "sweep", "watch"];
    let mut words = text.split_whitespace();
    let (Some(first), Some(second)) = (words.next(), words.next()) else { return false };
    let is_whole = TOOLS.contains(&first) || program(first).is_some() && SUBCOMMANDS.contains(&second);
    is_whole && !text.contains('…')
}

/// The words of a command, as a shell divides them.
fn words(text: &str) -> Vec<String> {
    let mut words = Vec::new();
    let mut word: Option<String> = None;
    let mut quote = None;
    for sign in text.chars() {
        match quote {
            Some(open) if sign == open => quote = None,
            None if ['\'', '"'].contains(&sign) => {
                quote = Some(sign);
                word.get_or_insert_default();
            }
            None if sign.is_whitespace() => words.extend(word.take()),
            _ => word.get_or_insert_default().push(sign),
        }
    }
    assert!(quote.is_none(), "a quote without its end: {text}");
    words.extend(word);
    words
}

#[test]
fn words_are_those_of_a_shell() {
    assert_eq!(
        words("life run  --set 'a=1|2 3' \"b c\"d ''"),
        ["life", "run", "--set", "a=1|2 3", "b cd", ""]
    );
}
