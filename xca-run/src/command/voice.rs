//! How a command tells what it has done: as text, as JSON, or not at all.

use super::outcome::Unable;
use crate::progress::Progress;
use crate::terminal;
use clap::Args;
use serde::Serialize;

/// What the command line says of that. Errors are always told, and always as text.
#[derive(Args, Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Voice {
    /// Say nothing but errors
    #[arg(long, short)]
    quiet: bool,

    /// Tell the result as JSON, and nothing else
    #[arg(long, conflicts_with = "quiet")]
    json: bool,
}

impl Voice {
    /// Says something on the way. That it is lost does not end a run, whose results are in its files.
    pub(super) fn say(self, text: &str) {
        if !self.quiet && !self.json {
            let _ = terminal::say(text);
        }
    }

    /// Tells the result.
    pub(super) fn tell(self, result: &impl Serialize, text: impl FnOnce() -> String) -> Result<(), Unable> {
        if self.json {
            let json = serde_json::to_string_pretty(result).map_err(Unable::failed)?;
            terminal::say(&json).map_err(Unable::failed)
        } else if !self.quiet {
            terminal::say(&text()).map_err(Unable::failed)
        } else {
            Ok(())
        }
    }

    /// The line that shows how many of so many things are done.
    pub(super) fn count(self, all: u64, things: &str) -> Progress {
        if self.quiet { Progress::hidden() } else { Progress::counting(all, things) }
    }

    /// The line that shows how far so many steps have come.
    pub(super) fn line(self, steps: Option<u64>) -> Progress {
        if self.quiet { Progress::hidden() } else { Progress::new(steps) }
    }
}
