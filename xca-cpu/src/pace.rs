//! Whether it pays to look for what is not due. Where nearly everything changes in each step, steps go on without for a while.

/// Where more than this share of the cells is due, it does not pay to leave out the rest.
const MOST: f64 = 0.6;

/// How many steps go on without a look at first, and at most.
const PAUSES: [u64; 2] = [64, 1024];

/// Whether cells are left out.
#[derive(Debug)]
pub(crate) struct Pace {
    /// Whether they always are, for tests.
    always: bool,
    /// Steps to go without.
    pause: u64,
    next_pause: u64,
}

impl Pace {
    pub(crate) fn new(always: bool) -> Self {
        Self { always, pause: 0, next_pause: PAUSES[0] }
    }

    pub(crate) fn is_on(&self) -> bool {
        self.pause == 0
    }

    /// A step begins. Whether it ends a pause, in which no one has seen what changed.
    pub(crate) fn begins_again(&mut self) -> bool {
        let was_paused = !self.is_on();
        self.pause = self.pause.saturating_sub(1);
        was_paused && self.is_on()
    }

    /// Whether this share of the cells is too much.
    pub(crate) fn is_much(&self, share: f64) -> bool {
        share > MOST && !self.always
    }

    /// A step has ended that left out what was not due, and after which this share is.
    pub(crate) fn judge(&mut self, share: f64) {
        if self.is_much(share) {
            self.pause = self.next_pause;
            self.next_pause = (2 * self.next_pause).min(PAUSES[1]);
        } else {
            self.next_pause = PAUSES[0];
        }
    }
}
