//! Every command of the book is run as a page writes it, only shorter; or it is listed, with what checks it
//! instead. A page is README.md or one of docs/SUMMARY.md.
#![cfg(unix)]

mod before;
mod command;
mod elsewhere;
mod inputs;
mod pages;
mod short;

use crate::running::{CADEM, Workplace};
use crate::watched::assert_watched;
use before::BEFORE;
use command::{Command, Invocation};
use elsewhere::ELSEWHERE;
use short::{SHORT, Short};
use std::path::Path;
use std::process::{self, Output};

pub(crate) use command::Start;
pub(crate) use pages::Page;

/// What is done for a command of a page.
pub(crate) struct Run {
    /// What the page says, what is run, and why that is not the same.
    title: String,
    pub(crate) program: String,
    pub(crate) words: Vec<String>,
}

impl Run {
    /// Writes the files that a command names, and does what it takes for granted.
    pub(crate) fn prepare(place: &Workplace, command: &Command, invocation: &Invocation) -> Self {
        inputs::write(place, &command.text);
        for before in BEFORE.iter().filter(|before| before.is_before(command)) {
            place.succeed(&path(before.program), before.options);
        }
        let mut invocation = invocation.clone();
        let mut title = command.to_string();
        if let Some(short) = Short::of(&invocation) {
            short.apply(&mut invocation);
            title = format!("{title}, as `{invocation}`, because {}", short.reason);
        }
        let Invocation { program, mut words } = invocation;
        if let [subcommand, folder, ..] = &words[..]
            && subcommand == "resume"
            && !words.iter().any(|word| word == "--steps")
        {
            before::leave_as_killed(&place.path(folder));
        }
        if words[0] == "new" {
            // A reader is in the folder of xca, in which the program finds it.
            words.extend(["--xca-path".to_owned(), command::root().to_str().unwrap().to_owned()]);
        }
        Self { title, program: path(&program), words }
    }

    /// What is wrong with the end of the command.
    pub(crate) fn fault(&self, output: &Output) -> Option<String> {
        fault(&self.title, output)
    }
}

/// The built program.
fn path(program: &str) -> String {
    Path::new(CADEM).with_file_name(program).to_str().unwrap().to_owned()
}

fn fault(title: &str, output: &Output) -> Option<String> {
    let said = String::from_utf8_lossy(&output.stderr);
    (!output.status.success()).then(|| format!("{title}: {}\n{said}", output.status))
}

#[test]
fn commands_of_the_book_can_be_run() {
    let (mut faults, mut count) = (Vec::new(), 0);
    let start = |mut started: process::Command| started.output().unwrap();
    for page in Page::all() {
        let place = Workplace::new();
        for command in &page.commands {
            match &command.start {
                Start::Program(invocation) => {
                    let run = Run::prepare(&place, command, invocation);
                    if run.words[0] == "watch" {
                        assert_watched(&place, &run.program, &run.words[1..].join(" "));
                    } else {
                        let mut started = place.invocation(&run.program, "");
                        started.args(&run.words);
                        faults.extend(run.fault(&start(started)));
                    }
                }
                Start::Shell => {
                    inputs::write(&place, &command.text);
                    let mut started = place.invocation("sh", "-c");
                    started.arg(&command.text);
                    faults.extend(fault(&command.to_string(), &start(started)));
                }
                Start::Mpi(..) | Start::Other => continue,
            }
            count += 1;
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(count > 50, "{count}");
}

/// A new command is either run or has to be listed; what no page has any more must not stay in a list.
#[test]
fn lists_are_those_of_the_pages() {
    let pages = Page::all();
    let commands: Vec<&Command> = pages.iter().flat_map(|page| &page.commands).collect();
    let others: Vec<_> = commands.iter().filter(|command| matches!(command.start, Start::Other)).collect();
    let mut wrong = Vec::new();
    for command in &others {
        if !ELSEWHERE.iter().any(|elsewhere| elsewhere.command == command.text) {
            wrong.push(format!("{command} is not run, and not listed in book/elsewhere.rs"));
        }
    }
    for command in &commands {
        if let Start::Mpi(words, _) = &command.start
            && words.first().is_none_or(|word| word != "-n")
        {
            wrong.push(format!("{command}: `-n` and the number of ranks come first"));
        }
    }
    for elsewhere in ELSEWHERE {
        let title = format!("book/elsewhere.rs, `{}` ({})", elsewhere.command, elsewhere.why);
        if !others.iter().any(|command| command.text == elsewhere.command) {
            wrong.push(format!("{title}: no page has this command"));
        }
        if let Some(file) = elsewhere.checked_by
            && !command::root().join(file).is_file()
        {
            wrong.push(format!("{title}: there is no {file}"));
        }
    }
    for short in SHORT {
        let mut all = commands.iter().filter_map(|command| command.invocation());
        if !all.any(|invocation| Short::of(invocation).is_some_and(|found| found.words == short.words)) {
            wrong.push(format!("book/short.rs: no command begins with `{}`", short.words));
        }
    }
    for before in BEFORE {
        if !commands.iter().any(|command| before.is_before(command)) {
            wrong.push(format!("book/before.rs: {} has no `{}`", before.page, before.command));
        }
    }
    for name in inputs::names() {
        if !commands.iter().any(|command| inputs::is_named(name, &command.text)) {
            wrong.push(format!("book/inputs.rs: no command names {name}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
