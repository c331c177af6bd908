//! What a run leaves behind: observables, and the files of its formats.

mod cells;
mod drawing;
mod folder;
mod items;
pub(crate) mod layer;
mod look;
mod outputs;
mod painting;
mod panel;
mod recorded;
mod saved;
mod saved_run;
mod seen;
mod shown;
mod sight;
mod source;
mod substate_values;
mod typed;
mod values;

pub use cells::CellState;
pub(crate) use cells::lattice;
pub use drawing::{Drawing, Scales};
pub(crate) use folder::SERIES;
pub use folder::{COMPARISON, Claim, ENSEMBLE, FRAMES, FolderError, Kind, LockedFolder, REPORT, RunFolder};
pub use items::{ItemBlock, ItemColumn, ItemState, column_type};
pub use look::{Look, ViewKind};
pub(crate) use painting::Frame;
pub use saved::SavedError;
pub use saved_run::SavedRun;
pub use seen::Seen;
pub(crate) use shown::Shown;
pub use sight::{Sight, Subject};
pub(crate) use source::Source;
pub(crate) use substate_values::Unwritten;
pub use substate_values::{CellSubstate, SubstateValues};
pub(crate) use typed::{NoValue, retyped};
pub use values::Plane;

use crate::failure::Failure;
use crate::format::{self, Formats, RecordedState};
use crate::set_up::{SetUp, SetUpError};
use crate::view::complete;
use xca_core::{Model, ModelError, RunError, Simulation};
use xca_io::atomic::WriteError;
use xca_io::table_csv::{SeriesError, SeriesWriter};
use xca_machine::{NotEnoughMemory, check_memory};
use xca_observe::Observable;
use xca_picture::PictureError;

/// A part of a run's record that cannot be made or written.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages explain the fields")]
#[non_exhaustive]
pub enum RecordError {
    #[error(transparent)]
    Format(Failure),
    #[error("the checkpoint does not say how to continue the files of the format {format}")]
    OtherFormats { format: &'static str, source: Failure },
    #[error(transparent)]
    Memory(#[from] NotEnoughMemory),
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
    #[error("the observables after step {step} differ from those of the start: {now} instead of {before}")]
    OtherObservables { step: u64, now: String, before: String },
}

/// Writes the files of a run.
#[derive(Debug)]
pub struct Recorder {
    set_up: SetUp,
    shown: Vec<Shown>,
    formats: Formats,
    folder: Option<RunFolder>,
    series: Option<SeriesWriter>,
    first: Vec<Observable>,
    last: Vec<Observable>,
    /// The steps after which the state was recorded.
    steps: Vec<u64>,
}

impl Recorder {
    /// Checks what the set-up wants to be shown and written.
    pub fn new(mut set_up: SetUp) -> Result<Self, SetUpError> {
        let views = complete(&set_up.model, std::mem::take(&mut set_up.views))?;
        let shown = |(group, view)| Shown::new(group, view, set_up.map.clone());
        let shown = views.into_iter().map(shown).collect();
        let formats = std::mem::take(&mut set_up.formats);
        let recorder = Self {
            set_up,
            shown,
            formats,
            folder: None,
            series: None,
            first: Vec::new(),
            last: Vec::new(),
            steps: Vec::new(),
        };
        let subject = recorder.subject();
        recorder.formats.chosen().try_for_each(|writer| writer.check(subject)).map_err(SetUpError::Format)?;
        // A file system may ignore capitals.
        let mut files: Vec<String> = recorder.files().iter().map(|file| file.to_lowercase()).collect();
        files.sort_unstable();
        match files.array_windows().find(|[one, other]| one == other) {
            Some([file, _]) => Err(SetUpError::SameFile(file.clone())),
            None => Ok(recorder),
        }
    }

    pub fn set_up(&self) -> &SetUp {
        &self.set_up
    }

    pub fn model(&self) -> &Model {
        &self.set_up.model
    }

    /// Gives the cells at least so many slots for the items of a population of the model's.
    pub(crate) fn raise_slots(&mut self, population: &str, least: usize) -> Result<(), ModelError> {
        let model = &mut self.set_up.model;
        match model.slots(population) {
            Some(slots) if slots >= least => Ok(()),
            _ => model.set_slots(population, least),
        }
    }

    pub(crate) fn subject(&self) -> format::Subject<'_> {
        self.set_up.subject(&self.shown)
    }

    /// The files that a run makes, below its folder; `*` stands for the number of the step.
    pub fn files(&self) -> Vec<String> {
        let of_formats = self.formats.chosen().flat_map(|writer| writer.files(self.subject()));
        [SERIES.to_owned()].into_iter().chain(of_formats.map(|file| file.listed())).collect()
    }

    /// How many frames there are, the observables before the first step and the last ones.
    pub fn results(&self) -> (usize, &[Observable], &[Observable]) {
        (self.steps.len(), &self.first, &self.last)
    }

    /// The simulated time after so many steps: in seconds, or in steps where the model does not know better.
    pub fn time(&self, step: u64) -> f64 {
        self.subject().time(step)
    }

    /// Whether the initial state has been recorded.
    pub fn has_begun(&self) -> bool {
        self.folder.is_some()
    }

    /// Records the initial state.
    pub fn begin(&mut self, folder: RunFolder, simulation: &mut Simulation) -> Result<(), RecordError> {
        self.folder = Some(folder);
        self.record(simulation)?;
        self.write(simulation, |writer, state| writer.begin(state))
    }

    /// Records the present state as a row of observables and by the formats, unless that is done already.
    pub fn record(&mut self, simulation: &mut Simulation) -> Result<(), RecordError> {
        let memory = self.memory_of_outputs(simulation).map_err(RunError::from)?;
        check_memory(memory, "the outputs of this state")?;
        if self.steps.last() != Some(&simulation.step_number()) {
            self.observe(simulation)?;
            self.write(simulation, |writer, state| writer.record(state))?;
            self.steps.push(simulation.step_number());
        }
        Ok(())
    }

    /// Records the final state.
    pub fn finish(&mut self, simulation: &mut Simulation) -> Result<(), RecordError> {
        self.record(simulation)?;
        self.write(simulation, |writer, state| writer.finish(state))
    }

    /// Hands a state to the formats that are chosen.
    fn write(
        &mut self,
        simulation: &Simulation,
        write: fn(&mut dyn format::Writer, RecordedState<'_>) -> Result<(), Failure>,
    ) -> Result<(), RecordError> {
        let Some(folder) = &self.folder else { return Ok(()) };
        let (subject, precision) = (self.set_up.subject(&self.shown), simulation.options().precision);
        let state = RecordedState { subject, source: Source::Simulation(simulation), precision, folder };
        let mut writers = self.formats.writers();
        writers.try_for_each(|writer| write(&mut **writer, state)).map_err(RecordError::Format)
    }

    /// The observables of the present state.
    pub fn measure(&self, simulation: &mut Simulation) -> Result<Vec<Observable>, RecordError> {
        let step = simulation.step_number();
        match &self.set_up.observe {
            Some(observe) => {
                observe(&simulation.state()).map_err(|source| RecordError::Observe { step, source })
            }
            None => xca_observe::measure(simulation, self.set_up.missing())
                .map_err(|failure| RecordError::State(failure.into())),
        }
    }

    fn observe(&mut self, simulation: &mut Simulation) -> Result<(), RecordError> {
        let step = simulation.step_number();
        let observables = self.measure(simulation)?;
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
}
