//! The times of engines, without the checks.

use super::error::CompareError;
use super::lane::Lane;
use super::plan::Watch;
use serde::Serialize;
use std::time::Instant;

/// The number of pieces of a timed run. It can be interrupted between them.
const PIECES: u64 = 16;

/// Runs all engines from the start, `repeats` times. They take turns, and each repeat begins with the next
/// engine. A temporary disturbance of the machine therefore affects all of them.
pub(super) fn run(
    lanes: &mut [Lane<'_>],
    steps: u64,
    repeats: usize,
    watch: &mut Watch<'_>,
) -> Result<(), CompareError> {
    let number = lanes.len();
    for repeat in 0..repeats {
        for turn in 0..number {
            let lane = &mut lanes[(repeat + turn) % number];
            if !lane.has_failed() {
                once(lane, steps, watch)?;
            }
        }
    }
    Ok(())
}

fn once(lane: &mut Lane<'_>, steps: u64, watch: &mut Watch<'_>) -> Result<(), CompareError> {
    let begin = Instant::now();
    lane.simulation.restore(&lane.initial)?;
    lane.times.put.push(begin.elapsed().as_secs_f64());
    let mut seconds = 0.0;
    while lane.simulation.step_number() < steps && lane.simulation.stop_reason().is_none() {
        let done = lane.simulation.step_number();
        let begin = Instant::now();
        lane.simulation.run(steps.div_ceil(PIECES).min(steps - done))?;
        seconds += begin.elapsed().as_secs_f64();
        watch.did(lane.simulation.step_number() - done)?;
    }
    lane.times.step.push(seconds / lane.simulation.step_number().max(1) as f64);
    let begin = Instant::now();
    let end = lane.simulation.snapshot()?;
    lane.times.get.push(begin.elapsed().as_secs_f64());
    let changed = "run again from the same state, it ended in another one".to_owned();
    if lane.findings.end.as_ref() != Some(&end) && !lane.findings.remarks.contains(&changed) {
        lane.findings.remarks.push(changed);
    }
    Ok(())
}

/// The spread of repeated measurements.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spread {
    /// The median.
    pub median: f64,
    /// The least value.
    pub least: f64,
    /// The largest value.
    pub largest: f64,
}

impl Spread {
    /// `None` if there are no values.
    pub fn of(values: &[f64]) -> Option<Self> {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let (least, largest) = (*sorted.first()?, *sorted.last()?);
        let median = f64::midpoint(sorted[(sorted.len() - 1) / 2], sorted[sorted.len() / 2]);
        Some(Self { median, least, largest })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_of_all_values_are_below_the_median() {
        assert_eq!(Spread::of(&[]), None);
        assert_eq!(Spread::of(&[3.0, 1.0, 9.0]), Some(Spread { median: 3.0, least: 1.0, largest: 9.0 }));
        assert_eq!(Spread::of(&[4.0, 1.0]).map(|spread| spread.median), Some(2.5));
    }
}
