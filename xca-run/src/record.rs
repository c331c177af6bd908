//! What a run leaves behind: observables, frames, tables of items and pictures.

mod cells;
mod drawing;
mod folder;
mod items;
mod measure;
mod recorded;
mod shown;
mod sight;
mod values;

pub(crate) use drawing::{Drawing, Look, ViewKind};
pub use folder::FolderError;
pub(crate) use folder::{REPORT, RunFolder, numbered_files};
pub(crate) use recorded::Recorded;
pub(crate) use sight::{Sight, Subject};

use crate::output::atomic::WriteError;
use crate::output::particle_csv::WriteParticlesError;
use crate::output::picture::{Picture, PictureError};
use crate::output::table_csv::{SeriesError, SeriesWriter};
use crate::output::vtk::{Collection, VtkError};
use crate::program::{Failure, Observable};
use crate::set_up::SetUp;
use crate::view::{ViewError, complete};
use shown::Shown;
pub(crate) use values::Plane;
use xca_core::{Model, RunError, Simulation, Snapshot};

/// A part of a run's record that cannot be made or written.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages explain the fields")]
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
pub(crate) struct Recorder {
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
    pub(crate) fn new(mut set_up: SetUp) -> Result<Self, ViewError> {
        let views = complete(&set_up.model, std::mem::take(&mut set_up.views))?;
        let shown = views.into_iter().map(|(group, view)| Shown::new(group, view)).collect();
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

    pub(crate) fn set_up(&self) -> &SetUp {
        &self.set_up
    }

    pub(crate) fn model(&self) -> &Model {
        &self.set_up.model
    }

    /// The files that a run makes, below its folder; `*` stands for the number of the step.
    pub(crate) fn files(&self) -> Vec<String> {
        let mut files = vec![SERIES.to_owned()];
        for (number, shown) in self.shown.iter().enumerate() {
            let name = shown.view.name();
            if shown.is_of_items() {
                files.push(self.numbered_file("final", number, "csv"));
            }
            files.push(shown.collection_file());
            files.push(format!("{}/{name}_*.{}", folder::FRAMES, shown.extension()));
            files.push(self.numbered_file("initial", number, "png"));
            files.push(self.numbered_file("final", number, "png"));
        }
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
            format!("{stem}_{}.{extension}", self.shown[number].view.name())
        }
    }

    /// How many frames there are, the observables before the first step and the last ones.
    pub(crate) fn results(&self) -> (usize, &[Observable], &[Observable]) {
        (self.steps.len(), &self.first, &self.last)
    }

    /// The simulated time after so many steps: in seconds, or in steps where the model does not know better.
    pub(crate) fn time(&self, step: u64) -> f64 {
        step as f64 * self.set_up.time_step.unwrap_or(1.0)
    }

    /// Whether the initial state has been recorded.
    pub(crate) fn has_begun(&self) -> bool {
        self.folder.is_some()
    }

    /// Records the initial state.
    pub(crate) fn begin(
        &mut self,
        folder: RunFolder,
        simulation: &mut Simulation,
    ) -> Result<(), RecordError> {
        self.folder = Some(folder);
        let snapshot = self.record(simulation)?;
        self.draw(simulation, &snapshot, "initial")
    }

    /// Records the present state as a row of observables and a frame, unless that is done already.
    pub(crate) fn record(&mut self, simulation: &mut Simulation) -> Result<Snapshot, RecordError> {
        let snapshot = simulation.snapshot()?;
        if self.steps.last() != Some(&snapshot.step) {
            self.observe(simulation, &snapshot)?;
            self.write_frames(simulation, &snapshot)?;
            self.steps.push(snapshot.step);
        }
        Ok(snapshot)
    }

    /// Records the final state.
    pub(crate) fn finish(&mut self, simulation: &mut Simulation) -> Result<(), RecordError> {
        let snapshot = self.record(simulation)?;
        let Some(folder) = &self.folder else { return Ok(()) };
        for (number, shown) in self.shown.iter().enumerate() {
            if let Some(items) = shown.items(simulation, &snapshot) {
                items.write_table(&folder.top.file(&self.numbered_file("final", number, "csv")))?;
            }
        }
        self.draw(simulation, &snapshot, "final")
    }

    /// The observables of the present state, of which a snapshot was taken.
    pub(crate) fn measure(
        &self,
        simulation: &mut Simulation,
        snapshot: &Snapshot,
    ) -> Result<Vec<Observable>, RecordError> {
        let step = snapshot.step;
        match &self.set_up.observe {
            Some(observe) => {
                observe(&simulation.state()).map_err(|source| RecordError::Observe { step, source })
            }
            None => Ok(measure::measure(simulation.model(), simulation.options().precision, snapshot)),
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

    fn write_frames(&mut self, simulation: &Simulation, snapshot: &Snapshot) -> Result<(), RecordError> {
        let time = self.time(snapshot.step);
        let Some(folder) = &self.folder else { return Ok(()) };
        for shown in &mut self.shown {
            let path = shown.frame(folder, snapshot.step);
            if let Some(items) = shown.items(simulation, snapshot) {
                items.write_frame(&path, time)?;
            } else if let Some(cells) = shown.cells(simulation, snapshot) {
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

    fn draw(&mut self, simulation: &Simulation, snapshot: &Snapshot, stem: &str) -> Result<(), RecordError> {
        let caption = self.caption(snapshot.step);
        for number in 0..self.shown.len() {
            let (picture, range) = self.picture(number, simulation, snapshot, &caption)?;
            self.shown[number].range = self.shown[number].range.or(range);
            if let (Some(folder), Some(picture)) = (&self.folder, picture) {
                picture.write(&folder.top.file(&self.numbered_file(stem, number, "png")))?;
            }
        }
        Ok(())
    }

    /// A picture of a view, and the range of the values that it shows.
    fn picture(
        &self,
        number: usize,
        simulation: &Simulation,
        snapshot: &Snapshot,
        caption: &str,
    ) -> Result<(Option<Picture>, Option<[f64; 2]>), RecordError> {
        let shown = &self.shown[number];
        let title = &self.set_up.title;
        Ok(if let Some(items) = shown.items(simulation, snapshot) {
            let caption = format!("{caption}, {} {}", items.len(), shown.view.name());
            (Some(items.draw(title, &caption, None, None)?), None)
        } else if let Some(cells) = shown.cells(simulation, snapshot) {
            (Some(cells.draw(title, caption, shown.range, None)?), cells.range())
        } else {
            (None, None)
        })
    }

    fn caption(&self, step: u64) -> String {
        match self.set_up.time_step {
            Some(_) => {
                format!("step {step}, time {} s", crate::numbers::significant(self.time(step), 4))
            }
            None => format!("step {step}"),
        }
    }
}

/// The time series.
const SERIES: &str = "observables.csv";
