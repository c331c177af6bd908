//! One model on several engines: what each takes, and whether they agree.
//!
//! The engines run beside the first one, with a check every so many steps ([`lockstep`]); then each is timed ([`timing`]). What comes of it
//! is a [`Comparison`], which [`report`] tells as text, Markdown, CSV, JSON and a page for browsers.

mod contender;
mod difference;
mod lane;
mod lockstep;
pub(crate) mod report;
mod result;
mod timing;
mod verdict;

pub(crate) use contender::{Choice, Contender};
pub(crate) use result::{Comparison, Subject};
pub(crate) use verdict::Verdict;

use lane::Lane;
use xca_core::RunError;
use xca_record::record::{RecordError, Recorder};

/// A comparison that does not come to its end.
#[derive(Debug, thiserror::Error)]
pub(crate) enum CompareError {
    /// An engine cannot run the model, or the first one fails.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The observables cannot be measured.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// The user did not want to wait.
    #[error("interrupted")]
    Interrupted,
}

/// How engines are compared.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Plan {
    pub(crate) seed: u64,
    pub(crate) steps: u64,
    /// How many steps from check to check.
    pub(crate) every: u64,
    /// How often each engine is timed.
    pub(crate) repeats: usize,
    /// How far rounded numbers may be apart, in relation to the largest value of their substate.
    pub(crate) tolerance: f64,
}

impl Plan {
    /// How many steps all engines do together.
    pub(crate) fn work(&self, engines: usize) -> u64 {
        self.steps.saturating_mul(engines as u64).saturating_mul(self.repeats as u64 + 1)
    }
}

/// Compares engines with the first of them. `watch` is told how many steps more are done, and says whether to go on.
pub(crate) fn compare(
    recorder: &Recorder,
    contenders: &[Contender],
    plan: &Plan,
    subject: Subject,
    watch: &mut dyn FnMut(u64) -> bool,
) -> Result<Comparison, CompareError> {
    let model = recorder.model();
    let mut lanes: Vec<Lane<'_>> = Vec::with_capacity(contenders.len());
    for contender in contenders {
        let same = lanes.first().filter(|first| first.contender.precision == contender.precision);
        let initial = same.map(|first| first.initial.clone());
        lanes.push(Lane::start(model, contender, plan.seed, initial.as_ref())?);
    }
    for lane in &mut lanes {
        lane.findings.observables[0] = recorder.measure(&mut lane.simulation, &lane.initial)?;
    }
    let done = lockstep::run(model, &mut lanes, plan, watch)?;
    for lane in &mut lanes {
        if let (Some(end), false) = (&lane.findings.end, lane.has_failed()) {
            lane.findings.observables[1] = recorder.measure(&mut lane.simulation, end)?;
        }
    }
    timing::run(&mut lanes, done, plan.repeats, watch)?;
    Ok(Comparison::new(subject, plan, done, model, lanes))
}

#[cfg(test)]
mod tests;
