//! Honest timing on a noisy machine: contenders take turns, and the figures are medians with their spread.

use std::time::Instant;

/// Seconds of repeated runs.
#[derive(Debug, Clone)]
pub(crate) struct Times(Vec<f64>);

impl Times {
    /// The middle one.
    pub(crate) fn median(&self) -> f64 {
        self.0[self.0.len() / 2]
    }

    /// The shortest and the longest.
    pub(crate) fn spread(&self) -> (f64, f64) {
        (self.0[0], self.0[self.0.len() - 1])
    }
}

/// Runs the contenders in turns: one round to warm up, then `rounds` that count, at least one.
pub(crate) fn interleaved(rounds: usize, contenders: &mut [&mut dyn FnMut()]) -> Vec<Times> {
    let mut times = vec![Vec::with_capacity(rounds); contenders.len()];
    for round in 0..=rounds.max(1) {
        for (contender, times) in contenders.iter_mut().zip(&mut times) {
            let start = Instant::now();
            contender();
            if round > 0 {
                times.push(start.elapsed().as_secs_f64());
            }
        }
    }
    times
        .into_iter()
        .map(|mut times| {
            times.sort_by(f64::total_cmp);
            Times(times)
        })
        .collect()
}

impl Times {
    /// The times of one of so many equal parts.
    pub(crate) fn per(&self, parts: usize) -> Self {
        Self(self.0.iter().map(|time| time / parts as f64).collect())
    }
}
