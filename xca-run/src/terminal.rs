//! The only place where the frame prints.
//!
//! Results go to stdout and are left out by `--quiet`; errors and what happens meanwhile go to stderr. That no one listens any more, as
//! after `| head`, is no error.

#[cfg(feature = "terminal")]
mod full_screen;

#[cfg(feature = "terminal")]
pub(crate) use full_screen::{FullScreen, give_back};

use std::io::{self, Write};

/// A line of the results.
pub(crate) fn say(text: &str) {
    let _ = writeln!(io::stdout().lock(), "{text}");
}

/// A line of what happens meanwhile.
pub(crate) fn remark(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{text}");
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
