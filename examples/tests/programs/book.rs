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
use crate::watched::is_watched;
use before::BEFORE;
pub(crate) use command::{Command, Invocation, Start};
use elsewhere::ELSEWHERE;
pub(crate) use pages::Page;
use short::{SHORT, Short};
use std::path::{Path, PathBuf};
use std::process;

/// Starts a command in the folder of its page, after what it takes for granted.
pub(crate) fn prepare(place: &Workplace, command: &Command) {
    inputs::write(place, &command.text);
    for before in BEFORE.iter().filter(|before| before.is_before(command)) {
        place.succeed(path(before.program).to_str().unwrap(), before.options);
    }
}

/// What is run for a command of a page.
pub(crate) fn shortened(invocation: &Invocation) -> Invocation {
    let mut invocation = invocation.clone();
    if let Some(short) = Short::of(&invocation) {
        short.apply(&mut invocation);
    }
    invocation
}

/// The built program.
pub(crate) fn path(program: &str) -> PathBuf {
    Path::new(CADEM).with_file_name(program)
}

/// Runs a command, which must end with success; gives what is wrong.
pub(crate) fn fault(mut started: process::Command, command: &Command, run: &str) -> Option<String> {
    let output = started.output().unwrap_or_else(|error| panic!("{command}: {error}"));
    let said = String::from_utf8_lossy(&output.stderr);
    (!output.status.success()).then(|| format!("{command}, run as `{run}`: {}\n{said}", output.status))
}

#[test]
fn commands_of_the_book_can_be_run() {
    let mut faults = Vec::new();
    let mut count = 0;
    for page in Page::all() {
        let place = Workplace::new();
        for command in &page.commands {
            let begin = std::time::Instant::now();
            let found = match &command.start {
                Start::Program(invocation) => {
                    prepare(&place, command);
                    let invocation = shortened(invocation);
                    let path = path(&invocation.program);
                    let program = path.to_str().unwrap();
                    if invocation.words[0] == "watch" {
                        is_watched(&place, program, &invocation.words[1..].join(" "));
                        None
                    } else {
                        let mut started = place.invocation(program, "");
                        started.args(&invocation.words);
                        fault(started, command, &invocation.to_string())
                    }
                }
                Start::Shell => {
                    prepare(&place, command);
                    let mut started = place.invocation("sh", "-c");
                    started.arg(&command.text);
                    fault(started, command, &command.text)
                }
                Start::Mpi(..) | Start::Other => continue,
            };
            eprintln!("TIME {:.2} {command}", begin.elapsed().as_secs_f64());
            count += 1;
            faults.extend(found);
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(count > 50, "{count}");
}

/// A new command is either run or has to be listed; what no page has any more is not listed.
#[test]
fn lists_are_those_of_the_pages() {
    let pages = Page::all();
    let commands: Vec<&Command> = pages.iter().flat_map(|page| &page.commands).collect();
    let mut wrong = Vec::new();
    for command in commands.iter().filter(|command| matches!(command.start, Start::Other)) {
        if !ELSEWHERE.iter().any(|elsewhere| elsewhere.command == command.text) {
            wrong.push(format!("{command} is not run, and not listed in book/elsewhere.rs"));
        }
    }
    for elsewhere in ELSEWHERE {
        let name = elsewhere.command;
        if !commands.iter().any(|command| matches!(command.start, Start::Other) && command.text == name) {
            wrong.push(format!("`{name}` of book/elsewhere.rs is on no page"));
        }
        if let Some(file) = elsewhere.checked_by
            && !pages::root().join(file).is_file()
        {
            wrong.push(format!("`{name}` is checked by {file}, which is not there"));
        }
    }
    for short in SHORT {
        let mut all = commands.iter().filter_map(|command| command.invocation());
        if !all.any(|invocation| Short::of(invocation).is_some_and(|found| found.words == short.words)) {
            wrong.push(format!("no command begins with `{}` of book/short.rs", short.words));
        }
    }
    for before in BEFORE {
        if !commands.iter().any(|command| before.is_before(command)) {
            wrong.push(format!("book/before.rs: no command for `{} {}`", before.program, before.options));
        }
    }
    for name in inputs::names() {
        if !commands.iter().any(|command| inputs::is_named(name, &command.text)) {
            wrong.push(format!("no command names {name} of book/inputs.rs"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
