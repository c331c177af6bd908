//! How many steps are done together, each in the wake of the one before. Times decide, and change no result.

use crate::choices::Choices;
use crate::layout::Layout;
use crate::memory::bytes_per_cell;
use crate::wavefront::{Depth, Lag};
use std::time::Duration;
use xca_core::engine::Figure;
use xca_core::{Model, Precision, Process, ProcessKind};

/// The most steps that are done together: with more, what lies between the first and the last no longer fits
/// in any cache.
const MOST: u64 = 16;

/// How often a number of steps is tried before it is judged.
const TRIES: u32 = 2;

/// A number of steps has to take less than this part of the time of a smaller number.
const WORTH: f64 = 0.97;

/// The bytes that a pass works on before the next one follows.
const BYTES_PER_CHUNK: usize = 1 << 17;

/// The bytes that all passes meet in a column before the first of them goes on: they should fit in a core's
/// own cache.
const BYTES_PER_COLUMN: usize = 1 << 20;

/// For how many steps the best number stays: at first, and at most.
const HOLD: [u64; 2] = [256, 4096];

/// Finds the number of steps that takes the least time.
#[derive(Debug)]
pub(crate) struct Stride {
    /// Chosen by a test.
    fixed: Option<u64>,
    /// The most that the space has room for.
    most: u64,
    lag: Lag,
    /// The rows of a column, chosen by a test.
    column: Option<usize>,
    bytes_per_row: usize,
    /// The number that is tried or kept, and the shortest time of a step so far.
    present: Timed,
    /// The best number of those that are smaller.
    best: Option<Timed>,
    /// How often the present number has been tried; nothing while it is kept.
    tries: Option<u32>,
    /// Steps to go before all numbers are tried again.
    hold: u64,
    next_hold: u64,
    /// All steps that were done, and how often some were done together.
    steps: u64,
    leaps: u64,
}

/// A number of steps that are done together.
#[derive(Debug, Clone, Copy)]
struct Timed {
    steps: u64,
    /// Seconds of one step.
    seconds: f64,
}

impl Stride {
    /// `stages` is how many passes a step has.
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
            // A thread has to have more to do than what is left in the gaps between blocks.
            let blocks = if fixed.is_some() { 1 } else { 2 * threads };
            let layers = layout.rows() / lag.layer;
            let followers = layers.checked_div(2 * blocks * lag.layers).unwrap_or(usize::MAX);
            (followers.saturating_add(1) / stages.max(1)) as u64
        });
        Self {
            fixed,
            most: most.clamp(1, MOST),
            lag: lag.unwrap_or(Lag::NONE),
            column,
            bytes_per_row: (bytes_per_cell(model, precision) * layout.width()).max(1),
            present: Timed { steps: 1, seconds: f64::INFINITY },
            best: None,
            tries: Some(0),
            hold: 0,
            next_hold: HOLD[0],
            steps: 0,
            leaps: 0,
        }
    }

    /// How so many passes follow each other.
    pub(crate) fn depth(&self, passes: usize) -> Depth {
        let column = self.column(passes);
        let rows = column.unwrap_or(self.lag.layer);
        let chunk =
            if self.fixed.is_some() { 1 } else { (BYTES_PER_CHUNK / (self.bytes_per_row * rows)).max(1) };
        Depth { passes, lag: self.lag, chunk, column }
    }

    /// The rows of a column, where columns are worth it.
    fn column(&self, passes: usize) -> Option<usize> {
        let along = self.lag.along?;
        if self.column.is_some() {
            return self.column;
        }
        // Between the first pass and the last one, with what these see.
        let layers = (passes + 2) * self.lag.layers;
        let rows = BYTES_PER_COLUMN / (self.bytes_per_row * layers);
        // The rows by which a column is shifted are met twice.
        (rows < self.lag.layer && rows >= 2 * passes * along).then_some(rows)
    }

    /// How many of the next steps are done together, where so many have nothing between them.
    pub(crate) fn steps(&self, free: u64) -> u64 {
        self.fixed.unwrap_or(self.present.steps).min(self.most).min(free)
    }

    /// Steps were done together, in this time.
    pub(crate) fn took(&mut self, steps: u64, time: Duration) {
        self.steps += steps;
        self.leaps += 1;
        self.hold = self.hold.saturating_sub(steps);
        let Some(tries) = self.tries else {
            if self.hold == 0 {
                self.present = Timed { steps: 1, seconds: f64::INFINITY };
                self.tries = Some(0);
            }
            return;
        };
        if steps != self.present.steps {
            return;
        }
        let seconds = time.as_secs_f64() / steps as f64;
        self.present.seconds = self.present.seconds.min(seconds);
        self.tries = Some(tries + 1);
        if tries + 1 == TRIES {
            self.judge();
        }
    }

    /// How many steps were done together, on the average.
    pub(crate) fn figure(&self) -> Option<Figure> {
        let value = self.steps as f64 / self.leaps as f64;
        (self.steps > self.leaps).then(|| Figure { name: "steps_together".to_owned(), value })
    }

    /// The present number has been tried often enough: tries the next one, or stays with the best.
    fn judge(&mut self) {
        let is_better = self.best.is_none_or(|best| self.present.seconds < WORTH * best.seconds);
        let next = 2 * self.present.steps;
        if is_better && next <= self.most {
            self.best = Some(self.present);
            self.present = Timed { steps: next, seconds: f64::INFINITY };
            self.tries = Some(0);
            return;
        }
        if let Some(best) = self.best.take()
            && !is_better
        {
            self.present = best;
        }
        self.tries = None;
        self.hold = self.next_hold;
        self.next_hold = (2 * self.next_hold).min(HOLD[1]);
    }
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

    /// How many steps are done together, one leap after the other, where a step of so many together takes so
    /// long.
    fn leaps(stride: &mut Stride, count: usize, seconds: impl Fn(u64) -> f64) -> Vec<u64> {
        let mut leaps = Vec::new();
        for _ in 0..count {
            let steps = stride.steps(1000);
            stride.took(steps, Duration::from_secs_f64(seconds(steps) * steps as f64));
            leaps.push(steps);
        }
        leaps
    }

    #[test]
    fn the_best_number_of_steps_is_found_and_kept() {
        let mut stride = stride(10_000, 2);
        let seconds = |steps: u64| if steps <= 4 { 1.0 / steps as f64 } else { 0.4 };
        let mut wanted = vec![1, 1, 2, 2, 4, 4, 8, 8];
        wanted.extend([4; HOLD[0] as usize / 4]);
        wanted.extend([1, 1, 2, 2]);
        assert_eq!(leaps(&mut stride, wanted.len(), seconds), wanted);
    }

    #[test]
    fn where_it_does_not_pay_steps_are_done_one_by_one() {
        let mut stride = stride(10_000, 2);
        let mut wanted = vec![1, 1, 2, 2];
        wanted.extend([1; 200]);
        assert_eq!(leaps(&mut stride, wanted.len(), |_| 1.0), wanted);
    }

    #[test]
    fn no_more_are_done_than_there_is_room_for() {
        let most = |rows: usize, threads: usize| {
            leaps(&mut stride(rows, threads), 13, |steps| 1.0 / steps as f64)[12]
        };
        assert_eq!([most(3, 1), most(12, 1), most(12, 2), most(12, 8)], [1, 4, 2, 1]);
        assert_eq!(most(100_000, 4), MOST);
        assert_eq!(stride(10_000, 2).steps(0), 0);
    }

    #[test]
    fn columns_hold_what_fits_in_a_cache() {
        let column = |extents: [usize; 3], boundary, passes| {
            let builder = Model::builder("air").extents(extents).neighbourhood(Neighbourhood::moore(1));
            let builder = builder.boundaries([boundary; 3]).substates::<Site>().process(smooth);
            let model = builder.build().unwrap();
            let layout = crate::layout::Layout::new(model.geometry());
            let of = (&model, &layout, Precision::F64);
            Stride::new(of, 1, 2, Choices::default()).depth(passes).column
        };
        // Two buffers of 8 bytes a cell: 4 kB a row, and 6 or 10 layers.
        assert_eq!(column([256; 3], Boundary::Flat, 4), Some(42));
        assert_eq!(column([256; 3], Boundary::Reflecting, 8), Some(25));
        // What is shifted would be more than what is not.
        assert_eq!(column([256; 3], Boundary::Flat, 16), None);
        // A whole layer fits; round a torus rows see each other from end to end.
        assert_eq!(column([256, 40, 256], Boundary::Flat, 4), None);
        assert_eq!(column([256; 3], Boundary::Toroidal, 4), None);
    }
}
