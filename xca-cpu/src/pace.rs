//! Whether skipping cells pays. Steps on all cells and steps that skip cells are timed, and the faster kind
//! continues. Times decide which cells are updated, but change no result.

use std::time::Duration;

/// The largest share of due cells at which skipping is tried.
const MOST_DUE: f64 = 0.8;

/// The numbers of steps on all cells: before the first try, after the first failed try, and at most.
const PAUSES: [u64; 3] = [2, 64, 1024];

/// The weight of a new time in the moving average.
const WEIGHT: f64 = 0.125;

/// The number of steps in a try.
const TRY: u64 = 4;

/// Whether cells are skipped.
#[derive(Debug)]
pub(crate) struct Pace {
    /// Whether cells are always skipped, for tests.
    always: bool,
    /// The number of remaining steps on all cells.
    pause: u64,
    next_pause: u64,
    /// The number of steps since then.
    tried: u64,
    /// Seconds per cell of a step: on all cells, and with skipped cells.
    whole: Option<f64>,
    part: Option<f64>,
}

/// A finished step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Step {
    /// The number of cells of the step, counted for each process.
    pub(crate) cells: u64,
    pub(crate) time: Duration,
}

impl Pace {
    pub(crate) fn new(always: bool) -> Self {
        let pause = if always { 0 } else { PAUSES[0] };
        Self { always, pause, next_pause: PAUSES[1], tried: 0, whole: None, part: None }
    }

    /// Whether the step skips cells.
    pub(crate) fn is_on(&self) -> bool {
        self.pause == 0
    }

    /// The number of following steps that skip no cells.
    pub(crate) fn pause(&self) -> u64 {
        self.pause
    }

    /// Whether the step is the first one after a pause, during which changes were not tracked.
    pub(crate) fn is_first(&self) -> bool {
        self.is_on() && self.tried == 0
    }

    /// Records a finished step. Returns whether the share of due cells is needed, see [`Self::judge_share`].
    pub(crate) fn ended(&mut self, step: Step) -> bool {
        if self.always {
            self.tried += 1;
            return false;
        }
        let of_cell = step.time.as_secs_f64() / step.cells.max(1) as f64;
        let mean = |before: Option<f64>| before.map_or(of_cell, |mean| mean + WEIGHT * (of_cell - mean));
        if !self.is_on() {
            // The very first step meets untouched memory, and is not timed.
            if self.pause < PAUSES[0] || self.whole.is_some() {
                self.whole = Some(mean(self.whole));
            }
            self.pause -= 1;
            self.tried = 0;
            return false;
        }
        self.tried += 1;
        if self.tried == 1 {
            return true;
        }
        self.part = Some(mean(self.part));
        if self.tried > TRY {
            let pays = self.part < self.whole;
            self.judge(pays);
        }
        false
    }

    /// Judges by the share of due cells, after a step that tracked all changes.
    pub(crate) fn judge_share(&mut self, due: f64) {
        if due > MOST_DUE {
            self.judge(false);
        }
    }

    fn judge(&mut self, pays: bool) {
        if pays {
            self.next_pause = PAUSES[1];
            return;
        }
        self.part = None;
        self.pause = self.next_pause;
        self.next_pause = (2 * self.next_pause).min(PAUSES[2]);
    }
}

#[cfg(test)]
mod tests {
    use super::{PAUSES, Pace, Step};
    use std::time::Duration;

    /// The indices of the steps that skip cells, out of `count`. Such a step takes `times` times as long as a
    /// step on all cells. `due` is the share of due cells.
    fn steps(count: u64, times: f64, due: f64) -> Vec<u64> {
        let mut pace = Pace::new(false);
        let mut left_out = Vec::new();
        for step in 0..count {
            let seconds = if pace.is_on() { times } else { 1.0 };
            if pace.is_on() {
                left_out.push(step);
            }
            if pace.ended(Step { cells: 10, time: Duration::from_secs_f64(seconds) }) {
                pace.judge_share(due);
            }
        }
        left_out
    }

    #[test]
    fn what_pays_goes_on() {
        assert_eq!(steps(1000, 0.5, 0.3), (PAUSES[0]..1000).collect::<Vec<_>>());
    }

    #[test]
    fn what_does_not_pay_is_tried_more_and_more_seldom() {
        for (times, due, try_) in [(2.0, 0.3, 5), (0.5, 0.9, 1)] {
            let left_out = steps(5000, times, due);
            let begins = [2, 64, 128, 256, 512, 1024, 1024, 1024].iter().scan(0, |at, pause| {
                *at += pause;
                let begin = *at;
                *at += try_;
                Some(begin..begin + try_)
            });
            assert_eq!(left_out, begins.flatten().filter(|step| *step < 5000).collect::<Vec<_>>());
        }
    }
}
