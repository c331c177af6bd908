//! `run.json`: everything about a run but its results.

mod earlier;

pub use earlier::{Earlier, ReadReportError, parts, read};

use crate::set_up::SetUp;
use serde::Serialize;
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::io::{self, Write as _};
use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};
use xca_checkpoint::components::json;
use xca_checkpoint::{Identity, InputFile, ModelReport, Origin, Outputs};
use xca_core::{Engine, Model, ParameterSet, ParameterValue, Precision, ValueType};
use xca_io::atomic::{WriteError, write_atomically};
use xca_io::map::{self, Placement};
use xca_machine::cores;
use xca_observe::Observable;

/// The report of a run.
#[derive(Debug, Clone, Serialize)]
pub struct Report {
    /// The version of the framework; its presence says whose report this is.
    pub xca: String,
    pub program: String,
    pub version: String,
    pub command_line: Vec<String>,
    /// The working directory, from which the relative paths of the command line go.
    pub directory: String,
    /// The files that the set-up has read.
    pub inputs: Vec<InputFile>,
    /// All options of the model, with their defaults.
    pub options: Map<String, Value>,
    /// What the model's program adds.
    #[serde(flatten)]
    pub notes: Map<String, Value>,
    /// What makes the results doubtful.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
    pub model: ModelReport,
    /// Where the cells lie, of a model on a map.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub map: Option<MapReport>,
    pub parameters: Map<String, Value>,
    /// Of the parameters and substates that have one.
    pub units: Map<String, Value>,
    pub engine: String,
    pub threads: usize,
    /// What the engine says of its device, if it has one.
    pub device: Map<String, Value>,
    pub precision: Precision,
    pub seed: u64,
    pub every: Outputs,
    /// Steps or time.
    pub checkpoint_every: Option<String>,
    pub host: Host,
    pub started: String,
    /// When and from where the run was resumed.
    pub resumed: Vec<Value>,
    pub progress: Progress,
    pub observables: Vec<ObservableReport>,
    pub files: Vec<String>,
}

/// How far a run has come, and what it took.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Progress {
    /// `running`, `done`, `stopped`, `interrupted` or `failed`.
    pub outcome: &'static str,
    /// Why it was stopped, or what went wrong.
    pub reason: Option<String>,
    pub steps: u64,
    pub steps_wanted: u64,
    /// Simulated time, in s where the model knows it.
    pub time: f64,
    pub time_step: Option<f64>,
    pub frames: usize,
    pub set_up_seconds: f64,
    pub step_seconds: f64,
    pub output_seconds: f64,
    pub wall_seconds: f64,
    pub steps_per_second: Option<f64>,
    pub state_bytes: Option<usize>,
    pub peak_memory_bytes: Option<u64>,
    /// What the engine tells of its own work.
    pub engine_figures: BTreeMap<String, f64>,
}

impl Report {
    /// That of a run on this engine, before its first step, which has made no files yet.
    pub fn new(identity: &Identity, set_up: &SetUp, engine: &dyn Engine, origin: &Origin) -> Self {
        let Identity { program, version, command_line, directory, options } = identity.clone();
        Self {
            xca: origin.xca.clone(),
            program,
            version,
            command_line,
            directory,
            inputs: origin.inputs.clone(),
            options,
            notes: set_up.notes.clone(),
            warnings: set_up.warnings.clone(),
            model: ModelReport::new(&set_up.model),
            map: of_map(set_up),
            parameters: of_parameters(set_up.model.parameters()),
            units: of_units(&set_up.model),
            engine: engine.name().to_owned(),
            threads: engine.threads(),
            device: engine.facts().into_iter().map(|(fact, which)| (fact.to_owned(), which.into())).collect(),
            precision: origin.precision,
            seed: origin.seed,
            every: origin.every,
            checkpoint_every: None,
            host: of_host(),
            started: now(),
            resumed: Vec::new(),
            progress: Progress {
                outcome: "running",
                steps_wanted: origin.steps_wanted,
                time_step: set_up.time_step,
                ..Progress::default()
            },
            observables: Vec::new(),
            files: Vec::new(),
        }
    }

    /// Writes the report, in place of the one before.
    pub fn write(&self, path: &Path) -> Result<(), WriteError> {
        write_atomically(path, |file| {
            serde_json::to_writer_pretty(&mut *file, self).map_err(io::Error::from)?;
            file.write_all(b"\n")
        })
    }

    /// Makes this the report of a run that goes on from a checkpoint after that step.
    pub fn go_on(&mut self, earlier: &Earlier, step: u64, checkpoint: &Path) {
        if let Some(started) = &earlier.started {
            self.started.clone_from(started);
        }
        self.resumed.clone_from(&earlier.resumed);
        self.resumed.push(serde_json::json!({
            "at": now(),
            "step": step,
            "steps_wanted": self.progress.steps_wanted,
            "checkpoint": checkpoint.file_name().map(|name| name.to_string_lossy()),
            "engine": self.engine,
            "threads": self.threads,
        }));
    }
}

/// Where the cells of a model lie.
#[derive(Debug, Clone, Serialize)]
pub struct MapReport {
    /// The south-west corner.
    corner: [f64; 2],
    cell_side: f64,
    cells_without_ground: usize,
    /// The code of its coordinate system, if a file has named one.
    #[serde(skip_serializing_if = "Option::is_none")]
    epsg: Option<u16>,
}

/// The place of a model on the map.
pub fn of_map(set_up: &SetUp) -> Option<MapReport> {
    let missing = set_up.missing().unwrap_or_default();
    let Placement { corner, side, .. } = set_up.placement();
    let cells_without_ground = missing.iter().filter(|is_missing| **is_missing).count();
    let report = |map: &map::Map| {
        let epsg = map.coordinate_system().and_then(|keys| keys.epsg());
        MapReport { corner, cell_side: side, cells_without_ground, epsg }
    };
    set_up.map.as_ref().map(report)
}

/// The machine.
#[derive(Debug, Clone, Serialize)]
pub struct Host {
    pub cores: Option<usize>,
    pub system: &'static str,
    pub processor: &'static str,
}

/// A quantity before the first step and after the last.
#[derive(Debug, Clone, Serialize)]
pub struct ObservableReport {
    name: String,
    unit: String,
    initial: f64,
    #[serde(rename = "final")]
    last: f64,
    /// Of a quantity that the model keeps.
    #[serde(skip_serializing_if = "Option::is_none")]
    drift: Option<f64>,
}

/// The machine that this program runs on.
pub fn of_host() -> Host {
    Host { cores: cores(), system: std::env::consts::OS, processor: std::env::consts::ARCH }
}

/// The values of all parameters by name.
pub fn of_parameters(parameters: &ParameterSet) -> Map<String, Value> {
    let values = parameters.values().map(|value| of_value(&value));
    parameters.names().into_iter().zip(values).collect()
}

/// The units of parameters, by their names, and of substates, as `Struct.field`.
pub fn of_units(model: &Model) -> Map<String, Value> {
    let parameters = model.parameters();
    let named = parameters.names().into_iter().zip(parameters.fields());
    let substates = model.groups().iter().flat_map(|group| {
        let schema = group.schema();
        schema.fields.iter().map(|field| (format!("{}.{}", schema.name, field.name), field))
    });
    named.chain(substates).filter_map(|(name, field)| Some((name, field.unit?.into()))).collect()
}

/// A vector or an array is a list, an array of vectors a list of lists.
fn of_value(value: &ParameterValue) -> Value {
    let ValueType { scalar, lanes, length } = value.value_type();
    let components: Vec<Value> = value.components().iter().map(|number| json(scalar, *number)).collect();
    match (length, lanes) {
        (None, 1) => components.into_iter().next().unwrap_or_default(),
        (_, 1) | (None, _) => Value::Array(components),
        _ => components.chunks(lanes.into()).map(|element| Value::Array(element.to_vec())).collect(),
    }
}

/// Observables with their first and last values.
pub fn of_observables(first: &[Observable], last: &[Observable]) -> Vec<ObservableReport> {
    let pairs = first.iter().zip(last).map(|(first, last)| ObservableReport {
        name: first.name.clone(),
        unit: first.unit.clone(),
        initial: first.value,
        last: last.value,
        drift: first.drift(last.value),
    });
    pairs.collect()
}

/// The present time, as `2026-11-22T03:11:18Z`.
pub fn now() -> String {
    let seconds = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
    date(seconds)
}

/// A time given in seconds since 1970, in the proleptic Gregorian calendar (H. Hinnant's `civil_from_days`).
fn date(seconds: u64) -> String {
    let (days, second) = (seconds / 86_400, seconds % 86_400);
    let shifted = days + 719_468;
    let (era, day_of_era) = (shifted / 146_097, shifted % 146_097);
    let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    // Years begin in March here, so that the leap day is the last one.
    let month = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * month + 2) / 5 + 1;
    let (year, month) = if month < 10 { (0, month + 3) } else { (1, month - 9) };
    let year = year + year_of_era + 400 * era;
    let (hour, minute, second) = (second / 3600, second / 60 % 60, second % 60);
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_those_of_the_calendar() {
        for (seconds, text) in [
            (0, "1970-01-01T00:00:00Z"),
            (951_782_400, "2000-02-29T00:00:00Z"),
            (951_868_799, "2000-02-29T23:59:59Z"),
            (1_709_210_096, "2024-02-29T12:34:56Z"),
            (4_107_542_400, "2100-03-01T00:00:00Z"),
        ] {
            assert_eq!(date(seconds), text);
        }
    }
}
