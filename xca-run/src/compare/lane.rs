//! A contender with its simulation, and what has been found of it.

use super::CompareError;
use super::contender::Contender;
use super::difference::{Differences, Side, Worst};
use super::verdict::Verdict;
use serde::Serialize;
use std::time::{Duration, Instant};
use xca_core::{Model, RunOptions, Simulation, Snapshot};
use xca_record::Observable;

/// A contender on its way.
pub(crate) struct Lane<'a> {
    pub(crate) contender: &'a Contender,
    pub(crate) simulation: Simulation,
    /// The state from which it starts.
    pub(crate) initial: Snapshot,
    /// Making the engine and its simulation.
    pub(crate) set_up: Duration,
    pub(crate) findings: Findings,
    pub(crate) times: Times,
}

/// What was found of an engine's results.
#[derive(Debug)]
pub(crate) struct Findings {
    /// The worst of all checks.
    pub(crate) verdict: Verdict,
    pub(crate) first_difference: Option<FirstDifference>,
    pub(crate) history: Vec<Check>,
    /// At the last check.
    pub(crate) last: Option<Differences>,
    /// Why the engine did not come to the end.
    pub(crate) failure: Option<String>,
    /// What else there is to tell.
    pub(crate) remarks: Vec<String>,
    /// At the start and at the end.
    pub(crate) observables: [Vec<Observable>; 2],
    /// The state at the end.
    pub(crate) end: Option<Snapshot>,
}

/// Where an engine leaves the first one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct FirstDifference {
    /// The number of steps done when it is seen.
    pub(crate) step: u64,
    /// Whether this is the exact step; else the two ran alike when they were run again.
    pub(crate) is_exact: bool,
    pub(crate) substate: Option<String>,
    pub(crate) worst: Option<Worst>,
}

/// How far an engine is from the first one after some step.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Check {
    pub(crate) step: u64,
    /// Of each substate, the root mean square of its differences in relation to its largest value.
    pub(crate) substates: Vec<(String, f64)>,
}

/// What the repeats took, in seconds.
#[derive(Debug, Default)]
pub(crate) struct Times {
    /// Of one step.
    pub(crate) step: Vec<f64>,
    /// Giving the engine a state.
    pub(crate) put: Vec<f64>,
    /// Taking the state from it.
    pub(crate) get: Vec<f64>,
}

impl<'a> Lane<'a> {
    /// Starts a contender in a state, or in the model's own where the state is of another precision.
    pub(crate) fn start(
        model: &Model,
        contender: &'a Contender,
        seed: u64,
        initial: Option<&Snapshot>,
    ) -> Result<Self, CompareError> {
        let options = RunOptions { precision: contender.precision, seed };
        let own = match initial {
            Some(initial) => initial.clone(),
            None => Simulation::new(model, &*contender.engine, options)?.snapshot()?,
        };
        let begin = Instant::now();
        let simulation = Simulation::resume(model, &*contender.engine, options, &own)?;
        let set_up = contender.making + begin.elapsed();
        let (findings, times) = (Findings::none(), Times::default());
        Ok(Self { contender, simulation, initial: own, set_up, findings, times })
    }

    pub(crate) fn has_failed(&self) -> bool {
        self.findings.failure.is_some()
    }

    pub(crate) fn side<'s>(&self, snapshot: &'s Snapshot) -> Side<'s> {
        Side { snapshot, precision: self.contender.precision }
    }
}

impl Findings {
    fn none() -> Self {
        Self {
            verdict: Verdict::Identical,
            first_difference: None,
            history: Vec::new(),
            last: None,
            failure: None,
            remarks: Vec::new(),
            observables: [Vec::new(), Vec::new()],
            end: None,
        }
    }
}

impl FirstDifference {
    pub(crate) fn new(step: u64, is_exact: bool, differences: &Differences) -> Self {
        let gravest = differences.gravest();
        Self {
            step,
            is_exact,
            substate: gravest.map(|difference| difference.substate.clone()),
            worst: gravest.and_then(|difference| difference.worst.clone()),
        }
    }
}

impl Check {
    pub(crate) fn new(step: u64, differences: &Differences) -> Self {
        let substates = differences.substates.iter();
        let substates = substates.map(|difference| (difference.substate.clone(), difference.relative_rms()));
        Self { step, substates: substates.collect() }
    }
}
