//! How many steps are done at a time.

use std::ops::Range;
use std::time::Duration;

/// How many steps are done at a time: an engine does many faster than one by one, but Ctrl-C and the line
/// that shows how far the run has come must not wait for long.
#[derive(Debug)]
pub struct Batch {
    pub steps: u64,
    /// The time that a batch should take, in milliseconds.
    wanted: Range<u128>,
}

impl Default for Batch {
    /// Long enough for an engine to do steps together, and for parts of a space to run on without their host.
    /// `mpirun` kills processes a second after an interrupt.
    fn default() -> Self {
        Self { steps: 1, wanted: 100..400 }
    }
}

impl Batch {
    /// Short enough for pictures that move.
    pub fn brief() -> Self {
        Self { steps: 1, wanted: 20..80 }
    }

    /// After so many steps. A part of a batch does not tell how long a larger one takes.
    pub fn adapt(&mut self, steps: u64, took: Duration) {
        let milliseconds = took.as_millis();
        if milliseconds >= self.wanted.end {
            self.steps = (self.steps / 2).max(1);
        } else if milliseconds < self.wanted.start && steps >= self.steps {
            self.steps = self.steps.saturating_mul(2);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn batches_follow_the_time_that_a_step_takes() {
        for (mut batch, wanted) in [(Batch::default(), 200), (Batch::brief(), 50)] {
            for _ in 0..6 {
                batch.adapt(batch.steps, Duration::from_millis(1));
            }
            assert_eq!(batch.steps, 64);
            batch.adapt(64, Duration::from_millis(wanted));
            batch.adapt(63, Duration::from_millis(1));
            assert_eq!(batch.steps, 64);
            for _ in 0..10 {
                batch.adapt(1, Duration::from_millis(500));
            }
            assert_eq!(batch.steps, 1);
        }
    }
}
