//! How many steps a program does at a time.

use std::ops::Range;
use std::time::Duration;

/// How many steps a program does at a time. An engine does many steps faster than one by one, but Ctrl-C and
/// the display must not wait for long.
///
/// ```
/// use std::time::Instant;
/// use xca_core::prelude::*;
/// use xca_core::Batch;
///
/// #[derive(Substates, Clone)]
/// struct Site {
///     age: u32,
/// }
///
/// #[elementary_process]
/// fn grow(cell: &mut Cell<Site>) {
///     cell.age += 1;
/// }
///
/// let model = Model::builder("site").extents([8, 8, 1]).substates::<Site>().process(grow).build()?;
/// let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
/// let mut batch = Batch::long();
/// while simulation.step_number() < 1000 {
///     let (begin, steps) = (Instant::now(), batch.steps.min(1000 - simulation.step_number()));
///     simulation.run(steps)?;
///     batch.adapt(steps, begin.elapsed());
///     // Here the program looks for an interrupt, and shows how far it is.
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Batch {
    /// The number of steps to do next, at least one.
    pub steps: u64,
    /// The wanted time of a batch, in milliseconds.
    wanted: Range<u128>,
}

impl Batch {
    /// Batches of 0.1 to 0.4 seconds. That is long enough for an engine to do steps together, and for parts
    /// of a space to run on without their host. `mpirun` kills processes a second after an interrupt.
    pub fn long() -> Self {
        Self { steps: 1, wanted: 100..400 }
    }

    /// Batches of 20 to 80 milliseconds, for pictures that move.
    pub fn brief() -> Self {
        Self { steps: 1, wanted: 20..80 }
    }

    /// Adapts the number to the time of so many steps. A part of a batch does not make it larger.
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
        for (mut batch, wanted) in [(Batch::long(), 200), (Batch::brief(), 50)] {
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
