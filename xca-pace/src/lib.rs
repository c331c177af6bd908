//! Whether skipping cells pays. Steps on all cells and steps that skip cells are timed, and the faster kind
//! continues. Times decide which cells are updated, but change no result.

use std::time::Duration;

/// The largest share of due cells at which skipping is tried.
const MOST_DUE: f64 = 0.8;

/// The numbers of steps on all cells: before the first try, after the first failed try, and at most.
const PAUSES: [u64; 3] = [2, 64, 1024];

/// The number of timed steps between two decisions. The first ones of a try are slow, because the caches hold
/// what the steps on all cells have left.
const TRY: u64 = 16;

/// After so many steps a try ends if it is slower than steps on all cells by this factor.
const FEW: u64 = 4;
const HOPELESS: f64 = 2.0;

/// The factor by which the time of a single step on all cells, at the start, may be too long.
const DOUBT: f64 = 3.0;

/// Whether cells are skipped.
#[derive(Debug)]
pub struct Pace {
    /// Whether cells are always skipped, for tests.
    always: bool,
    /// The number of remaining steps on all cells.
    pause: u64,
    next_pause: u64,
    /// The number of steps since then.
    tried: u64,
    /// The shortest time of a step, in seconds per cell: on all cells in the last pause, and with skipped
    /// cells since the last decision.
    whole: f64,
    part: f64,
    /// The factor by which `whole` may be too long.
    doubt: f64,
}

/// A finished step.
#[derive(Debug, Clone, Copy)]
pub struct Step {
    /// The number of cells of the step, counted for each process.
    pub cells: u64,
    /// The time that the step took.
    pub time: Duration,
}

impl Pace {
    /// A pace that finds out by times. With `always`, cells are always skipped, for tests.
    pub fn new(always: bool) -> Self {
        let pause = if always { 0 } else { PAUSES[0] };
        let (whole, part) = (f64::INFINITY, f64::INFINITY);
        Self { always, pause, next_pause: PAUSES[1], tried: 0, whole, part, doubt: DOUBT }
    }

    /// Whether the step skips cells.
    pub fn is_on(&self) -> bool {
        self.pause == 0
    }

    /// The number of following steps that skip no cells.
    pub fn pause(&self) -> u64 {
        self.pause
    }

    /// Whether the step is the first one after a pause, during which changes were not tracked.
    pub fn is_first(&self) -> bool {
        self.is_on() && self.tried == 0
    }

    /// Records a finished step. Returns whether the share of due cells is needed, see [`Self::judge_share`].
    pub fn ended(&mut self, step: Step) -> bool {
        if self.always {
            self.tried += 1;
            return false;
        }
        let of_cell = step.time.as_secs_f64() / step.cells.max(1) as f64;
        if !self.is_on() {
            // The very first step meets untouched memory, and is not timed.
            if self.pause < PAUSES[0] || self.doubt < DOUBT {
                self.whole = self.whole.min(of_cell);
            }
            self.pause -= 1;
            self.tried = 0;
            return false;
        }
        self.tried += 1;
        if self.tried == 1 {
            return true;
        }
        self.part = self.part.min(of_cell);
        let timed = self.tried - 1;
        if timed.is_multiple_of(TRY) {
            self.judge(self.doubt * self.part < self.whole);
        } else if timed == FEW && self.part > HOPELESS * self.whole {
            self.judge(false);
        }
        false
    }

    /// Judges by the share of due cells, after a step that tracked all changes.
    pub fn judge_share(&mut self, due: f64) {
        if due > MOST_DUE {
            self.judge(false);
        }
    }

    fn judge(&mut self, pays: bool) {
        self.part = f64::INFINITY;
        if pays {
            self.next_pause = PAUSES[1];
            return;
        }
        (self.whole, self.doubt) = (f64::INFINITY, 1.0);
        self.pause = self.next_pause;
        self.next_pause = (2 * self.next_pause).min(PAUSES[2]);
    }
}

#[cfg(test)]
mod tests {
    use super::{FEW, PAUSES, Pace, Step, TRY};
    use std::iter;
    use std::time::Duration;

    /// The indices of the steps that skip cells, out of `count`. A step on all cells takes a second, one that
    /// skips cells `seconds`, which get the number of such steps before it since the last pause. `due` is the
    /// share of due cells.
    fn steps(count: u64, due: f64, seconds: impl Fn(u64) -> f64) -> Vec<u64> {
        let mut pace = Pace::new(false);
        let mut left_out = Vec::new();
        let mut tried = 0;
        for step in 0..count {
            tried = if pace.is_on() { tried + 1 } else { 0 };
            if pace.is_on() {
                left_out.push(step);
            }
            let seconds = if pace.is_on() { seconds(tried - 1) } else { 1.0 };
            if pace.ended(Step { cells: 10, time: Duration::from_secs_f64(seconds) }) {
                pace.judge_share(due);
            }
        }
        left_out
    }

    /// The same if each of the tries, of so many steps, fails.
    fn tries(count: u64, tries: &[u64]) -> Vec<u64> {
        let pauses = [2, 64, 128, 256, 512, 1024, 1024, 1024, 1024];
        let lengths = tries.iter().chain(iter::repeat(tries.last().unwrap()));
        let begins = pauses.iter().zip(lengths).scan(0, |at, (pause, length)| {
            let begin = *at + pause;
            *at = begin + length;
            Some(begin..begin + length)
        });
        begins.flatten().filter(|step| *step < count).collect()
    }

    #[test]
    fn what_pays_goes_on() {
        assert_eq!(steps(1000, 0.3, |_| 0.1), (PAUSES[0]..1000).collect::<Vec<_>>());
    }

    /// The first step on all cells may have been slow.
    #[test]
    fn what_pays_a_little_goes_on_after_a_longer_pause() {
        let (first, rest) = (PAUSES[0]..PAUSES[0] + 1 + TRY, PAUSES[0] + 1 + TRY + PAUSES[1]..1000);
        assert_eq!(steps(1000, 0.3, |_| 0.5), first.chain(rest).collect::<Vec<_>>());
    }

    #[test]
    fn what_does_not_pay_is_tried_more_and_more_seldom() {
        assert_eq!(steps(5000, 0.9, |_| 0.5), tries(5000, &[1]));
        assert_eq!(steps(5000, 0.3, |_| 3.0), tries(5000, &[1 + FEW]));
        assert_eq!(steps(5000, 0.3, |_| 1.5), tries(5000, &[1 + TRY]));
    }

    /// Caches are cold at first, and other programs slow down single steps.
    #[test]
    fn slow_steps_in_a_try_do_not_decide() {
        let seconds = |tried| if tried < 10 || tried % 3 == 0 { 1.9 } else { 0.2 };
        assert_eq!(steps(1000, 0.3, seconds), (PAUSES[0]..1000).collect::<Vec<_>>());
    }

    #[test]
    fn what_pays_no_more_stops() {
        let seconds = |tried| if tried < 100 { 0.2 } else { 1.1 };
        let end = PAUSES[0] + 1 + 8 * TRY;
        assert_eq!(steps(end + PAUSES[1], 0.3, seconds), (PAUSES[0]..end).collect::<Vec<_>>());
    }
}
