//! How many steps are done at a time.

use std::time::Duration;

/// How many steps are done at a time: an engine with threads does many faster than one by one, but Ctrl-C and
/// the line that shows how far the run has come must not wait for long.
#[derive(Debug)]
pub struct Batch {
    pub steps: u64,
}

impl Default for Batch {
    fn default() -> Self {
        Self { steps: 1 }
    }
}

impl Batch {
    pub fn adapt(&mut self, took: Duration) {
        match took.as_millis() {
            0..20 => self.steps = self.steps.saturating_mul(2),
            20..80 => {}
            _ => self.steps = (self.steps / 2).max(1),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn batches_follow_the_time_that_a_step_takes() {
        let mut batch = Batch::default();
        for _ in 0..6 {
            batch.adapt(Duration::from_millis(1));
        }
        assert_eq!(batch.steps, 64);
        batch.adapt(Duration::from_millis(50));
        assert_eq!(batch.steps, 64);
        for _ in 0..10 {
            batch.adapt(Duration::from_millis(500));
        }
        assert_eq!(batch.steps, 1);
    }
}
