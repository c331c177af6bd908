//! What a recorder has done, and going on from there.

use super::folder::remove;
use super::{RecordError, Recorder, RunFolder, SERIES};
use crate::format::{Moment, ResumedRun};
use serde_json::Value;
use std::collections::HashSet;
use std::path::PathBuf;
use xca_checkpoint::{Exact, Quantity, Recorded};
use xca_io::table_csv::SeriesWriter;
use xca_observe::Observable;

/// An observable to the last bit.
fn quantity(Observable { name, unit, value, is_conserved }: &Observable) -> Quantity {
    Quantity { name: name.clone(), unit: unit.clone(), value: Exact(*value), is_conserved: *is_conserved }
}

fn observable(Quantity { name, unit, value, is_conserved }: &Quantity) -> Observable {
    Observable { name: name.clone(), unit: unit.clone(), value: value.0, is_conserved: *is_conserved }
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
            first: self.first.iter().map(quantity).collect(),
            last: self.last.iter().map(quantity).collect(),
            formats: self
                .formats
                .chosen()
                .map(|writer| (writer.name().to_owned(), writer.memory()))
                .collect(),
        })
    }

    /// Goes on where a recorder of the same model was. What was written after that is removed; it will be
    /// written again.
    pub fn resume(&mut self, folder: RunFolder, recorded: &Recorded) -> Result<(), RecordError> {
        self.first = recorded.first.iter().map(observable).collect();
        self.last = recorded.last.iter().map(observable).collect();
        self.steps.clone_from(&recorded.steps);
        // The time series first: if it is not the one that was written, nothing has been changed yet.
        self.series =
            Some(SeriesWriter::resume(&folder.top.file(SERIES), self.first.len(), recorded.series)?);
        remove(self.newer_files(&folder))?;
        let subject = self.set_up.subject(&self.shown);
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
