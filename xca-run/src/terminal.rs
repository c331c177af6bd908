//! The only place where the frame prints.
//!
//! Results go to stdout and are left out by `--quiet`; errors and what happens meanwhile go to stderr. A
//! result that is lost, as on a full disk, is an error; that no one listens any more, as after `| head`, is
//! none.
//!
//! What is printed may come from files of anyone: characters that control terminals are escaped, and errors
//! are cut to what one can read.

mod plain;

pub(crate) use plain::short_lines;

use plain::{escaped, shortened};
use std::io::{self, Write};

/// Stdout cannot be written to.
#[derive(Debug, thiserror::Error)]
#[error("cannot write to standard output; its text is lost")]
pub(crate) struct Unsaid(#[source] io::Error);

/// A line of the results.
pub(crate) fn say(text: &str) -> Result<(), Unsaid> {
    let mut out = io::stdout().lock();
    heard(writeln!(out, "{}", escaped(text)).and_then(|()| out.flush()))
}

/// The help that was asked for, or what is wrong with a command line.
pub(crate) fn show(message: &clap::Error) -> Result<(), Unsaid> {
    heard(message.print().and_then(|()| io::stdout().flush()))
}

fn heard(result: io::Result<()>) -> Result<(), Unsaid> {
    match result {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Unsaid(error)),
        _ => Ok(()),
    }
}

/// A line of what happens meanwhile.
pub(crate) fn remark(text: &str) {
    // There is no other place to tell that it is lost.
    let _ = writeln!(io::stderr().lock(), "{}", shortened(&escaped(text)));
}

/// An error, and below it what caused it.
pub(crate) fn complain(error: &(dyn std::error::Error + 'static)) {
    let mut said = error.to_string();
    remark(&format!("error: {said}"));
    let mut cause = error.source();
    while let Some(error) = cause {
        let text = error.to_string();
        // Some errors tell their cause themselves.
        if !said.contains(&text) {
            remark(&format!("caused by: {text}"));
            said = text;
        }
        cause = error.source();
    }
}
