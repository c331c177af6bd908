//! A contender with its simulation and its results.

use super::contender::Contender;
use super::difference::{Differences, Side, Worst};
use super::error::CompareError;
use super::verdict::Verdict;
use serde::Serialize;
use std::time::{Duration, Instant};
use xca_core::{Model, RunOptions, Simulation, Snapshot};
use xca_record::Observable;

/// A contender in progress.
pub(super) struct Lane<'a> {
    pub contender: &'a Contender,
    pub simulation: Simulation,
    /// The initial state.
    pub initial: Snapshot,
    /// The time to create the engine and its simulation.
    pub set_up: Duration,
    pub findings: Findings,
    pub times: Times,
}

/// The results of an engine.
#[derive(Debug)]
pub(super) struct Findings {
    /// The worst verdict of all checks.
    pub verdict: Verdict,
    pub first_difference: Option<FirstDifference>,
    pub history: Vec<Check>,
    /// The differences at the last check.
    pub last: Option<Differences>,
    /// The error that ended the engine's run.
    pub failure: Option<String>,
    /// Other remarks.
    pub remarks: Vec<String>,
    /// The observables at the start and at the end.
    pub observables: [Vec<Observable>; 2],
    /// The final state.
    pub end: Option<Snapshot>,
}

/// The first step after which an engine differs from the first one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FirstDifference {
    /// The number of steps done.
    pub step: u64,
    /// Whether the step is exact. If not, the engines agreed when the steps were repeated.
    pub is_exact: bool,
    /// The substate with the gravest difference.
    pub substate: Option<String>,
    /// Its value with the largest difference.
    pub worst: Option<Worst>,
}

/// The distance of an engine from the first one after a step.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Check {
    /// The number of steps done.
    pub step: u64,
    /// Each substate, with the root mean square of its differences relative to its largest value.
    pub substates: Vec<(String, f64)>,
}

/// The times of the repeats in seconds.
#[derive(Debug, Default)]
pub(super) struct Times {
    /// The time of one step.
    pub step: Vec<f64>,
    /// The time to set the state.
    pub put: Vec<f64>,
    /// The time to get the state.
    pub get: Vec<f64>,
}

impl<'a> Lane<'a> {
    /// Starts a contender in a state. Without a state it starts in the model's initial state at its own
    /// precision.
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
    /// The gravest of `differences` after a step.
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
    /// The differences of all substates after a step.
    pub fn new(step: u64, differences: &Differences) -> Self {
        let substates = differences.substates.iter();
        let substates = substates.map(|difference| (difference.substate.clone(), difference.relative_rms()));
        Self { step, substates: substates.collect() }
    }
}
