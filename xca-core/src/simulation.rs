//! A model on an engine.

mod batch;
mod blocks;
mod finite;
mod labelled;
mod outputs;
mod restore;
mod snapshot;

pub use batch::Batch;
pub use snapshot::{GroupSnapshot, ItemCounts, Outline, Snapshot, SnapshotError};

use crate::engine::{Engine, EngineFailure, Execution, Fault, Figure, Interruption, StartError, StepContext};
use crate::model::Model;
use crate::parameter_set::ParameterSet;
use crate::state::State;
use crate::steering::{Schedule, SteeringError};
use std::fmt;
use xca_process::Geometry;
use xca_process::ParameterError;
use xca_values::Precision;

/// The options of a run: precision and seed. Default: `f64`, seed 0.
///
/// ```
/// use xca_core::prelude::*;
///
/// let options = RunOptions { precision: Precision::F32, ..RunOptions::default() };
/// assert_eq!(options.seed, 0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct RunOptions {
    /// The type that `Real` stands for.
    pub precision: Precision,
    /// The seed of random numbers.
    pub seed: u64,
}

/// The reason why [`Simulation::run`] returned.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Outcome {
    /// All steps are done.
    StepsDone,
    /// A stop criterion or another steering operation ended the run.
    Stopped {
        /// The reason that the operation gave.
        reason: String,
    },
}

/// An error that ends a run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RunError {
    /// The engine cannot run the model.
    #[error(transparent)]
    Start(#[from] StartError),
    /// A parameter is out of its range in the precision of the run.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// The engine lost its state.
    #[error(transparent)]
    Engine(#[from] EngineFailure),
    /// A fault within a step.
    #[error("step {step}: {}{fault}", text.as_ref().map(|text| format!("{text}: ")).unwrap_or_default())]
    Fault {
        /// The number of the step, from 1 for the first.
        step: u64,
        /// The model's message for the fault code.
        text: Option<String>,
        /// The fault.
        fault: Fault,
    },
    /// A steering operation failed.
    #[error("steering after step {step} failed: {source}")]
    Steering {
        /// The number of steps done.
        step: u64,
        /// Its error.
        source: SteeringError,
    },
    /// A step was asked for after a fault.
    #[error(
        "the run ended with a fault in step {step} and cannot continue; restore a snapshot of an earlier step"
    )]
    Broken {
        /// The number of that step.
        step: u64,
    },
    /// The model has no process with this number.
    #[error("the model has {processes} processes, no process {index}")]
    NoSuchProcess {
        /// The number, from 0.
        index: usize,
        /// The number of processes.
        processes: usize,
    },
    /// The simulation cannot continue from the snapshot.
    #[error(transparent)]
    Snapshot(#[from] SnapshotError),
}

/// One run of a model on an engine.
///
/// ```
/// use xca_core::prelude::*;
///
/// #[derive(Substates, Clone, Copy)]
/// struct Counter {
///     count: u32,
/// }
///
/// #[elementary_process]
/// fn count(cell: &mut Cell<Counter>) {
///     cell.count += 1;
/// }
///
/// let model = Model::builder("counters")
///     .extents([4, 4, 1])
///     .substates::<Counter>()
///     .process(count)
///     .stop_when(Schedule::Every(1), |state| {
///         Ok((state.step() == 20).then(|| "twenty".to_owned()))
///     })
///     .build()?;
/// let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
/// simulation.step()?;
/// assert_eq!(simulation.state().get(Counter::COUNT, [0, 0, 0])?, 1);
/// assert_eq!(simulation.run(9)?, Outcome::StepsDone);
/// assert_eq!(simulation.run(90)?, Outcome::Stopped { reason: "twenty".to_owned() });
/// assert_eq!(simulation.step_number(), 20);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// [`Simulation::snapshot`] saves the state, and [`Simulation::resume`] continues from it on any engine.
pub struct Simulation {
    model: Model,
    execution: Box<dyn Execution>,
    /// How many items of each population had left, beyond those that the engine has counted, when a snapshot
    /// was restored.
    left_before: Vec<u64>,
    parameters: ParameterSet,
    options: RunOptions,
    step: u64,
    /// The step that ended with a fault.
    faulty: Option<u64>,
    stop: Option<String>,
}

impl Simulation {
    /// Starts a model on an engine and makes its initial state.
    ///
    /// # Errors
    /// Returns an error if the engine cannot run the model, or the initial state fails.
    pub fn new(model: &Model, engine: &dyn Engine, options: RunOptions) -> Result<Self, RunError> {
        let mut simulation = Self::empty(model, engine, options)?;
        simulation.steer(|schedule| *schedule == Schedule::Start)?;
        simulation.watch(|schedule| *schedule == Schedule::Start || schedule.is_due(0))?;
        simulation.steer(|schedule| schedule.is_due(0))?;
        Ok(simulation)
    }

    /// A model on an engine, before anything is in it.
    fn empty(model: &Model, engine: &dyn Engine, options: RunOptions) -> Result<Self, RunError> {
        model.parameters().check(options.precision)?;
        check_lengths(model.geometry(), options.precision)?;
        Ok(Self {
            model: model.clone(),
            execution: engine.start(model, options.precision)?,
            left_before: vec![0; model.groups().len()],
            parameters: model.parameters().clone(),
            options,
            step: 0,
            faulty: None,
            stop: None,
        })
    }

    /// The model.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// The precision and the seed of the run.
    pub fn options(&self) -> RunOptions {
        self.options
    }

    /// The number of steps done.
    pub fn step_number(&self) -> u64 {
        self.step
    }

    /// The reason of the steering operation that ended the run, if one did.
    pub fn stop_reason(&self) -> Option<&str> {
        self.stop.as_deref()
    }

    /// The size of the state in bytes.
    pub fn memory(&self) -> usize {
        self.execution.memory()
    }

    /// Measurements of the engine, such as work that it skipped. They are not results: they differ between
    /// engines, threads and machines.
    pub fn figures(&self) -> Vec<Figure> {
        self.execution.figures()
    }

    /// The state, to read or to change.
    pub fn state(&mut self) -> State<'_> {
        self.state_for(u32::MAX)
    }

    /// The state for the steering operation with this number.
    fn state_for(&mut self, operation: u32) -> State<'_> {
        State {
            structure: self.model.structure(),
            execution: &mut *self.execution,
            left_before: &self.left_before,
            parameters: &mut self.parameters,
            precision: self.options.precision,
            seed: self.options.seed,
            step: self.step,
            operation,
            stop: &mut self.stop,
            reduced_nan: std::cell::Cell::new(false),
            undecided: false,
        }
    }

    fn steer(&mut self, due: impl Fn(&Schedule) -> bool) -> Result<(), RunError> {
        for index in 0..self.model.steering().len() {
            if due(&self.model.steering()[index].schedule) {
                let operation = self.model.steering()[index].operation.clone();
                let step = self.step;
                let mut state = self.state_for(index as u32);
                operation(&mut state).map_err(|source| RunError::Steering { step, source })?;
                if state.undecided {
                    self.expect_finite()?;
                }
            }
        }
        Ok(())
    }

    /// Checks that substates are finite, where the model wants it now. A state that is not cannot go on.
    fn watch(&mut self, due: impl Fn(&Schedule) -> bool) -> Result<(), RunError> {
        if !self.model.watches().iter().any(due) {
            return Ok(());
        }
        self.expect_finite()
    }

    /// Breaks the simulation where a substate is not finite.
    fn expect_finite(&mut self) -> Result<(), RunError> {
        let result = self.check_finite();
        if let Err(RunError::Fault { step, .. }) = &result {
            self.faulty = Some(*step);
            self.stop = None;
        }
        result
    }

    /// Has the engine work on the state, and keeps account of the steps that it did.
    fn work(
        &mut self,
        work: impl FnOnce(&mut dyn Execution, &StepContext<'_>) -> Result<u64, Interruption>,
    ) -> Result<(), RunError> {
        if let Some(step) = self.faulty {
            return Err(RunError::Broken { step });
        }
        let parameters = self.parameters.kernel_views(self.options.precision);
        let context = StepContext {
            step: self.step,
            seed: self.options.seed,
            parameters: &parameters,
            values: &self.parameters,
        };
        match work(&mut *self.execution, &context) {
            Ok(done) => {
                self.step += done;
                Ok(())
            }
            Err(Interruption { done, fault }) => {
                self.step += done;
                self.faulty = Some(self.step + 1);
                let text = match &fault {
                    Fault::Reported { code, .. } => self.model.fault_text(*code).map(str::to_owned),
                    _ => None,
                };
                Err(RunError::Fault { step: self.step + 1, text, fault })
            }
        }
    }

    /// Does so many steps that have no steering between them, then the steering that is due.
    fn leap(&mut self, steps: u64) -> Result<(), RunError> {
        self.work(|execution, context| execution.run_steps(steps, context).map(|()| steps))?;
        let step = self.step;
        self.watch(|schedule| schedule.is_due(step))?;
        self.steer(|schedule| schedule.is_due(step))
    }

    /// How many of the next steps have no steering between them.
    fn unsteered(&self, most: u64) -> u64 {
        let steering = self.model.steering().iter().map(|steering| &steering.schedule);
        let all = steering.chain(self.model.watches());
        let due = all.filter_map(|schedule| schedule.next_after(self.step));
        due.map(|step| step - self.step).fold(most, u64::min)
    }

    /// Runs one step: all processes in order, then the checks and the steering that are due.
    ///
    /// # Errors
    /// Returns an error if a process faults, a steering operation fails, or a watched substate is not finite.
    pub fn step(&mut self) -> Result<(), RunError> {
        self.leap(1)
    }

    /// Runs up to `steps` steps. Returns earlier if a steering operation stops the run. A stopped run does no
    /// more steps.
    ///
    /// # Errors
    /// As [`Self::step`].
    pub fn run(&mut self, steps: u64) -> Result<Outcome, RunError> {
        let Some(workers) = self.execution.workers() else { return self.run_here(steps) };
        let mut result = Ok(Outcome::StepsDone);
        workers.run(&mut || result = self.run_here(steps));
        result
    }

    fn run_here(&mut self, steps: u64) -> Result<Outcome, RunError> {
        let mut left = steps;
        while left > 0 && self.stop.is_none() {
            let leap = self.unsteered(left);
            self.leap(leap)?;
            left -= leap;
        }
        Ok(match &self.stop {
            Some(reason) => Outcome::Stopped { reason: reason.clone() },
            None => Outcome::StepsDone,
        })
    }

    /// Runs the steering of [`Schedule::End`].
    ///
    /// # Errors
    /// Returns an error if a steering operation fails, or a substate watched at the end is not finite.
    pub fn finish(&mut self) -> Result<(), RunError> {
        self.steer(|schedule| *schedule == Schedule::End)?;
        self.watch(|schedule| *schedule == Schedule::End)
    }

    /// Runs a single process, by its number in the model, for debugging. The process belongs to the next
    /// step; the step number does not change. Does nothing if the process is not due in that step.
    ///
    /// # Errors
    /// Returns an error if the process faults, or no process has the number.
    pub fn run_process(&mut self, index: usize) -> Result<(), RunError> {
        let processes = self.model.processes().len();
        if index >= processes {
            return Err(RunError::NoSuchProcess { index, processes });
        }
        self.work(|execution, context| {
            let result = execution.run(index..index + 1, context);
            result.map(|()| 0).map_err(|fault| Interruption { done: 0, fault })
        })
    }
}

/// Whether the cell side and the lengths of the space are positive numbers of the precision.
fn check_lengths(geometry: &Geometry, precision: Precision) -> Result<(), StartError> {
    let (side, extents) = (geometry.side(), geometry.extents());
    let longest = extents.into_iter().max().unwrap_or(0) as f64 * side;
    let fits = match precision {
        Precision::F32 => side as f32 > 0.0 && (longest as f32).is_finite(),
        Precision::F64 => true,
    };
    if fits { Ok(()) } else { Err(StartError::Length { side, extents, precision }) }
}

impl fmt::Debug for Simulation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Simulation")
            .field("model", &self.model.name())
            .field("options", &self.options)
            .field("step", &self.step)
            .finish_non_exhaustive()
    }
}
