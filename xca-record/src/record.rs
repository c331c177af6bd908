//! What a run leaves behind: observables, frames, tables of items and pictures.

mod cells;
mod drawing;
mod folder;
mod frame_field;
mod grids;
mod items;
mod look;
mod measure;
mod painting;
mod recorded;
mod saved;
mod seen;
mod shown;
mod sight;
mod values;

pub use drawing::{Drawing, Scales};
pub use folder::{
    COMPARISON, Claim, ENSEMBLE, FRAMES, FolderError, Kind, LockedFolder, REPORT, RunFolder, numbered_files,
};
pub use items::column_type;
pub use look::{Look, ViewKind};
pub use recorded::Recorded;
pub use saved::SavedError;
pub use seen::Seen;
pub use sight::{Sight, Subject};

use crate::observable::{Failure, Observable};
use crate::set_up::SetUp;
use crate::view::{ViewError, complete};
use painting::Frame;
use shown::Shown;
pub use values::Plane;
use xca_core::{Model, Precision, RunError, Simulation, Snapshot};
use xca_io::atomic::WriteError;
use xca_io::particle_csv::WriteParticlesError;
use xca_io::picture::PictureError;
use xca_io::table_csv::{SeriesError, SeriesWriter};
use xca_io::vtk::{Collection, VtkError};

/// A part of a run's record that cannot be made or written.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages explain the fields")]
#[non_exhaustive]
pub enum RecordError {
    #[error(transparent)]
    Table(#[from] WriteParticlesError),
    #[error(transparent)]
    Vtk(#[from] VtkError),
    #[error(transparent)]
    Picture(#[from] PictureError),
    #[error(transparent)]
    Write(#[from] WriteError),
    #[error(transparent)]
    Series(#[from] SeriesError),
    #[error(transparent)]
    State(#[from] RunError),
    #[error(transparent)]
    Folder(#[from] FolderError),
    #[error("the observables cannot be measured after step {step}")]
    Observe { step: u64, source: Failure },
    #[error("the observables after step {step} are not those of the start: {now} instead of {before}")]
    OtherObservables { step: u64, now: String, before: String },
}

/// Writes the files of a run.
#[derive(Debug)]
pub struct Recorder {
    set_up: SetUp,
    shown: Vec<Shown>,
    folder: Option<RunFolder>,
    series: Option<SeriesWriter>,
    first: Vec<Observable>,
    last: Vec<Observable>,
    /// The steps after which the state was recorded.
    steps: Vec<u64>,
}

impl Recorder {
    /// Checks what the set-up wants to be shown.
    pub fn new(mut set_up: SetUp) -> Result<Self, ViewError> {
        let views = complete(&set_up.model, std::mem::take(&mut set_up.views))?;
        let shown = |(group, view)| Shown::new(group, view, set_up.map.clone());
        let shown = views.into_iter().map(shown).collect();
        Ok(Self {
            set_up,
            shown,
            folder: None,
            series: None,
            first: Vec::new(),
            last: Vec::new(),
            steps: Vec::new(),
        })
    }

    pub fn set_up(&self) -> &SetUp {
        &self.set_up
    }

    pub fn model(&self) -> &Model {
        &self.set_up.model
    }

    /// The files that a run makes, below its folder; `*` stands for the number of the step.
    pub fn files(&self) -> Vec<String> {
        let mut files = vec![SERIES.to_owned()];
        for (number, shown) in self.shown.iter().enumerate() {
            let name = shown.stem();
            if shown.is_of_items() {
                files.push(self.numbered_file("final", number, "csv"));
            }
            files.push(shown.collection_file());
            files.push(format!("{}/{name}_*.{}", FRAMES, shown.extension()));
            files.push(self.numbered_file("initial", number, "png"));
            files.push(self.numbered_file("final", number, "png"));
        }
        files.extend(self.grid_files());
        files
    }

    /// `final.png` of the first view of its kind, `final_NAME.png` of the others.
    fn numbered_file(&self, stem: &str, number: usize, extension: &str) -> String {
        let before = &self.shown[..number];
        let first = if extension == "csv" {
            before.iter().all(|other| !other.is_of_items())
        } else {
            before.is_empty()
        };
        if first {
            format!("{stem}.{extension}")
        } else {
            format!("{stem}_{}.{extension}", self.shown[number].stem())
        }
    }

    /// How many frames there are, the observables before the first step and the last ones.
    pub fn results(&self) -> (usize, &[Observable], &[Observable]) {
        (self.steps.len(), &self.first, &self.last)
    }

    /// The simulated time after so many steps: in seconds, or in steps where the model does not know better.
    pub fn time(&self, step: u64) -> f64 {
        step as f64 * self.set_up.time_step.unwrap_or(1.0)
    }

    /// Whether the initial state has been recorded.
    pub fn has_begun(&self) -> bool {
        self.folder.is_some()
    }

    /// Records the initial state.
    pub fn begin(&mut self, folder: RunFolder, simulation: &mut Simulation) -> Result<(), RecordError> {
        self.folder = Some(folder);
        let snapshot = self.record(simulation)?;
        self.draw(simulation.options().precision, &snapshot, "initial")
    }

    /// Records the present state as a row of observables and a frame, unless that is done already.
    pub fn record(&mut self, simulation: &mut Simulation) -> Result<Snapshot, RecordError> {
        let snapshot = simulation.snapshot()?;
        if self.steps.last() != Some(&snapshot.step) {
            self.observe(simulation, &snapshot)?;
            self.write_frames(simulation.options().precision, &snapshot)?;
            self.steps.push(snapshot.step);
        }
        Ok(snapshot)
    }

    /// Records the final state.
    pub fn finish(&mut self, simulation: &mut Simulation) -> Result<(), RecordError> {
        let snapshot = self.record(simulation)?;
        let precision = simulation.options().precision;
        let Some(folder) = &self.folder else { return Ok(()) };
        for (number, shown) in self.shown.iter().enumerate() {
            if let Some(items) = shown.items(&self.set_up.model, precision, &snapshot) {
                items.write_table(&folder.top.file(&self.numbered_file("final", number, "csv")))?;
            }
        }
        self.write_grids(&snapshot, precision, |file| folder.top.file(file))?;
        self.draw(precision, &snapshot, "final")
    }

    /// The observables of the present state, of which a snapshot was taken.
    pub fn measure(
        &self,
        simulation: &mut Simulation,
        snapshot: &Snapshot,
    ) -> Result<Vec<Observable>, RecordError> {
        let step = snapshot.step;
        match &self.set_up.observe {
            Some(observe) => {
                observe(&simulation.state()).map_err(|source| RecordError::Observe { step, source })
            }
            None => {
                let (model, precision) = (simulation.model(), simulation.options().precision);
                Ok(measure::measure(model, precision, snapshot, self.set_up.missing()))
            }
        }
    }

    fn observe(&mut self, simulation: &mut Simulation, snapshot: &Snapshot) -> Result<(), RecordError> {
        let step = snapshot.step;
        let observables = self.measure(simulation, snapshot)?;
        let names = |observables: &[Observable]| -> Vec<String> {
            observables.iter().map(|observable| observable.name.clone()).collect()
        };
        let (now, time) = (names(&observables), self.time(step));
        let series = match (&mut self.series, &self.folder) {
            (Some(series), _) => {
                let before = names(&self.first);
                if now != before {
                    let (now, before) = (now.join(", "), before.join(", "));
                    return Err(RecordError::OtherObservables { step, now, before });
                }
                series
            }
            (series, Some(folder)) => {
                self.first.clone_from(&observables);
                let now: Vec<&str> = now.iter().map(String::as_str).collect();
                series.insert(SeriesWriter::create(&folder.top.file(SERIES), &now)?)
            }
            (None, None) => return Ok(()),
        };
        let values: Vec<f64> = observables.iter().map(|observable| observable.value).collect();
        series.append(step, time, &values)?;
        self.last = observables;
        Ok(())
    }

    fn write_frames(&mut self, precision: Precision, snapshot: &Snapshot) -> Result<(), RecordError> {
        let (time, model) = (self.time(snapshot.step), &self.set_up.model);
        let Some(folder) = &self.folder else { return Ok(()) };
        for shown in &mut self.shown {
            let path = shown.frame(&folder.frames, snapshot.step);
            if let Some(items) = shown.items(model, precision, snapshot) {
                items.write_frame(&path, time, shown.ground().corner)?;
            } else if let Some(cells) = shown.cells(model, precision, snapshot) {
                cells.write_frame(&path, time)?;
            }
            let list = folder.top.file(&shown.collection_file());
            let collection = match &mut shown.collection {
                Some(collection) => collection,
                none => none.insert(Collection::create(&list)?),
            };
            collection.add(time, &path)?;
        }
        Ok(())
    }

    fn draw(&mut self, precision: Precision, snapshot: &Snapshot, stem: &str) -> Result<(), RecordError> {
        for number in 0..self.shown.len() {
            let (shown, model) = (&self.shown[number], &self.set_up.model);
            let Some(seen) = shown.seen(model, precision, snapshot) else { continue };
            let caption = self.whole_caption(shown, &seen, snapshot.step);
            let frame =
                Frame { title: &self.set_up.title, caption: &caption, range: shown.range, size: None };
            if let (Some(folder), Some(picture)) = (&self.folder, shown.paint(model, &seen, frame)?) {
                picture.write(&folder.top.file(&self.numbered_file(stem, number, "png")))?;
            }
            // Items have a scale of their own in each picture.
            if !shown.is_of_items() {
                self.shown[number].range = shown.range.or_else(|| seen.range());
            }
        }
        Ok(())
    }

    /// The step, and what else has to be said of a picture of one view.
    fn whole_caption(&self, shown: &Shown, seen: &Seen, step: u64) -> String {
        let details = shown.details(&self.set_up.model, seen, false);
        [Some(self.caption(step)), details].into_iter().flatten().collect::<Vec<_>>().join(", ")
    }

    fn caption(&self, step: u64) -> String {
        match self.set_up.time_step {
            Some(_) => {
                format!("step {step}, time {} s", xca_io::numbers::significant(self.time(step), 4))
            }
            None => format!("step {step}"),
        }
    }
}

/// The time series.
const SERIES: &str = "observables.csv";
