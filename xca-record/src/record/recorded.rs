//! What a recorder has done, and going on from there.

use super::folder::remove;
use super::{RecordError, Recorder, RunFolder, SERIES};
use crate::format::{Moment, ResumedRun, Subject};
use crate::numbers::Exact;
use crate::observable::Observable;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::collections::HashSet;
use std::path::PathBuf;
use xca_io::table_csv::{SeriesWriter, Written};

/// What a recorder has written, as a checkpoint keeps it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Recorded {
    /// The steps after which the state was recorded.
    steps: Vec<u64>,
    /// How long the time series was.
    series: Written,
    /// The observables before the first step.
    first: Vec<Quantity>,
    /// Those of the last of the steps.
    last: Vec<Quantity>,
    /// What each format has to know.
    formats: Map<String, Value>,
}

impl Recorded {
    /// Whether this can have been recorded until that step: in order, and each step once.
    pub(crate) fn can_be_after(&self, step: u64) -> bool {
        self.steps.is_sorted_by(|one, next| one < next) && self.steps.last().is_none_or(|last| *last <= step)
    }
}

/// An observable that is kept to the last bit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Quantity {
    name: String,
    unit: String,
    value: Exact,
    is_conserved: bool,
}

impl From<&Observable> for Quantity {
    fn from(Observable { name, unit, value, is_conserved }: &Observable) -> Self {
        Self { name: name.clone(), unit: unit.clone(), value: Exact(*value), is_conserved: *is_conserved }
    }
}

impl From<&Quantity> for Observable {
    fn from(Quantity { name, unit, value, is_conserved }: &Quantity) -> Self {
        Self { name: name.clone(), unit: unit.clone(), value: value.0, is_conserved: *is_conserved }
    }
}

impl Recorder {
    /// What has been written until now; all of it is on the disk then.
    pub fn recorded(&self) -> Result<Recorded, RecordError> {
        let series = self.series.as_ref().map(SeriesWriter::written).transpose()?;
        if let Some(folder) = &self.folder {
            folder.top.sync()?;
            folder.frames.sync()?;
        }
        Ok(Recorded {
            steps: self.steps.clone(),
            series: series.unwrap_or_default(),
            first: self.first.iter().map(Quantity::from).collect(),
            last: self.last.iter().map(Quantity::from).collect(),
            formats: self
                .formats
                .chosen()
                .map(|writer| (writer.name().to_owned(), writer.memory()))
                .collect(),
        })
    }

    /// Goes on where a recorder of the same model was. What was written after that is removed; it will be written again.
    pub fn resume(&mut self, folder: RunFolder, recorded: &Recorded) -> Result<(), RecordError> {
        self.first = recorded.first.iter().map(Observable::from).collect();
        self.last = recorded.last.iter().map(Observable::from).collect();
        self.steps.clone_from(&recorded.steps);
        // The time series first: if it is not the one that was written, nothing has been changed yet.
        self.series =
            Some(SeriesWriter::resume(&folder.top.file(SERIES), self.first.len(), recorded.series)?);
        remove(self.newer_files(&folder))?;
        let subject = Subject { set_up: &self.set_up, shown: &self.shown };
        for writer in self.formats.writers() {
            let memory = recorded.formats.get(writer.name()).unwrap_or(&Value::Null);
            let run = ResumedRun::new(subject, &recorded.steps, &folder);
            let format = writer.name();
            writer.resume(run, memory).map_err(|source| RecordError::OtherFormats { format, source })?;
        }
        self.folder = Some(folder);
        Ok(())
    }

    /// The files of states that are not recorded, and those of the end.
    fn newer_files(&self, folder: &RunFolder) -> Vec<PathBuf> {
        let recorded: HashSet<u64> = self.steps.iter().copied().collect();
        let mut newer = Vec::new();
        for file in self.formats.chosen().flat_map(|writer| writer.files(self.subject())) {
            match file.moment() {
                Moment::Each => {
                    let saved = file.saved(folder.frames.path()).into_iter();
                    newer.extend(saved.filter(|(step, _)| !recorded.contains(step)).map(|(_, path)| path));
                }
                Moment::Last => newer.push(file.path(folder, 0)),
                Moment::Run | Moment::First => {}
            }
        }
        newer
    }
}
