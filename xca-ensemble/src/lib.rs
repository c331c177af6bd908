//! Ensembles: many runs of a model with different parameters and seeds, and one table of their results.
//!
//! See [`Ensemble`] for an example.

#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should"))]

mod member;
mod table;
mod work;

pub use member::{Assigned, End, Finished, Member};
pub use table::{Summary, TableError};

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use table::Table;
use work::Work;
use xca_checkpoint::{Identity, Origin};
use xca_core::{Engine, Precision, RunOptions};
use xca_io::atomic::{WriteError, write_atomically};
use xca_record::Failure;
use xca_record::Outputs;
use xca_record::SetUp;
use xca_record::record::{Claim, ENSEMBLE, FolderError, Kind, LockedFolder};
use xca_record::report::{self, ReadReportError};

/// The table with a row for each member.
pub const MEMBERS: &str = "members.csv";
/// The table with mean and spread over the seeds.
pub const SUMMARY: &str = "summary.csv";
/// The file in which the command line draws them.
const PAGE: &str = "summary.html";

/// Many runs of a model: all combinations of parameter values, each with several seeds.
///
/// Runs work in parallel, each on its own engine. A failed run does not end the others. The table grows while
/// they run. An ensemble that was interrupted resumes with the missing runs.
///
/// ```
/// # let temporary = tempfile::tempdir()?;
/// # let out = temporary.path().join("growth");
/// use xca_core::prelude::*;
/// use xca_core::Engine;
/// use xca_ensemble::Ensemble;
/// use xca_record::{Failure, SetUp};
///
/// #[derive(Substates, Clone)]
/// struct Colony {
///     size: Real,
/// }
///
/// #[derive(Parameters, Clone, Copy, Debug)]
/// struct Growth {
///     rate: Real,
/// }
///
/// #[elementary_process]
/// fn grow(cell: &mut Cell<Colony>, p: &Growth) {
///     cell.size += p.rate * cell.size * cell.random(0);
/// }
///
/// let set_up = || -> Result<SetUp, Failure> {
///     let model = Model::builder("growth")
///         .extents([8, 8, 1])
///         .substates::<Colony>()
///         .parameters(Growth { rate: 0.1 })
///         .process(grow)
///         .fill(|_| Colony { size: 1.0 })
///         .build()?;
///     Ok(SetUp::new(model, 10))
/// };
/// let engine = || -> Result<Box<dyn Engine>, Failure> { Ok(Box::new(Reference)) };
/// let ensemble = Ensemble::new().sweep("rate", [0.1, 0.2]).seeds(0, 3).jobs(2);
/// let finished = ensemble.run(&out, &engine, &mut |_| set_up(), &mut ())?;
/// assert_eq!(finished.len(), 6);
/// assert!(out.join("members.csv").is_file() && out.join("summary.csv").is_file());
/// # Ok::<(), Box<dyn std::error::Error + Send + Sync>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Ensemble {
    axes: Vec<Axis>,
    first_seed: u64,
    seeds: u64,
    jobs: usize,
    precision: Precision,
    steps: Option<u64>,
    identity: Identity,
}

/// A parameter and the values that it takes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Axis {
    parameter: String,
    values: Vec<String>,
}

/// What makes two ensembles one: the part of the report by which a table is known again.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Plan {
    axes: Vec<Axis>,
    first_seed: u64,
    seeds: u64,
    precision: Precision,
    steps: Option<u64>,
    /// The options of the program.
    options: Map<String, Value>,
    /// The model and the input files of the first member, where it can be made.
    model: Option<Origin>,
}

/// The report of an ensemble.
#[derive(Debug, Serialize, Deserialize)]
struct Told {
    xca: String,
    program: String,
    version: String,
    ensemble: Plan,
    started: String,
    files: Vec<String>,
}

/// Follows an ensemble, and can end it. `()` does neither.
pub trait EnsembleMonitor {
    /// Called before the runs, with the number of members already done and of all.
    fn begin(&mut self, done: usize, all: usize) {
        let _ = (done, all);
    }

    /// Called at the end of a member.
    fn ended(&mut self, member: &Finished) {
        let _ = member;
    }

    /// Whether to end now. Members in progress are discarded; they run again when the ensemble resumes.
    fn is_interrupted(&self) -> bool {
        false
    }
}

impl EnsembleMonitor for () {}

/// An error that ends an ensemble.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages explain the fields")]
#[non_exhaustive]
pub enum EnsembleError {
    #[error(transparent)]
    Folder(#[from] FolderError),
    #[error(transparent)]
    Write(#[from] WriteError),
    #[error(transparent)]
    Report(#[from] ReadReportError),
    #[error(transparent)]
    Table(#[from] TableError),
    #[error("{} holds another ensemble; give another folder", folder.display())]
    Other { folder: PathBuf },
    #[error("`{parameter}` has no values to take")]
    NoValues { parameter: String },
    #[error("`{parameter}` is swept twice")]
    Twice { parameter: String },
}

/// How long members wait at most until they stand in the table.
const PAUSE: Duration = Duration::from_secs(1);

impl Default for Ensemble {
    fn default() -> Self {
        Self {
            axes: Vec::new(),
            first_seed: 0,
            seeds: 1,
            jobs: std::thread::available_parallelism().map_or(1, NonZero::get),
            precision: Precision::default(),
            steps: None,
            identity: Identity::default(),
        }
    }
}

impl Ensemble {
    /// One run with the model's parameters and seed 0, with as many jobs as cores.
    pub fn new() -> Self {
        Self::default()
    }

    /// Gives a parameter these values, in all combinations with those of other parameters.
    ///
    /// ```
    /// # use xca_ensemble::Ensemble;
    /// let ensemble = Ensemble::new().sweep("rate", [0.1, 0.2]).sweep("cells", [16, 32]).seeds(7, 5);
    /// assert_eq!(ensemble.members().len(), 20);
    /// ```
    #[must_use]
    pub fn sweep<V: ToString>(
        mut self,
        parameter: impl Into<String>,
        values: impl IntoIterator<Item = V>,
    ) -> Self {
        let values = values.into_iter().map(|value| value.to_string()).collect();
        self.axes.push(Axis { parameter: parameter.into(), values });
        self
    }

    /// Runs each combination with `count` seeds, at least 1, counted from `first`.
    #[must_use]
    pub fn seeds(self, first: u64, count: u64) -> Self {
        Self { first_seed: first, seeds: count.max(1), ..self }
    }

    /// Sets the number of parallel runs, at least 1. Each has its own engine. The jobs times the threads of
    /// an engine should not exceed the number of cores.
    #[must_use]
    pub fn jobs(self, jobs: usize) -> Self {
        Self { jobs: jobs.max(1), ..self }
    }

    /// The precision of all runs.
    #[must_use]
    pub fn precision(self, precision: Precision) -> Self {
        Self { precision, ..self }
    }

    /// Sets the number of steps, in place of that of the set-up.
    #[must_use]
    pub fn steps(self, steps: u64) -> Self {
        Self { steps: Some(steps), ..self }
    }

    /// The program, for the report.
    #[doc(hidden)]
    #[must_use]
    pub fn identity(self, identity: Identity) -> Self {
        Self { identity, ..self }
    }

    /// All members in the order of the table: seeds vary fastest, then the last parameter.
    pub fn members(&self) -> Vec<Member> {
        let mut combinations = vec![Vec::new()];
        for axis in &self.axes {
            let with_value = |before: &Vec<Assigned>, value: &String| {
                let assigned = Assigned { parameter: axis.parameter.clone(), value: value.clone() };
                before.iter().cloned().chain([assigned]).collect::<Vec<_>>()
            };
            combinations = combinations
                .iter()
                .flat_map(|before| axis.values.iter().map(move |value| with_value(before, value)))
                .collect();
        }
        let seeds = || (0..self.seeds).map(|seed| self.first_seed.wrapping_add(seed));
        let pairs =
            combinations.into_iter().flat_map(|values| seeds().map(move |seed| (values.clone(), seed)));
        pairs.enumerate().map(|(number, (parameters, seed))| Member { number, seed, parameters }).collect()
    }

    /// Runs the members that the table in the output directory lacks. Returns all finished members.
    ///
    /// `set_up` makes the model of a member, on the calling thread. The parameters of the member are set
    /// afterwards. It is called once more for the first member, to check that the table belongs to this
    /// model. `engine` makes an engine, on the thread that uses it.
    ///
    /// # Errors
    /// Returns an error if the directory holds something else, or a table cannot be written. The errors of a
    /// member are in its row.
    pub fn run(
        &self,
        folder: &Path,
        engine: &(dyn Fn() -> Result<Box<dyn Engine>, Failure> + Sync),
        set_up: &mut dyn FnMut(&Member) -> Result<SetUp, Failure>,
        monitor: &mut dyn EnsembleMonitor,
    ) -> Result<Vec<Finished>, EnsembleError> {
        self.check()?;
        let members = self.members();
        let model = members.first().and_then(|member| set_up(member).ok()).map(|set_up| self.origin(&set_up));
        let folder = self.open(folder, self.plan(model))?;
        let mut table = Table::open(&folder.top.file(MEMBERS), &members)?;
        monitor.begin(table.len(), members.len());
        let mut written = Instant::now();
        let work = Work { jobs: self.jobs, precision: self.precision, steps: self.steps, engine };
        let waiting: Vec<Member> = members.into_iter().filter(|member| !table.has(member.number)).collect();
        let mut result = Ok(());
        work.run(&mut waiting.into_iter(), set_up, &mut |event| {
            if let Some(finished) = event {
                monitor.ended(&finished);
                table.insert(finished);
                if written.elapsed() >= PAUSE {
                    result = table.write();
                    written = Instant::now();
                }
            }
            result.is_ok() && !monitor.is_interrupted()
        });
        result?;
        table.write()?;
        Summary::of(&table).write(&folder.top.file(SUMMARY))?;
        Ok(table.into_finished())
    }

    fn check(&self) -> Result<(), EnsembleError> {
        for (number, axis) in self.axes.iter().enumerate() {
            let parameter = axis.parameter.clone();
            if axis.values.is_empty() {
                return Err(EnsembleError::NoValues { parameter });
            }
            if self.axes[..number].iter().any(|other| other.parameter == parameter) {
                return Err(EnsembleError::Twice { parameter });
            }
        }
        Ok(())
    }

    fn plan(&self, model: Option<Origin>) -> Plan {
        let Self { axes, first_seed, seeds, precision, steps, identity, .. } = self.clone();
        Plan { axes, first_seed, seeds, precision, steps, options: identity.options, model }
    }

    fn origin(&self, set_up: &SetUp) -> Origin {
        let options = RunOptions { precision: self.precision, seed: self.first_seed };
        // Command lines may say the same in other words, and from other folders.
        let identity =
            Identity { command_line: Vec::new(), directory: String::new(), ..self.identity.clone() };
        let steps = self.steps.unwrap_or(set_up.steps);
        // An ensemble writes no states.
        Origin::new(&identity, &set_up.model, &set_up.inputs, options, steps, Outputs::Growing)
    }

    /// The folder of this ensemble, new or known again.
    fn open(&self, path: &Path, plan: Plan) -> Result<LockedFolder, EnsembleError> {
        let report = path.join(ENSEMBLE);
        if report.exists() {
            let folder = LockedFolder::again(path)?;
            let other = || EnsembleError::Other { folder: path.to_owned() };
            let found = report::read(&report)?.ok_or_else(other)?;
            let told: Told = serde_json::from_value(found).map_err(|_| other())?;
            let is_own = told.ensemble == plan && told.program == self.identity.program;
            return if is_own { Ok(folder) } else { Err(other()) };
        }
        let files = [MEMBERS, SUMMARY, PAGE].map(str::to_owned);
        let claim =
            Claim { kind: Kind::Ensemble, files: &files, inputs: &[], program: None, overwrite: false };
        let folder = LockedFolder::prepare(path, &claim)?;
        let Identity { program, version, .. } = self.identity.clone();
        let told = Told {
            xca: env!("CARGO_PKG_VERSION").to_owned(),
            program,
            version,
            ensemble: plan,
            started: report::now(),
            files: files.to_vec(),
        };
        write_atomically(&report, |file| {
            serde_json::to_writer_pretty(&mut *file, &told).map_err(std::io::Error::from)
        })?;
        Ok(folder)
    }
}

#[cfg(test)]
mod tests;
