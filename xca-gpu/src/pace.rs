//! How much work goes into one submission: enough to keep the device busy, little enough that no driver takes
//! it for dead.

use std::time::{Duration, Instant};

/// What a submission should take. Desktop drivers end work of some seconds; and a program wants to hear from
/// its run.
const AIM: Duration = Duration::from_millis(60);
/// A step that takes longer is submitted process by process.
const LONG: Duration = Duration::from_millis(400);
/// The most steps in one submission.
const MOST: u64 = 256;

/// Chooses the number of steps of the next submission from the time of the last ones.
#[derive(Debug)]
pub(crate) struct Pace {
    steps: u64,
    apart: bool,
}

impl Pace {
    pub(crate) fn new() -> Self {
        Self { steps: 1, apart: false }
    }

    /// How many steps to submit, of so many.
    pub(crate) fn steps(&self, left: u64) -> u64 {
        self.steps.min(left)
    }

    /// Whether each process is to be submitted for itself.
    pub(crate) fn apart(&self) -> bool {
        self.apart
    }

    /// Learns from so many steps that were submitted at this instant and are done now.
    pub(crate) fn learn(&mut self, steps: u64, started: Instant) {
        let step = started.elapsed() / u32::try_from(steps.max(1)).unwrap_or(u32::MAX);
        self.apart = step > LONG;
        let fitting = AIM.as_nanos() / step.as_nanos().max(1);
        // Carefully upwards: the first steps may be easy ones.
        self.steps = u64::try_from(fitting).unwrap_or(MOST).clamp(1, MOST.min(2 * self.steps));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_steps_are_submitted_alone_and_short_ones_together() {
        let mut pace = Pace::new();
        let before = |time| Instant::now().checked_sub(time).unwrap();
        assert_eq!((pace.steps(100), pace.apart()), (1, false));
        for _ in 0..4 {
            pace.learn(pace.steps(100), before(Duration::from_micros(1)));
        }
        assert_eq!((pace.steps(100), pace.steps(3)), (16, 3));
        pace.learn(16, before(Duration::from_secs(1)));
        assert_eq!((pace.steps(100), pace.apart()), (1, false));
        pace.learn(1, before(Duration::from_secs(1)));
        assert!(pace.apart());
    }
}
