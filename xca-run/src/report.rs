//! `run.json`: everything about a run but its results.

use crate::checkpoint::Difference;
use crate::components::{json, type_text};
use crate::machine::cores;
use crate::program::Observable;
use crate::record::REPORT;
use crate::set_up::SetUp;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::io::{self, Write as _};
use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};
use xca_core::model::GroupKind;
use xca_core::{Boundary, Faces, Model, ParameterSet, ParameterValue, Precision, ValueType};
use xca_io::atomic::{WriteError, write_atomically};
use xca_io::map::Placement;

/// The report of a run.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Report {
    /// The version of the framework; its presence says whose report this is.
    pub(crate) xca: &'static str,
    pub(crate) program: &'static str,
    pub(crate) version: &'static str,
    pub(crate) command_line: Vec<String>,
    /// All options of the model, with their defaults.
    pub(crate) options: Map<String, Value>,
    /// What the model's program adds.
    #[serde(flatten)]
    pub(crate) notes: Map<String, Value>,
    pub(crate) model: ModelReport,
    /// Where the cells lie, of a model on a map.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) map: Option<MapReport>,
    pub(crate) parameters: Map<String, Value>,
    /// Of the parameters and substates that have one.
    pub(crate) units: Map<String, Value>,
    pub(crate) engine: String,
    pub(crate) threads: usize,
    /// What the engine says of its device, if it has one.
    pub(crate) device: Map<String, Value>,
    pub(crate) precision: Precision,
    pub(crate) seed: u64,
    pub(crate) every: u64,
    /// Steps or time.
    pub(crate) checkpoint_every: Option<String>,
    pub(crate) host: Host,
    pub(crate) started: String,
    /// When and from where the run was resumed.
    pub(crate) resumed: Vec<Value>,
    pub(crate) progress: Progress,
    pub(crate) observables: Vec<ObservableReport>,
    pub(crate) files: Vec<String>,
}

/// How far a run has come, and what it took.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Progress {
    /// `running`, `done`, `stopped`, `interrupted` or `failed`.
    pub(crate) outcome: &'static str,
    /// Why it was stopped, or what went wrong.
    pub(crate) reason: Option<String>,
    pub(crate) steps: u64,
    pub(crate) steps_wanted: u64,
    /// Simulated time, in s where the model knows it.
    pub(crate) time: f64,
    pub(crate) time_step: Option<f64>,
    pub(crate) frames: usize,
    pub(crate) set_up_seconds: f64,
    pub(crate) step_seconds: f64,
    pub(crate) output_seconds: f64,
    pub(crate) wall_seconds: f64,
    pub(crate) steps_per_second: Option<f64>,
    pub(crate) state_bytes: Option<usize>,
    pub(crate) peak_memory_bytes: Option<u64>,
}

impl Report {
    /// Writes the report, in place of the one before.
    pub(crate) fn write(&self, path: &Path) -> Result<(), WriteError> {
        write_atomically(path, |file| {
            serde_json::to_writer_pretty(&mut *file, self).map_err(io::Error::from)?;
            file.write_all(b"\n")
        })
    }

    /// Makes this the report of a run that goes on from a checkpoint after that step.
    pub(crate) fn go_on(&mut self, earlier: &Earlier, step: u64, checkpoint: &Path) {
        if let Some(started) = &earlier.started {
            self.started.clone_from(started);
        }
        self.resumed.clone_from(&earlier.resumed);
        self.resumed.push(serde_json::json!({
            "at": now(),
            "step": step,
            "checkpoint": checkpoint.file_name().map(|name| name.to_string_lossy()),
            "engine": self.engine,
            "threads": self.threads,
        }));
    }
}

/// What `run.json` tells of a run before it was resumed; all nothing where there is no such file.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Earlier {
    command_line: Option<Vec<String>>,
    started: Option<String>,
    resumed: Vec<Value>,
    progress: EarlierProgress,
}

/// What the run had taken when this was written last: after its last checkpoint, or at its end.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default)]
pub(crate) struct EarlierProgress {
    outcome: String,
    pub(crate) set_up_seconds: f64,
    pub(crate) step_seconds: f64,
    pub(crate) wall_seconds: f64,
}

impl Earlier {
    /// Reads the report in the folder of a run.
    pub(crate) fn read(folder: &Path) -> Self {
        let text = std::fs::read(folder.join(REPORT)).unwrap_or_default();
        serde_json::from_slice(&text).unwrap_or_default()
    }

    /// Whether it is the report of what this subcommand did.
    pub(crate) fn is_of(&self, subcommand: &str) -> bool {
        self.command_line.as_ref().and_then(|words| words.get(1)).is_some_and(|word| word == subcommand)
    }

    /// All that the report in the folder of a run tells.
    pub(crate) fn whole(folder: &Path) -> Value {
        let text = std::fs::read(folder.join(REPORT)).unwrap_or_default();
        serde_json::from_slice(&text).unwrap_or_default()
    }

    /// Whether there is nothing left to do.
    pub(crate) fn has_ended(&self) -> bool {
        ["done", "stopped"].contains(&self.progress.outcome.as_str())
    }

    /// How this is the report of another run than one with this command line.
    pub(crate) fn difference(&self, command_line: &[String]) -> Option<Difference> {
        let own = self.command_line.as_ref().filter(|own| *own != command_line)?;
        Some(Difference { what: "command line", found: command_line.join(" "), wanted: own.join(" ") })
    }

    /// What the run had taken.
    pub(crate) fn taken(&self) -> &EarlierProgress {
        &self.progress
    }
}

/// The shape of a model.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct ModelReport {
    name: String,
    cells: [usize; 3],
    cell_side: f64,
    boundaries: Faces<Boundary>,
    neighbourhood: String,
    groups: Vec<GroupReport>,
    processes: Vec<&'static str>,
}

/// Where the cells of a model lie.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct MapReport {
    /// The south-west corner.
    corner: [f64; 2],
    cell_side: f64,
    cells_without_ground: usize,
}

/// The place of a model on the map.
pub(crate) fn of_map(set_up: &SetUp) -> Option<MapReport> {
    let missing = set_up.missing().unwrap_or_default();
    let Placement { corner, side, .. } = set_up.placement();
    let cells_without_ground = missing.iter().filter(|is_missing| **is_missing).count();
    set_up.map.as_ref().map(|_| MapReport { corner, cell_side: side, cells_without_ground })
}

/// Substates that belong together.
#[derive(Debug, Clone, Serialize)]
struct GroupReport {
    name: &'static str,
    substates: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    slots: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    items_may_leave: Option<bool>,
}

/// The machine.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Host {
    pub(crate) cores: Option<usize>,
    pub(crate) system: &'static str,
    pub(crate) processor: &'static str,
}

/// A quantity before the first step and after the last.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct ObservableReport {
    name: String,
    unit: String,
    initial: f64,
    #[serde(rename = "final")]
    last: f64,
    /// Of a quantity that the model keeps.
    #[serde(skip_serializing_if = "Option::is_none")]
    drift: Option<f64>,
}

/// The shape of a model.
pub(crate) fn of_model(model: &Model) -> ModelReport {
    let geometry = model.geometry();
    let groups = model.groups().iter().map(|group| {
        let (slots, items_may_leave) = match group.kind() {
            GroupKind::Population { slots, may_leave } => (Some(*slots), Some(*may_leave)),
            GroupKind::Cells { .. } => (None, None),
        };
        let fields = group.schema().fields.iter();
        let substates =
            fields.map(|field| format!("{}: {}", field.name, type_text(field.value_type))).collect();
        GroupReport { name: group.schema().name, substates, slots, items_may_leave }
    });
    ModelReport {
        name: model.name().to_owned(),
        cells: geometry.extents(),
        cell_side: geometry.side(),
        boundaries: geometry.boundaries(),
        neighbourhood: geometry.neighbourhood().to_string(),
        groups: groups.collect(),
        processes: model.processes().iter().map(|process| process.name).collect(),
    }
}

/// The machine that this program runs on.
pub(crate) fn of_host() -> Host {
    Host { cores: cores(), system: std::env::consts::OS, processor: std::env::consts::ARCH }
}

/// The values of all parameters by name.
pub(crate) fn of_parameters(parameters: &ParameterSet) -> Map<String, Value> {
    let values = parameters.values().map(|value| of_value(&value));
    parameters.names().into_iter().zip(values).collect()
}

/// The units of parameters, by their names, and of substates, as `Struct.field`.
pub(crate) fn of_units(model: &Model) -> Map<String, Value> {
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
pub(crate) fn of_observables(first: &[Observable], last: &[Observable]) -> Vec<ObservableReport> {
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
pub(crate) fn now() -> String {
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
