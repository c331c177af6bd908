//! A run under way, and what the terminal shows of it.

mod words;

#[cfg(feature = "terminal")]
pub(super) use words::engine_words;

use super::outcome::{Ended, Unable};
use super::prepare::warn;
use super::voice::Voice;
use crate::interrupt::Interrupt;
use crate::progress::Progress;
use crate::terminal;
use xca_record::{Monitor, Outcome, Recording};

/// A run under way.
pub(super) struct UnderWay {
    pub(super) recording: Recording,
    pub(super) voice: Voice,
    /// What has to be known of the engine.
    pub(super) note: Option<String>,
}

/// The line that shows how far a run has come, and Ctrl-C.
struct Terminal<'a> {
    line: Progress,
    interrupt: &'a Interrupt,
}

impl Monitor for Terminal<'_> {
    fn begin(&mut self, step: u64) {
        self.line.begin_at(step);
    }

    fn at(&mut self, step: u64) {
        self.line.at(step);
    }

    fn is_interrupted(&self) -> bool {
        self.interrupt.is_raised()
    }
}

impl UnderWay {
    /// How many steps it takes, where that is known beforehand.
    fn known_steps(&self) -> Option<u64> {
        let is_known = !self.recording.recorder().set_up().is_until_stopped;
        is_known.then_some(self.recording.report().progress.steps_wanted)
    }

    pub(super) fn go(mut self) -> Result<Ended, Unable> {
        let interrupt = Interrupt::install().map_err(Unable::failed)?;
        self.voice.say(&self.headline());
        if let Some(note) = &self.note {
            self.voice.say(&format!("note: {note}"));
        }
        warn(self.recording.recorder().set_up());
        let line = self.voice.line(self.known_steps());
        let mut monitor = Terminal { line, interrupt: &interrupt };
        let result = self.recording.go(&mut monitor);
        monitor.line.finish();
        let outcome = result.map_err(|error| Unable::FailedLeaving(error, self.remains()))?;
        match self.voice.tell(self.recording.report(), || self.summary()) {
            Err(Unable::Failed(error)) => return Err(Unable::FailedLeaving(error, self.remains())),
            told => told?,
        }
        for warning in self.recording.final_warnings() {
            terminal::remark(&format!("warning: {warning}"));
        }
        Ok(if outcome == Outcome::Interrupted { Ended::Interrupted } else { Ended::Done })
    }
}
