//! A model on an engine.

mod finite;
mod snapshot;

pub use snapshot::{GroupSnapshot, Snapshot, SnapshotError};

use crate::engine::{Engine, EngineFailure, Execution, Fault, Figure, Interruption, StartError, StepContext};
use crate::model::Model;
use crate::parameter_set::ParameterSet;
use crate::state::State;
use crate::steering::{Schedule, SteeringError};
use std::fmt;
use xca_process::Geometry;
use xca_process::ParameterError;
use xca_values::Precision;

/// How a model is run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct RunOptions {
    /// What `Real` is.
    pub precision: Precision,
    /// The seed of random numbers.
    pub seed: u64,
}

/// Why a run ended.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Outcome {
    /// All steps are done.
    StepsDone,
    /// A steering operation ended it.
    Stopped {
        /// The reason that it gave.
        reason: String,
    },
}

/// What makes a run end early.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RunError {
    /// The engine cannot run the model.
    #[error(transparent)]
    Start(#[from] StartError),
    /// A parameter that is out of its range in the precision of the run.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// The engine cannot reach its state any more.
    #[error(transparent)]
    Engine(#[from] EngineFailure),
    /// A fault within a step.
    #[error("step {step}: {}{fault}", text.as_ref().map(|text| format!("{text}: ")).unwrap_or_default())]
    Fault {
        /// The number of the step, from 1 for the first.
        step: u64,
        /// What the model says of the code.
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
    /// A step after a fault.
    #[error(
        "the run ended with a fault in step {step} and cannot go on; restore a snapshot of an earlier step"
    )]
    Broken {
        /// The number of that step.
        step: u64,
    },
    /// A process that the model does not have.
    #[error("the model has {processes} processes, no process {index}")]
    NoSuchProcess {
        /// The number that was asked for, from 0.
        index: usize,
        /// How many there are.
        processes: usize,
    },
    /// A snapshot that the simulation cannot go on from.
    #[error(transparent)]
    Snapshot(#[from] SnapshotError),
}

/// A model with its state on an engine.
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
    /// Puts a model on an engine and makes its initial state.
    ///
    /// # Errors
    /// Where the engine cannot run the model, or making the initial state fails.
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

    /// How it is run.
    pub fn options(&self) -> RunOptions {
        self.options
    }

    /// The number of steps done.
    pub fn step_number(&self) -> u64 {
        self.step
    }

    /// Why a steering operation ended the run, if one did.
    pub fn stop_reason(&self) -> Option<&str> {
        self.stop.as_deref()
    }

    /// The bytes that the state takes.
    pub fn memory(&self) -> usize {
        self.execution.memory()
    }

    /// What the engine tells of how it computes the state. None of it is a result: engines, threads and
    /// machines differ in it.
    pub fn figures(&self) -> Vec<Figure> {
        self.execution.figures()
    }

    /// The state, to look at or to change.
    pub fn state(&mut self) -> State<'_> {
        self.state_for(u32::MAX)
    }

    /// The state for the steering operation with this number.
    fn state_for(&mut self, operation: u32) -> State<'_> {
        State {
            model: &self.model,
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

    /// Does one step: all processes in order, then the checks and the steering that are due.
    ///
    /// # Errors
    /// A fault of a process, a substate that is not finite where the model watches it, or an error of a
    /// steering operation.
    pub fn step(&mut self) -> Result<(), RunError> {
        self.leap(1)
    }

    /// Does at most so many steps; fewer where a steering operation ends the run, and none once one has.
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
    /// Of a steering operation, and a substate that is not finite, where the model watches it at the end.
    pub fn finish(&mut self) -> Result<(), RunError> {
        self.steer(|schedule| *schedule == Schedule::End)?;
        self.watch(|schedule| *schedule == Schedule::End)
    }

    /// Runs one process alone, by its number in the model, for debugging; nothing happens where it is not due
    /// in the step that is under way, to which it belongs: steps are not counted.
    ///
    /// # Errors
    /// A fault of the process, or a number that no process has.
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
