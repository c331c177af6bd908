//! What a run's folder, or a checkpoint, says of the run that it is of.

use crate::command::definition::Definition;
use crate::command::outcome::Unable;
use crate::command::parse;
use crate::command::prepare::described;
use crate::command::working_directory::WorkingDirectory;
use serde::Deserialize;
use serde_json::{Map, Value};
use std::path::Path;
use xca_checkpoint::{Description, Difference, Parameter, other_model, other_program};
use xca_core::Precision;
use xca_record::format::Formats;
use xca_record::record::{REPORT, Recorder, SavedRun};
use xca_record::report;

/// What a run was: enough to make its model again.
pub(super) struct Kept<'a> {
    /// The folder or the checkpoint.
    path: &'a Path,
    /// As [`Definition::identity`].
    identity: [String; 3],
    command_line: Vec<String>,
    directory: String,
    /// The shape of the model, as in `run.json`.
    model: Value,
    parameters: Vec<String>,
}

/// The part of `run.json` that tells this.
#[derive(Deserialize)]
#[serde(expecting = "an object")]
struct Told {
    xca: String,
    program: String,
    version: String,
    command_line: Vec<String>,
    directory: String,
    model: Value,
    parameters: Map<String, Value>,
    precision: Precision,
    progress: Progress,
}

/// How far it came. The keys are written anew.
#[derive(Deserialize)]
#[serde(expecting = "an object")]
struct Progress {
    steps: u64,
}

/// A run, and what is left of it.
pub(super) struct KeptRun<'a> {
    pub(super) kept: Kept<'a>,
    pub(super) saved: SavedRun,
    /// The whole report.
    pub(super) report: Value,
}

/// A run whose states are drawn must be one of this program.
#[derive(Debug, thiserror::Error)]
#[error("cannot draw {path}: its {} is {}, not {}", .difference.what, .difference.found, .difference.wanted)]
struct Other {
    path: String,
    difference: Difference,
}

impl<'a> Kept<'a> {
    /// What the report in the folder of a run tells.
    pub(super) fn of_folder(path: &'a Path) -> Result<KeptRun<'a>, Unable> {
        let folder = path.display();
        let report = path.join(REPORT);
        let whole = report::read(&report).map_err(Unable::refused)?;
        let whole = whole.filter(|whole| whole.get("xca").is_some()).ok_or_else(|| {
            Unable::refused(format!("{folder} is not the output of a run: it has no {REPORT}"))
        })?;
        let told: Told = report::parts(&report, &whole).map_err(Unable::refused)?;
        if told.command_line.get(1).map(String::as_str) == Some(super::NAME) {
            return Err(Unable::refused(format!("{folder} holds pictures of a run, not the run")));
        }
        let saved =
            SavedRun { folder: path.to_owned(), precision: told.precision, last_step: told.progress.steps };
        let kept = Self {
            path,
            identity: [told.xca, told.program, told.version],
            command_line: told.command_line,
            directory: told.directory,
            model: told.model,
            parameters: of_report(&told.parameters),
        };
        Ok(KeptRun { kept, saved, report: whole })
    }

    /// What a checkpoint tells.
    pub(super) fn of_checkpoint(path: &'a Path, description: &Description) -> Self {
        let run = &description.run;
        Self {
            path,
            identity: [&run.xca, &run.program, &run.version].map(Clone::clone),
            command_line: run.command_line.clone(),
            directory: run.directory.clone(),
            model: run.model.clone(),
            parameters: run.parameters.iter().map(ToString::to_string).collect(),
        }
    }

    /// The recorder of the run, which knows its model and its views.
    ///
    /// The processes may be others than they were: what they have done is there to be seen. The parameters
    /// may not, as views depend on them.
    pub(super) fn recorder(&self, definition: &Definition<'_>) -> Result<Recorder, Unable> {
        let identity = self.identity.each_ref().map(String::as_str);
        self.same(other_program(identity, definition.identity()))?;
        let run = parse::recorded(definition, &self.command_line, "run")?;
        let run = {
            let _there = WorkingDirectory::enter(&self.directory)?;
            described(&run)?
        };
        let origin = run.origin();
        self.same(other_model(&self.model, &origin.model))?;
        // A checkpoint writes them in another way than a report.
        let of_report = of_report(&report::of_parameters(run.model().parameters()));
        let of_checkpoint: Vec<String> = origin.parameters.iter().map(Parameter::to_string).collect();
        if ![&of_report, &of_checkpoint].contains(&&self.parameters) {
            let [found, wanted] = [&self.parameters, &of_report].map(|parameters| parameters.join(", "));
            self.same(Some(Difference { what: "set of parameters", found, wanted }))?;
        }
        Ok(run.into_recorder())
    }

    fn same(&self, difference: Option<Difference>) -> Result<(), Unable> {
        let path = self.path.display().to_string();
        difference.map_or(Ok(()), |difference| Err(Unable::refused(Other { path, difference })))
    }
}

/// The formats of the program that has left a folder, if it is this one and its model can be made again. A
/// program can have formats of its own.
pub(in crate::command) fn formats_of(definition: &Definition<'_>, folder: &Path) -> Option<Formats> {
    let KeptRun { kept, .. } = Kept::of_folder(folder).ok()?;
    Some(kept.recorder(definition).ok()?.into_formats())
}

/// The parameters of a report.
fn of_report(parameters: &Map<String, Value>) -> Vec<String> {
    parameters.iter().map(|(name, value)| format!("{name} = {value}")).collect()
}
