//! How a model is run and recorded.

use crate::failure::Failure;
use crate::record::{Claim, FolderError, Kind, REPORT, RecordError, Recorder, RunFolder};
use crate::recording::{Recording, check_finite};
use crate::report::{Earlier, ReadReportError, Report};
use crate::set_up::{SetUp, SetUpError};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use xca_checkpoint::{
    CheckpointError, CheckpointFile, CheckpointFolder, Checkpoints, Difference, Identity, Interval, Origin,
    Outputs, ResumeError,
};
use xca_core::{Engine, Model, ModelError, RunError, RunOptions, Simulation};
use xca_io::atomic::WriteError;

/// How many times in a run something is written, unless it is said how often.
const OUTPUTS: u64 = 20;

/// A run of a set-up, before it begins: its options and the intervals of its files.
///
/// ```
/// # let temporary = tempfile::tempdir()?;
/// # let out = temporary.path().join("growth");
/// use xca_core::prelude::*;
/// use xca_record::{Interval, Outcome, Run, SetUp};
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
/// fn run() -> Result<Run, Box<dyn std::error::Error + Send + Sync>> {
///     let model = Model::builder("growth")
///         .extents([8, 8, 1])
///         .neighbourhood(Neighbourhood::von_neumann_2d(1))
///         .substates::<Colony>()
///         .process(grow)
///         .fill(|_| Colony { size: 1.0 })
///         .build()?;
///     Ok(Run::new(SetUp::new(model, 100))?.every(10).checkpoint_every(Interval::Steps(40)))
/// }
///
/// let mut recording = run()?.begin(&out, &Reference)?;
/// assert_eq!(recording.go(&mut ())?, Outcome::Done);
/// drop(recording);
/// // A run goes on from its last checkpoint: one that was killed, or beyond its end.
/// let mut recording = run()?.steps(150).resume(&out, &Reference)?;
/// assert_eq!(recording.simulation().step_number(), 100);
/// recording.go(&mut ())?;
/// # Ok::<(), Box<dyn std::error::Error + Send + Sync>>(())
/// ```
#[derive(Debug)]
pub struct Run {
    recorder: Recorder,
    identity: Identity,
    options: RunOptions,
    steps: u64,
    outputs: Option<Outputs>,
    checkpoint_every: Option<Interval>,
    allow_non_finite: bool,
    allow_rounding: bool,
    overwrite: bool,
}

/// A run that cannot begin or resume.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages explain the fields")]
#[non_exhaustive]
pub enum BeginError {
    #[error(transparent)]
    SetUp(#[from] SetUpError),
    #[error(transparent)]
    Folder(#[from] FolderError),
    #[error(transparent)]
    Write(#[from] WriteError),
    #[error(transparent)]
    Report(#[from] ReadReportError),
    #[error("there is no checkpoint in {}", folder.display())]
    NoCheckpoint { folder: PathBuf },
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    #[error(
        "the run started with rounding that is {found}; rounding that is {wanted} would give other results"
    )]
    Rounding { found: String, wanted: String },
    #[error("{done} steps are done; a run of {steps} steps cannot resume from there")]
    Past { done: u64, steps: u64 },
    #[error(transparent)]
    Slots(#[from] ModelError),
    #[error(transparent)]
    Start(#[from] RunError),
    #[error(transparent)]
    NotFinite(Failure),
    #[error(transparent)]
    Record(#[from] RecordError),
}

impl From<ResumeError> for BeginError {
    fn from(error: ResumeError) -> Self {
        match error {
            ResumeError::Checkpoint(error) => Self::Checkpoint(error),
            ResumeError::Run(error) => Self::Start(error),
        }
    }
}

/// Where a run goes on.
#[derive(Debug)]
pub struct Resumed<'a> {
    /// The file.
    pub checkpoint: &'a CheckpointFile,
    /// What `run.json` tells of the run until then.
    pub earlier: Earlier,
}

impl Run {
    /// A run of all steps of the set-up, in `f64`, with seed 0 and the outputs of the set-up.
    ///
    /// # Errors
    /// Returns an error if a view, the map or the time step of the set-up is invalid.
    pub fn new(set_up: SetUp) -> Result<Self, BeginError> {
        set_up.check()?;
        let steps = set_up.steps;
        let outputs = set_up.outputs;
        let recorder = Recorder::new(set_up)?;
        let identity = Identity { program: recorder.model().name().to_owned(), ..Identity::default() };
        Ok(Self {
            recorder,
            identity,
            options: RunOptions::default(),
            steps,
            outputs,
            checkpoint_every: None,
            allow_non_finite: false,
            allow_rounding: false,
            overwrite: false,
        })
    }

    /// Precision and seed.
    #[must_use]
    pub fn options(self, options: RunOptions) -> Self {
        Self { options, ..self }
    }

    /// Sets the number of steps. A resumed run may do more steps than before.
    #[must_use]
    pub fn steps(self, steps: u64) -> Self {
        Self { steps, ..self }
    }

    /// Gives each cell at least this number of slots for the items of each population. A run that ended with
    /// a full cell can then resume. Results do not depend on it.
    ///
    /// # Errors
    /// Returns no error for a model that was built.
    pub fn slots(mut self, least: usize) -> Result<Self, BeginError> {
        let groups = self.recorder.model().groups().iter();
        let names: Vec<&str> = groups.map(|group| group.schema().name).collect();
        for name in names {
            if self.recorder.model().slots(name).is_some() {
                self.recorder.raise_slots(name, least)?;
            }
        }
        Ok(self)
    }

    /// Writes a row of observables and a frame at this interval of steps, at least 1. A resumed run keeps its
    /// interval.
    #[must_use]
    pub fn every(self, steps: u64) -> Self {
        Self { outputs: Some(Outputs::Every(steps.max(1))), ..self }
    }

    /// Writes a row of observables and a frame at this interval of simulated time, rounded to whole steps.
    /// Without [`SetUp::time_step`] a second is a step.
    #[must_use]
    pub fn every_seconds(self, seconds: f64) -> Self {
        let steps = seconds / self.recorder.set_up().time_step.unwrap_or(1.0);
        self.every(steps.round() as u64)
    }

    /// Writes checkpoints at this interval, and keeps the last two.
    #[must_use]
    pub fn checkpoint_every(self, interval: Interval) -> Self {
        Self { checkpoint_every: Some(interval), ..self }
    }

    /// Also writes states with NaN or infinities. Default: the first one is an error.
    #[must_use]
    pub fn allow_non_finite(self) -> Self {
        Self { allow_non_finite: true, ..self }
    }

    /// Also resumes on an engine that rounds floating-point numbers differently.
    #[must_use]
    pub fn allow_rounding(self) -> Self {
        Self { allow_rounding: true, ..self }
    }

    /// Also overwrites an unfinished run with checkpoints. Default: [`Self::begin`] refuses its directory.
    #[must_use]
    pub fn overwrite(self) -> Self {
        Self { overwrite: true, ..self }
    }

    #[doc(hidden)]
    #[must_use]
    pub fn identity(self, identity: Identity) -> Self {
        Self { identity, ..self }
    }

    /// The model.
    pub fn model(&self) -> &Model {
        self.recorder.model()
    }

    /// An estimate of the bytes that it takes on an engine, with its outputs and without items.
    #[doc(hidden)]
    pub fn least_memory(&self, engine: &dyn Engine) -> u128 {
        self.recorder.least_memory(engine, self.options.precision)
    }

    #[doc(hidden)]
    pub fn recorder(&self) -> &Recorder {
        &self.recorder
    }

    #[doc(hidden)]
    pub fn into_recorder(self) -> Recorder {
        self.recorder
    }

    #[doc(hidden)]
    pub fn run_options(&self) -> RunOptions {
        self.options
    }

    /// The run as its checkpoints name it, on an exact engine.
    #[doc(hidden)]
    pub fn origin(&self) -> Origin {
        let outputs = self.outputs.unwrap_or(Outputs::Every(self.steps.div_ceil(OUTPUTS).max(1)));
        let set_up = self.recorder.set_up();
        Origin::new(&self.identity, &set_up.model, &set_up.inputs, self.options, self.steps, outputs)
    }

    /// The report of the run on this engine, before its first step.
    #[doc(hidden)]
    pub fn report(&self, engine: &dyn Engine, origin: &Origin) -> Report {
        let mut report = Report::new(&self.identity, self.recorder.set_up(), engine, origin);
        report.files = self.recorder.files();
        if let Some(interval) = self.checkpoint_every {
            report.checkpoint_every = Some(interval.to_string());
            // The first, so that they are gone first when another run takes the folder: without their files
            // they are of no use.
            report.files.insert(0, CheckpointFolder::files());
        }
        report
    }

    /// Prepares the output directory and the initial state. Overwrites an earlier run there, if it has ended
    /// or has no checkpoint.
    ///
    /// # Errors
    /// Returns an error if the directory holds files that no run of this program has made, an unfinished run
    /// with checkpoints (see [`Self::overwrite`] and [`Self::resume_or_begin`]), another run writes there, or
    /// the engine cannot run the model.
    pub fn begin(self, folder: impl AsRef<Path>, engine: &dyn Engine) -> Result<Recording, BeginError> {
        let begin = Instant::now();
        let origin = self.origin().on(engine);
        let report = self.report(engine, &origin);
        // Before the folder: where there is no initial state, an earlier run keeps its files.
        let simulation = Simulation::new(self.recorder.model(), engine, self.options)?;
        if !self.allow_non_finite {
            check_finite(&simulation).map_err(BeginError::NotFinite)?;
        }
        let inputs = &self.recorder.set_up().inputs;
        let program = Some(report.program.as_str());
        let claim =
            Claim { kind: Kind::Run, files: &report.files, inputs, program, overwrite: self.overwrite };
        let folder = RunFolder::prepare(folder.as_ref(), &claim)?;
        let checkpoints = self.checkpoint_every.map(|interval| Checkpoints::new(interval, &folder.top, None));
        Ok(Recording {
            simulation,
            checkpoints: checkpoints.transpose()?,
            recorder: self.recorder,
            report,
            folder,
            origin,
            allow_non_finite: self.allow_non_finite,
            earlier: Earlier::default(),
            begin,
            set_up: begin.elapsed(),
            stepping: Duration::ZERO,
        })
    }

    /// Resumes from the latest checkpoint in the directory of a run of the same model, on any engine. The
    /// files become those of an uninterrupted run, byte by byte.
    ///
    /// The number of steps may be larger than before: a finished run then continues beyond its end.
    ///
    /// # Errors
    /// Returns an error if there is no checkpoint, the checkpoint is damaged or belongs to another run, or an
    /// input file has changed.
    pub fn resume(self, folder: impl AsRef<Path>, engine: &dyn Engine) -> Result<Recording, BeginError> {
        let folder = folder.as_ref();
        let latest = CheckpointFolder::of_run(folder).into_iter().next();
        let path = latest.ok_or_else(|| BeginError::NoCheckpoint { folder: folder.to_owned() })?;
        let checkpoint = CheckpointFile::open(&path)?;
        let earlier = Earlier::read(&folder.join(REPORT))?.unwrap_or_default();
        let resumed = Resumed { checkpoint: &checkpoint, earlier };
        self.resume_from(folder, engine, resumed)
    }

    /// As [`Self::resume`] if the directory has a checkpoint, otherwise as [`Self::begin`].
    ///
    /// # Errors
    /// As for these.
    pub fn resume_or_begin(
        self,
        folder: impl AsRef<Path>,
        engine: &dyn Engine,
    ) -> Result<Recording, BeginError> {
        if CheckpointFolder::of_run(folder.as_ref()).is_empty() {
            self.begin(folder, engine)
        } else {
            self.resume(folder, engine)
        }
    }

    #[doc(hidden)]
    pub fn resume_from(
        mut self,
        folder: &Path,
        engine: &dyn Engine,
        Resumed { checkpoint, earlier }: Resumed<'_>,
    ) -> Result<Recording, BeginError> {
        let begin = Instant::now();
        let (path, description) = (checkpoint.path(), checkpoint.description());
        if self.steps < description.step {
            return Err(BeginError::Past { done: description.step, steps: self.steps });
        }
        self.outputs.get_or_insert(description.run.every);
        // Items that once needed more slots may need them again; what is no population of the model's is
        // refused below.
        for (population, slots) in description.run.slots() {
            if self.recorder.model().slots(population).is_some() {
                self.recorder.raise_slots(population, slots)?;
            }
        }
        let origin = self.origin().on(engine);
        let difference = description.run.other_program(origin.identity());
        if let Some(Difference { what, found, wanted }) =
            difference.or_else(|| description.run.mismatch(&origin))
        {
            return Err(CheckpointError::Foreign { path: path.to_owned(), what, found, wanted }.into());
        }
        if !self.allow_rounding
            && let Some(Difference { found, wanted, .. }) = description.run.other_rounding(&origin)
        {
            return Err(BeginError::Rounding { found, wanted });
        }
        let mut report = self.report(engine, &origin);
        let folder = RunFolder::open(folder)?;
        let simulation = checkpoint.resume(self.recorder.model(), engine, self.options)?;
        let checkpoints =
            self.checkpoint_every.map(|interval| Checkpoints::new(interval, &folder.top, Some(path)));
        let checkpoints = checkpoints.transpose()?;
        self.recorder.resume(folder.clone(), &description.recorded)?;
        if self.checkpoint_every.is_none() {
            report.files.insert(0, CheckpointFolder::files());
        }
        report.go_on(&earlier, description.step, path);
        Ok(Recording {
            simulation,
            recorder: self.recorder,
            report,
            folder,
            origin,
            checkpoints,
            allow_non_finite: self.allow_non_finite,
            earlier,
            begin,
            set_up: begin.elapsed(),
            stepping: Duration::ZERO,
        })
    }
}
