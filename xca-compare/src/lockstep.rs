//! Runs all engines alongside the first one, to find where they differ.

use super::difference::Differences;
use super::error::CompareError;
use super::lane::{Check, FirstDifference, Lane};
use super::plan::{Plan, Watch};
use xca_core::{Model, Snapshot};

/// Runs all engines to the end, with a check every `every` steps. Returns the number of steps done.
pub(super) fn run(
    model: &Model,
    lanes: &mut [Lane<'_>],
    plan: &Plan,
    watch: &mut Watch<'_>,
) -> Result<u64, CompareError> {
    let mut before: Vec<Snapshot> = lanes.iter().map(|lane| lane.initial.clone()).collect();
    look(model, lanes, plan.tolerance, &before, &before)?;
    loop {
        let Some(first) = lanes.first() else { return Ok(0) };
        let done = first.simulation.step_number();
        if done >= plan.steps || first.simulation.stop_reason().is_some() {
            break;
        }
        let ahead = plan.every.min(plan.steps - done);
        for (number, lane) in lanes.iter_mut().enumerate().filter(|(_, lane)| !lane.has_failed()) {
            match lane.simulation.run(ahead) {
                Err(error) if number > 0 => lane.findings.failure = Some(error.to_string()),
                result => {
                    result?;
                }
            }
            watch.did(ahead)?;
        }
        let mut now = Vec::with_capacity(lanes.len());
        for lane in lanes.iter() {
            now.push(lane.simulation.snapshot()?);
        }
        look(model, lanes, plan.tolerance, &before, &now)?;
        before = now;
    }
    for (lane, end) in lanes.iter_mut().zip(before) {
        lane.findings.end = Some(end);
    }
    Ok(lanes.first().map_or(0, |first| first.simulation.step_number()))
}

/// Compares all engines with the first. `before` holds their states at the previous check.
fn look(
    model: &Model,
    lanes: &mut [Lane<'_>],
    tolerance: f64,
    before: &[Snapshot],
    now: &[Snapshot],
) -> Result<(), CompareError> {
    let [first, others @ ..] = lanes else { return Ok(()) };
    for (number, lane) in others.iter_mut().enumerate().filter(|(_, lane)| !lane.has_failed()) {
        let (start, state) = ([&before[0], &before[number + 1]], [&now[0], &now[number + 1]]);
        let differences = Differences::between(model, first.side(state[0]), lane.side(state[1]));
        lane.findings.history.push(Check::new(state[0].step, &differences));
        if lane.findings.first_difference.is_none() && !differences.is_identical() {
            let found = if start[0].step == state[0].step {
                FirstDifference::new(state[0].step, true, &differences)
            } else {
                let found = bisect(model, [&mut *first, &mut *lane], start, state[0].step)?;
                first.simulation.restore(state[0])?;
                lane.simulation.restore(state[1])?;
                found.unwrap_or_else(|| FirstDifference::new(state[0].step, false, &differences))
            };
            lane.findings.first_difference = Some(found);
        }
        lane.findings.verdict = lane.findings.verdict.max(differences.verdict(tolerance));
        lane.findings.last = Some(differences);
    }
    Ok(())
}

/// Finds the first step after which two engines differ. They agree in the states `alike`, and differed after
/// the step `differ`. Returns `None` if they do not differ when they run again.
fn bisect(
    model: &Model,
    pair: [&mut Lane<'_>; 2],
    alike: [&Snapshot; 2],
    differ: u64,
) -> Result<Option<FirstDifference>, CompareError> {
    let [first, other] = pair;
    let mut alike = alike.map(Clone::clone);
    let (mut differ, mut found) = (differ, None);
    // Run to `differ` itself too, unless this search has reached it: an engine may not repeat its result.
    while alike[0].step + u64::from(found.is_some()) < differ {
        let ahead = (differ - alike[0].step).div_ceil(2);
        let mut states = Vec::with_capacity(2);
        for (lane, state) in [&mut *first, &mut *other].into_iter().zip(&alike) {
            lane.simulation.restore(state)?;
            lane.simulation.run(ahead)?;
            states.push(lane.simulation.snapshot()?);
        }
        let [a, b] = [states.swap_remove(0), states.swap_remove(0)];
        let differences = Differences::between(model, first.side(&a), other.side(&b));
        if differences.is_identical() {
            alike = [a, b];
        } else {
            differ = a.step;
            found = Some(FirstDifference::new(differ, true, &differences));
        }
    }
    Ok(found)
}
