//! How a command reports: as text, as JSON, or not at all.

use super::outcome::Unable;
use crate::progress::Progress;
use crate::terminal;
use clap::Args;
use serde::Serialize;

/// The options for it. Errors are always printed, and always as text.
#[derive(Args, Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Voice {
    /// Print errors and warnings only
    #[arg(long, short)]
    quiet: bool,

    /// Print the result as JSON, and nothing else
    #[arg(long, conflicts_with = "quiet")]
    json: bool,
}

impl Voice {
    /// Prints a remark during the work. A run goes on if the remark is lost: its results are in its files.
    pub(super) fn say(self, text: &str) {
        if !self.quiet && !self.json {
            let _ = terminal::say(text);
        }
    }

    /// Prints the result.
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

    /// The progress line of a number of things.
    pub(super) fn count(self, all: u64, things: &str) -> Progress {
        if self.quiet { Progress::hidden() } else { Progress::counting(all, things) }
    }

    /// The progress line of a run.
    pub(super) fn line(self, steps: Option<u64>) -> Progress {
        if self.quiet { Progress::hidden() } else { Progress::new(steps) }
    }
}
