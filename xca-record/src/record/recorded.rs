//! What a recorder has done, and going on from there.

use super::folder::remove;
use super::{RecordError, Recorder, RunFolder, SERIES};
use crate::numbers::Exact;
use crate::observable::Observable;
use serde::{Deserialize, Serialize};
use std::collections::HashSet;
use std::path::PathBuf;
use xca_io::table_csv::{SeriesWriter, Written};
use xca_io::vtk::Collection;

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
    /// For each view, the scale of the first picture.
    scales: Vec<Option<[Exact; 2]>>,
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
            scales: self.shown.iter().map(|shown| shown.range.map(|range| range.map(Exact))).collect(),
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
        let entries = |frame: &dyn Fn(u64) -> PathBuf| -> Vec<(f64, PathBuf)> {
            recorded.steps.iter().map(|step| (self.time(*step), frame(*step))).collect()
        };
        let mut collections = Vec::new();
        for shown in &self.shown {
            let path = folder.top.file(&shown.collection_file());
            collections.push(Collection::of(&path, &entries(&|step| shown.frame(&folder.frames, step)))?);
        }
        let scales = recorded.scales.iter().map(|scale| scale.map(|scale| scale.map(|number| number.0)));
        for ((shown, collection), scale) in self.shown.iter_mut().zip(collections).zip(scales) {
            shown.collection = Some(collection);
            shown.range = scale;
        }
        self.folder = Some(folder);
        Ok(())
    }

    /// The frames of steps that are not recorded, and the files of the end.
    fn newer_files(&self, folder: &RunFolder) -> Vec<PathBuf> {
        let mut newer = Vec::new();
        for (number, shown) in self.shown.iter().enumerate() {
            let recorded: HashSet<PathBuf> =
                self.steps.iter().map(|step| shown.frame(&folder.frames, *step)).collect();
            let frames = shown.frames(&folder.frames).into_iter();
            newer.extend(frames.filter(|frame| !recorded.contains(frame)));
            newer.push(folder.top.file(&self.numbered_file("final", number, "png")));
            if shown.is_of_items() {
                newer.push(folder.top.file(&self.numbered_file("final", number, "csv")));
            }
        }
        newer.extend(self.grid_files().iter().map(|file| folder.top.file(file)));
        newer
    }
}
