//! What comes before a run, whether it begins or goes on: the engine, the model with its parameters, the report.

use super::Unable;
use super::arguments::EngineArguments;
use super::initial::one_layer;
use super::parse::RunInvocation;
use crate::checkpoint::Origin;
use crate::machine::check_memory;
use crate::program::Given;
use crate::record::Recorder;
use crate::report::{self, Report};
use crate::set_up::SetUp;
use xca_core::{Engine, RunOptions};

/// How many times in a run something is written, unless the command line says how often.
const OUTPUTS: u64 = 20;

/// A run that can begin.
pub(super) struct Prepared {
    pub(super) engine: Box<dyn Engine>,
    pub(super) recorder: Recorder,
    pub(super) options: RunOptions,
    pub(super) origin: Origin,
    pub(super) report: Report,
}

/// A run as its command line says it, on no engine.
pub(super) struct Described {
    pub(super) recorder: Recorder,
    pub(super) options: RunOptions,
    pub(super) origin: Origin,
}

impl Described {
    /// Makes the model of a run.
    pub(super) fn new(invocation: &RunInvocation<'_>) -> Result<Self, Unable> {
        let given = invocation.model.arguments.given(invocation.run.steps);
        Self::of(invocation, &given, invocation.model.set_up(&given)?)
    }

    fn of(invocation: &RunInvocation<'_>, given: &Given, set_up: SetUp) -> Result<Self, Unable> {
        let steps = given.steps.unwrap_or(set_up.steps);
        let every = invocation.run.every.unwrap_or(steps.div_ceil(OUTPUTS).max(1));
        let recorder = Recorder::new(set_up).map_err(Unable::refused)?;
        let options = RunOptions { precision: given.precision, seed: given.seed };
        let definition = invocation.model.definition;
        let origin = Origin::new(
            definition.identity(),
            invocation.command_line.clone(),
            recorder.model(),
            options,
            [steps, every],
        );
        Ok(Self { recorder, options, origin })
    }
}

impl Prepared {
    /// Makes the model of a run, for an engine that need not be the one that its command line names.
    pub(super) fn new(invocation: &RunInvocation<'_>, on: &EngineArguments) -> Result<Self, Unable> {
        let engine = on.engine.engine(&on.options()).map_err(Unable::refused)?;
        let given = invocation.model.arguments.given(invocation.run.steps);
        let set_up = set_up(invocation, &*engine, &given)?;
        let Described { recorder, options, origin } = Described::of(invocation, &given, set_up)?;
        let origin = origin.on(&*engine);
        let report = first_report(invocation, &recorder, &*engine, &origin);
        Ok(Self { engine, recorder, options, origin, report })
    }
}

/// The model, where the machine has room for it.
fn set_up(invocation: &RunInvocation<'_>, engine: &dyn Engine, given: &Given) -> Result<SetUp, Unable> {
    let mut set_up = invocation.model.set_up(given)?;
    if invocation.run.grids {
        one_layer(&set_up, "--grids").map_err(Unable::refused)?;
        set_up.grids = true;
    }
    let memory = engine.least_memory(&set_up.model, given.precision);
    check_memory(memory, &format!("this model on the {} engine", engine.name())).map_err(Unable::refused)?;
    Ok(set_up)
}

fn first_report(
    invocation: &RunInvocation<'_>,
    recorder: &Recorder,
    engine: &dyn Engine,
    origin: &Origin,
) -> Report {
    let set_up = recorder.set_up();
    let definition = invocation.model.definition;
    Report {
        xca: env!("CARGO_PKG_VERSION"),
        program: definition.name,
        version: definition.version,
        command_line: invocation.command_line.clone(),
        options: invocation.model.options.clone(),
        notes: set_up.notes.clone(),
        model: report::of_model(&set_up.model),
        map: report::of_map(set_up),
        parameters: report::of_parameters(set_up.model.parameters()),
        units: report::of_units(&set_up.model),
        engine: engine.name().to_owned(),
        threads: engine.threads(),
        device: engine.facts().into_iter().map(|(fact, which)| (fact.to_owned(), which.into())).collect(),
        precision: origin.precision,
        seed: origin.seed,
        every: origin.every,
        checkpoint_every: None,
        host: report::of_host(),
        started: report::now(),
        resumed: Vec::new(),
        progress: report::Progress {
            outcome: "running",
            reason: None,
            steps: 0,
            steps_wanted: origin.steps_wanted,
            time: 0.0,
            time_step: set_up.time_step,
            frames: 0,
            set_up_seconds: 0.0,
            step_seconds: 0.0,
            output_seconds: 0.0,
            wall_seconds: 0.0,
            steps_per_second: None,
            state_bytes: None,
            peak_memory_bytes: None,
        },
        observables: Vec::new(),
        files: recorder.files(),
    }
}
