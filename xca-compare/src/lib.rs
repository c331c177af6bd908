//! Comparison of engines on one model: their results and their speed.
//!
//! All engines run alongside the first one, with a check at regular intervals (`lockstep`). Then each engine
//! is timed (`timing`). The result is a [`ComparisonReport`].

#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should"))]

mod contender;
mod difference;
mod error;
mod lane;
mod lockstep;
mod plan;
mod result;
mod timing;
mod verdict;

pub use contender::Contender;
pub use difference::{Difference, Differences, Kind, Place, Worst};
pub use error::CompareError;
pub use lane::{Check, FirstDifference};
pub use result::{ComparisonReport, EngineResult, ObservableResult, Subject};
pub use timing::Spread;
pub use verdict::Verdict;

use lane::Lane;
use plan::{Plan, Watch};
use std::time::Duration;
use xca_core::{Engine, Precision};
use xca_machine::check_memory;
use xca_record::Monitor;
use xca_record::record::Recorder;
use xca_record::{SetUp, SetUpError};

/// The default number of checks.
const CHECKS: u64 = 50;

/// A comparison of engines on one model.
///
/// ```
/// use xca_core::prelude::*;
/// use xca_compare::{Comparison, Verdict};
/// use xca_record::SetUp;
///
/// #[derive(Substates, Clone)]
/// struct Colony {
///     size: Real,
/// }
///
/// #[elementary_process]
/// fn grow(cell: &mut Cell<Colony>) {
///     cell.size *= 1.01;
/// }
///
/// let model = Model::builder("growth")
///     .extents([8, 8, 1])
///     .substates::<Colony>()
///     .process(grow)
///     .fill(|_| Colony { size: 1.0 })
///     .build()?;
/// let comparison = Comparison::new(SetUp::new(model, 100))?
///     .engine("first", Box::new(Reference))
///     .engine("second", Box::new(Reference));
/// let report = comparison.run(&mut ())?;
/// assert_eq!(report.verdict, Verdict::Identical);
/// assert!(report.engines[1].speed_up.is_some());
/// # Ok::<(), Box<dyn std::error::Error + Send + Sync>>(())
/// ```
#[derive(Debug)]
pub struct Comparison {
    recorder: Recorder,
    subject: Subject,
    contenders: Vec<Contender>,
    seed: u64,
    steps: u64,
    every: Option<u64>,
    repeats: usize,
    tolerance: Option<f64>,
}

impl Comparison {
    /// A comparison over all steps of a set-up, with 50 checks and three timings of each engine.
    ///
    /// # Errors
    /// If a view or the time step of the set-up is invalid.
    pub fn new(set_up: SetUp) -> Result<Self, SetUpError> {
        set_up.check()?;
        let steps = set_up.steps;
        let subject = Subject {
            program: set_up.model.name().to_owned(),
            title: set_up.title.clone(),
            ..Subject::default()
        };
        Ok(Self {
            recorder: Recorder::new(set_up)?,
            subject,
            contenders: Vec::new(),
            seed: 0,
            steps,
            every: None,
            repeats: 3,
            tolerance: None,
        })
    }

    /// Adds an engine in `f64`. The first engine is the reference of all others.
    #[must_use]
    pub fn engine(self, name: impl Into<String>, engine: Box<dyn Engine>) -> Self {
        self.engine_in(Precision::F64, name, engine)
    }

    /// Adds an engine with this precision.
    #[must_use]
    pub fn engine_in(self, precision: Precision, name: impl Into<String>, engine: Box<dyn Engine>) -> Self {
        self.contender(Contender { name: name.into(), engine, precision, making: Duration::ZERO })
    }

    /// Adds an engine and the time it took to create it.
    #[must_use]
    pub fn contender(mut self, contender: Contender) -> Self {
        self.contenders.push(contender);
        self
    }

    /// Sets the seed of random numbers. Default: 0.
    #[must_use]
    pub fn seed(self, seed: u64) -> Self {
        Self { seed, ..self }
    }

    /// Sets the number of steps.
    #[must_use]
    pub fn steps(self, steps: u64) -> Self {
        Self { steps, ..self }
    }

    /// Sets the number of steps between checks, at least 1. The exact step of a difference is searched for
    /// between two checks.
    #[must_use]
    pub fn check_every(self, steps: u64) -> Self {
        Self { every: Some(steps.max(1)), ..self }
    }

    /// Sets the number of timings per engine.
    #[must_use]
    pub fn repeats(self, repeats: usize) -> Self {
        Self { repeats, ..self }
    }

    /// Sets the largest difference that counts as rounding, relative to the largest value of the substate.
    /// Default: 1e-9, or 1e-4 with an engine in `f32`.
    #[must_use]
    pub fn tolerance(self, tolerance: f64) -> Self {
        Self { tolerance: Some(tolerance), ..self }
    }

    /// Sets what the report states about the program.
    #[doc(hidden)]
    #[must_use]
    pub fn subject(self, subject: Subject) -> Self {
        Self { subject, ..self }
    }

    #[doc(hidden)]
    pub fn set_up(&self) -> &SetUp {
        self.recorder.set_up()
    }

    /// The number of steps of all engines together.
    pub fn work(&self) -> u64 {
        let runs = (self.contenders.len() as u64).saturating_mul(self.repeats as u64 + 1);
        self.steps.saturating_mul(runs)
    }

    fn plan(&self) -> Plan {
        let is_single = self.contenders.iter().any(|contender| contender.precision == Precision::F32);
        Plan {
            seed: self.seed,
            steps: self.steps,
            every: self.every.unwrap_or(self.steps.div_ceil(CHECKS).max(1)),
            repeats: self.repeats,
            tolerance: self.tolerance.unwrap_or(if is_single { 1e-4 } else { 1e-9 }),
        }
    }

    /// Compares the engines with the first one. The monitor receives the number of steps done by all engines,
    /// out of [`Self::work`].
    ///
    /// # Errors
    /// If an engine cannot run the model, if the first engine fails, or if the monitor interrupts. A later
    /// failure of another engine is part of the report.
    pub fn run(&self, monitor: &mut dyn Monitor) -> Result<ComparisonReport, CompareError> {
        let model = self.recorder.model();
        let plan = self.plan();
        // A snapshot of the start and one of the end.
        let memory_of = |it: &Contender| {
            it.engine.least_memory(model, it.precision)
                + model.output_memory(it.precision, model.geometry().cells(), |_| 0)
        };
        let memory = self.contenders.iter().map(memory_of).sum();
        check_memory(memory, "this model on all these engines at once")?;
        let mut lanes: Vec<Lane<'_>> = Vec::with_capacity(self.contenders.len());
        for contender in &self.contenders {
            let same = lanes.first().filter(|first| first.contender.precision == contender.precision);
            let initial = same.map(|first| first.initial.clone());
            lanes.push(Lane::start(model, contender, plan.seed, initial.as_ref())?);
        }
        for lane in &mut lanes {
            lane.findings.observables[0] = self.recorder.measure(&mut lane.simulation)?;
        }
        monitor.begin(0);
        let mut watch = Watch { monitor, done: 0 };
        let done = lockstep::run(model, &mut lanes, &plan, &mut watch)?;
        for lane in &mut lanes {
            if lane.findings.end.is_some() && !lane.has_failed() {
                lane.findings.observables[1] = self.recorder.measure(&mut lane.simulation)?;
            }
        }
        timing::run(&mut lanes, done, plan.repeats, &mut watch)?;
        Ok(ComparisonReport::new(self.subject.clone(), &plan, done, model, lanes))
    }
}
