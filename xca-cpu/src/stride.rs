//! The number of steps that are done together, each in the wake of the previous one. Times decide, and change
//! no result.

use crate::choices::Choices;
use crate::layout::Layout;
use crate::memory::bytes_per_cell;
use std::iter;
use std::time::Duration;
use xca_core::engine::Figure;
use xca_core::{Model, Precision, Process, ProcessKind};
use xca_wavefront::{Depth, Lag};

/// The largest number of steps done together. With more, the data between the first and the last step exceeds
/// every cache.
const MOST: u64 = 16;

/// The number of rounds in which all numbers of steps are timed.
const ROUNDS: u32 = 6;

/// The least number of steps in the turn of a number. The first one is slow, because the caches hold what the
/// number before has left.
const TURN: u64 = 4;

/// The factor by which a number may be slower than the fastest after a round, to take further part. Other
/// programs may slow down a number for some rounds, so that the first ones decide little.
const SLOWEST: [f64; ROUNDS as usize] = [f64::INFINITY, 1.5, 1.5, 1.2, 1.2, 1.2];

/// A number of steps must take less than this share of the time of each smaller number.
const WORTH: f64 = 0.95;

/// The amount of data in bytes that a pass updates before the next one follows.
const BYTES_PER_CHUNK: usize = 1 << 17;

/// The amount of data in bytes that all passes use in a column before the first one continues. It should fit
/// in the private cache of a core.
const BYTES_PER_COLUMN: usize = 1 << 20;

/// The numbers of steps for which the best number stays: at first, and at most.
const HOLD: [u64; 2] = [256, 4096];

/// Finds the fastest number of steps.
#[derive(Debug)]
pub(crate) struct Stride {
    /// The number chosen by a test.
    fixed: Option<u64>,
    /// The largest number that fits into the space.
    most: u64,
    lag: Lag,
    /// The rows of a column, chosen by a test.
    column: Option<usize>,
    bytes_per_row: usize,
    /// The numbers that are still compared, in rising order. They take turns, because other programs may slow
    /// down the machine for a while.
    rivals: Vec<Timed>,
    /// The index of the number whose turn it is, and the number of steps in this turn so far.
    turn: usize,
    steps_of_turn: u64,
    /// The number of rounds so far.
    rounds: u32,
    /// The best number, when nothing is compared.
    best: u64,
    /// The number of steps before all numbers are tried again.
    hold: u64,
    next_hold: u64,
    /// The number of all steps, and the number of leaps in which they were done.
    steps: u64,
    leaps: u64,
}

/// A number of steps done together, with its shortest time so far.
#[derive(Debug, Clone, Copy)]
struct Timed {
    steps: u64,
    /// Seconds per step.
    seconds: f64,
}

impl Stride {
    /// `stages` is the number of passes of a step.
    pub(crate) fn new(
        (model, layout, precision): (&Model, &Layout, Precision),
        stages: usize,
        threads: usize,
        choices: Choices,
    ) -> Self {
        let Choices { stride: fixed, column, .. } = choices;
        let is_over_cells =
            |process: &Process| process.kind == ProcessKind::Cells && process.population().is_none();
        let lag = layout.lag().filter(|_| model.processes().iter().all(is_over_cells));
        let most = lag.map_or(1, |lag| {
            // A thread must have more work than remains in the gaps between blocks.
            let blocks = if fixed.is_some() { 1 } else { 2 * threads };
            let layers = layout.rows() / lag.layer;
            let followers = layers.checked_div(2 * blocks * lag.layers).unwrap_or(usize::MAX);
            let passes = if lag.has_border() { followers } else { followers.saturating_add(1) };
            (passes / stages.max(1)) as u64
        });
        let most = most.clamp(1, MOST);
        let mut stride = Self {
            fixed,
            most,
            lag: lag.unwrap_or(Lag::NONE),
            column,
            bytes_per_row: (bytes_per_cell(model, precision) * layout.width()).max(1),
            rivals: Vec::new(),
            turn: 0,
            steps_of_turn: 0,
            rounds: 0,
            best: 1,
            hold: 0,
            next_hold: HOLD[0],
            steps: 0,
            leaps: 0,
        };
        // Where columns pay for some numbers, those without them use more than the caches hold.
        let has_column =
            |steps: &u64| fixed.is_none() && *steps > 1 && stride.column(*steps as usize * stages).is_some();
        stride.most = powers(most).filter(has_column).last().unwrap_or(most);
        stride.rivals = rivals(stride.most);
        stride
    }

    /// The depth for this number of passes.
    pub(crate) fn depth(&self, passes: usize) -> Depth {
        let column = self.column(passes);
        let rows = column.unwrap_or(self.lag.layer);
        let chunk =
            if self.fixed.is_some() { 1 } else { (BYTES_PER_CHUNK / (self.bytes_per_row * rows)).max(1) };
        Depth { passes, lag: self.lag, chunk, column }
    }

    /// The rows of a column. `None` if columns do not pay.
    fn column(&self, passes: usize) -> Option<usize> {
        let along = self.lag.along?;
        if self.column.is_some() {
            return self.column;
        }
        // The layers between the first and the last pass, and those that they see.
        let layers = (passes + 2) * self.lag.layers;
        let rows = BYTES_PER_COLUMN / (self.bytes_per_row * layers);
        // The rows by which a column shifts are read twice.
        (rows < self.lag.layer && rows >= 2 * passes * along).then_some(rows)
    }

    /// The number of steps to do together, if `free` steps have nothing between them.
    pub(crate) fn steps(&self, free: u64) -> u64 {
        let present = self.rivals.get(self.turn).map_or(self.best, |rival| rival.steps);
        self.fixed.unwrap_or(present).min(self.most).min(free)
    }

    /// Records the time of steps that were done together. These may be fewer than the number whose turn it
    /// is, because of what happens between steps. If a smaller number would have done as many, they say
    /// nothing about this one.
    pub(crate) fn took(&mut self, steps: u64, time: Duration) {
        self.steps += steps;
        self.leaps += 1;
        if let Some(rival) = self.rivals.get_mut(self.turn) {
            if steps > rival.steps / 2 {
                rival.seconds = rival.seconds.min(time.as_secs_f64() / steps as f64);
            }
            self.steps_of_turn += steps;
            if self.steps_of_turn >= TURN {
                self.end_turn();
            }
            return;
        }
        self.hold = self.hold.saturating_sub(steps);
        if self.hold == 0 {
            (self.rivals, self.rounds) = (rivals(self.most), 0);
        }
    }

    /// Ends the turn of a number. After a round, judges all numbers.
    fn end_turn(&mut self) {
        (self.turn, self.steps_of_turn) = (self.turn + 1, 0);
        if self.turn < self.rivals.len() {
            return;
        }
        (self.turn, self.rounds) = (0, self.rounds + 1);
        let least = self.rivals.iter().map(|rival| rival.seconds).fold(f64::INFINITY, f64::min);
        let slowest = SLOWEST[self.rounds as usize - 1] * least;
        self.rivals.retain(|rival| rival.seconds <= slowest);
        if self.rounds < ROUNDS && self.rivals.len() > 1 {
            return;
        }
        let is_worth = |rival: &&Timed| WORTH * rival.seconds <= least;
        self.best = self.rivals.iter().find(is_worth).map_or(1, |rival| rival.steps);
        self.rivals.clear();
        self.hold = self.next_hold;
        self.next_hold = (2 * self.next_hold).min(HOLD[1]);
    }

    /// The mean number of steps done together.
    pub(crate) fn figure(&self) -> Option<Figure> {
        let value = self.steps as f64 / self.leaps as f64;
        (self.steps > self.leaps).then(|| Figure { name: "steps_together".to_owned(), value })
    }
}

/// The numbers of steps up to a largest one.
fn powers(most: u64) -> impl Iterator<Item = u64> {
    iter::successors(Some(1), |steps| Some(2 * steps)).take_while(move |steps| *steps <= most)
}

/// These numbers, not timed yet.
fn rivals(most: u64) -> Vec<Timed> {
    powers(most).map(|steps| Timed { steps, seconds: f64::INFINITY }).collect()
}

#[cfg(test)]
mod tests {
    use super::{HOLD, MOST, Stride};
    use crate::choices::Choices;
    use std::time::Duration;
    use xca_core::prelude::*;

    #[derive(Substates, Clone, Copy)]
    struct Site {
        value: Real,
    }

    #[elementary_process]
    fn smooth(cell: &mut Cell<Site>) {
        cell.value += cell.neighbour(1).value;
    }

    fn stride(rows: usize, threads: usize) -> Stride {
        let builder = Model::builder("rows").extents([4, rows, 1]).neighbourhood(Neighbourhood::moore_2d(1));
        let model = builder.substates::<Site>().process(smooth).build().unwrap();
        let layout = crate::layout::Layout::new(model.geometry());
        Stride::new((&model, &layout, Precision::F64), 1, threads, Choices::default())
    }

    /// The numbers of steps in consecutive leaps. `seconds` is the time of a step, by the number of steps
    /// done together.
    fn leaps(stride: &mut Stride, count: usize, seconds: impl Fn(u64) -> f64) -> Vec<u64> {
        let mut leaps = Vec::new();
        for _ in 0..count {
            let steps = stride.steps(1000);
            stride.took(steps, Duration::from_secs_f64(seconds(steps) * steps as f64));
            leaps.push(steps);
        }
        leaps
    }

    /// The leaps of a round.
    const ALL: [u64; 9] = [1, 1, 1, 1, 2, 2, 4, 8, 16];

    #[test]
    fn the_best_number_of_steps_is_found_and_kept() {
        let mut stride = stride(10_000, 2);
        // Two steps together gain nothing, four do.
        let seconds = |steps: u64| [1.0, 1.0, 0.25, 0.4, 0.4][steps.ilog2() as usize];
        let mut wanted = ALL.repeat(2);
        wanted.extend([4; HOLD[0] as usize / 4]);
        wanted.extend(ALL);
        assert_eq!(leaps(&mut stride, wanted.len(), seconds), wanted);
    }

    #[test]
    fn where_it_does_not_pay_steps_are_done_one_by_one() {
        for seconds in [1.0, 0.96] {
            let mut stride = stride(10_000, 2);
            let mut wanted = ALL.repeat(6);
            wanted.extend([1; 200]);
            let seconds = |steps| if steps == 1 { 1.0 } else { seconds };
            assert_eq!(leaps(&mut stride, wanted.len(), seconds), wanted);
        }
    }

    /// Other programs slow the machine down for a while, by more than the steps gain.
    #[test]
    fn a_slow_time_does_not_decide() {
        for slow in 0..24 {
            let mut stride = stride(10_000, 2);
            let mut leaps = Vec::new();
            for leap in 0..40 {
                let steps = stride.steps(1000);
                let times = if (slow..slow + 8).contains(&leap) { 3.0 } else { 1.0 };
                let seconds = times / steps.min(8) as f64;
                stride.took(steps, Duration::from_secs_f64(seconds * steps as f64));
                leaps.push(steps);
            }
            assert_eq!(leaps[39], 8, "{slow}: {leaps:?}");
        }
    }

    /// Something happens after every ten steps.
    #[test]
    fn numbers_are_also_compared_where_steps_are_cut_short() {
        let mut stride = stride(10_000, 2);
        let mut leaps = Vec::new();
        while leaps.len() < 60 {
            let mut left = 10;
            while left > 0 {
                let steps = stride.steps(left);
                stride.took(steps, Duration::from_secs_f64(1.0));
                leaps.push(steps);
                left -= steps;
            }
        }
        assert_eq!(leaps[25..45], [10; 20], "{leaps:?}");
    }

    /// Something happens after every forty steps. Then sixteen are often cut to eight, which
    /// are fast, and by chance faster than other eight.
    #[test]
    fn steps_that_are_cut_short_say_nothing_about_more() {
        let mut stride = stride(10_000, 2);
        let mut leaps = Vec::new();
        while leaps.len() < 50 {
            let mut left = 40;
            while left > 0 {
                let steps = stride.steps(left);
                let seconds =
                    [4.0, 4.0, 2.0, if left == steps { 0.9 } else { 1.0 }, 1.15][steps.ilog2() as usize];
                stride.took(steps, Duration::from_secs_f64(seconds * steps as f64));
                leaps.push(steps);
                left -= steps;
            }
        }
        assert_eq!(leaps[40..50], [8; 10], "{leaps:?}");
    }

    #[test]
    fn no_more_are_done_than_there_is_room_for() {
        let most = |rows: usize, threads: usize| {
            leaps(&mut stride(rows, threads), 30, |steps| 1.0 / steps as f64)[29]
        };
        assert_eq!([most(3, 1), most(12, 1), most(12, 2), most(12, 8)], [1, 4, 2, 1]);
        assert_eq!(most(100_000, 4), MOST);
        assert_eq!(stride(10_000, 2).steps(0), 0);
    }

    /// What is left at two borders must not overlap.
    #[test]
    fn borders_need_room_too() {
        let builder = Model::builder("rows").extents([4, 30, 1]).neighbourhood(Neighbourhood::moore_2d(1));
        let model = builder.substates::<Site>().process(smooth).build().unwrap();
        let most = |rows: std::ops::Range<usize>| {
            let part = xca_core::engine::Part { y: rows, z: 0..1 };
            let layout = crate::layout::Layout::of_part(model.geometry(), &part);
            let choices = Choices { stride: Some(16), ..Choices::default() };
            Stride::new((&model, &layout, Precision::F64), 1, 1, choices).steps(1000)
        };
        assert_eq!([most(10..11), most(10..14), most(10..15), most(0..10)], [1, 2, 2, 5]);
        assert_eq!(most(0..30), 15 + 1);
    }

    fn in_space(extents: [usize; 3], boundary: Boundary) -> Stride {
        let builder = Model::builder("air").extents(extents).neighbourhood(Neighbourhood::moore(1));
        let builder = builder.boundaries([boundary; 3]).substates::<Site>().process(smooth);
        let model = builder.build().unwrap();
        let layout = crate::layout::Layout::new(model.geometry());
        Stride::new((&model, &layout, Precision::F64), 1, 2, Choices::default())
    }

    #[test]
    fn columns_hold_what_fits_in_a_cache() {
        let column = |extents, boundary, passes| in_space(extents, boundary).depth(passes).column;
        // Two buffers of 8 bytes per cell: 4 kB a row, and 6 or 10 layers.
        assert_eq!(column([256; 3], Boundary::Flat, 4), Some(42));
        assert_eq!(column([256; 3], Boundary::Reflecting, 8), Some(25));
        // The shifted rows would outnumber the others.
        assert_eq!(column([256; 3], Boundary::Flat, 16), None);
        // A whole layer fits. On a torus, rows see each other from end to end.
        assert_eq!(column([256, 40, 256], Boundary::Flat, 4), None);
        assert_eq!(column([256; 3], Boundary::Toroidal, 4), None);
    }
    #[test]
    fn where_columns_pay_steps_without_them_take_no_part() {
        let most = |extents, boundary| in_space(extents, boundary).most;
        assert_eq!(most([256; 3], Boundary::Flat), 8);
        // No number has columns.
        assert_eq!([most([256, 20, 256], Boundary::Flat), most([256; 3], Boundary::Toroidal)], [16; 2]);
    }
}
