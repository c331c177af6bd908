//! A contender with its simulation, and what has been found of it.

use super::contender::Contender;
use super::difference::{Differences, Side, Worst};
use super::error::CompareError;
use super::verdict::Verdict;
use serde::Serialize;
use std::time::{Duration, Instant};
use xca_core::{Model, RunOptions, Simulation, Snapshot};
use xca_record::Observable;

/// A contender on its way.
pub(super) struct Lane<'a> {
    pub contender: &'a Contender,
    pub simulation: Simulation,
    /// The state from which it starts.
    pub initial: Snapshot,
    /// Making the engine and its simulation.
    pub set_up: Duration,
    pub findings: Findings,
    pub times: Times,
}

/// What was found of an engine's results.
#[derive(Debug)]
pub(super) struct Findings {
    /// The worst of all checks.
    pub verdict: Verdict,
    pub first_difference: Option<FirstDifference>,
    pub history: Vec<Check>,
    /// At the last check.
    pub last: Option<Differences>,
    /// Why the engine did not come to the end.
    pub failure: Option<String>,
    /// What else there is to tell.
    pub remarks: Vec<String>,
    /// At the start and at the end.
    pub observables: [Vec<Observable>; 2],
    /// The state at the end.
    pub end: Option<Snapshot>,
}

/// Where an engine leaves the first one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FirstDifference {
    /// The number of steps done when it is seen.
    pub step: u64,
    /// Whether this is the exact step; else the two ran alike when they were run again.
    pub is_exact: bool,
    /// The substate that differs most gravely.
    pub substate: Option<String>,
    /// The value in it that differs most.
    pub worst: Option<Worst>,
}

/// How far an engine is from the first one after some step.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Check {
    /// The number of steps done.
    pub step: u64,
    /// Of each substate, the root mean square of its differences in relation to its largest value.
    pub substates: Vec<(String, f64)>,
}

/// What the repeats took, in seconds.
#[derive(Debug, Default)]
pub(super) struct Times {
    /// Of one step.
    pub step: Vec<f64>,
    /// Giving the engine a state.
    pub put: Vec<f64>,
    /// Taking the state from it.
    pub get: Vec<f64>,
}

impl<'a> Lane<'a> {
    /// Starts a contender in a state, or in the model's own where the state is of another precision.
    pub(super) fn start(
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

    pub(super) fn has_failed(&self) -> bool {
        self.findings.failure.is_some()
    }

    pub(super) fn side<'s>(&self, snapshot: &'s Snapshot) -> Side<'s> {
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
    /// The gravest of the differences after that step.
    pub fn new(step: u64, is_exact: bool, differences: &Differences) -> Self {
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
    /// The differences of all substates after that step.
    pub fn new(step: u64, differences: &Differences) -> Self {
        let substates = differences.substates.iter();
        let substates = substates.map(|difference| (difference.substate.clone(), difference.relative_rms()));
        Self { step, substates: substates.collect() }
    }
}
