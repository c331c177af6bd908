//! A format of JSON texts: each state in a file, and a line for each in a log of the run.

use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::fs::{self, OpenOptions};
use std::io::Write as _;
use std::path::Path;
use xca::io::vtk::{NumberType, ReadArray};
use xca::record::Failure;
use xca::record::format::{Moment, OutputFile, RecordedState, ResumedRun, SavedState, Subject, Writer};

/// `frames/NAME_STEP.json` of each view of cells, and `states.log`.
#[derive(Debug, Default)]
pub(crate) struct Json {
    /// How long the log is, in bytes.
    logged: u64,
}

#[derive(Serialize, Deserialize)]
struct Layer {
    time: f64,
    cells: [usize; 3],
    substates: Vec<Substate>,
}

#[derive(Serialize, Deserialize)]
struct Substate {
    name: String,
    values: Vec<f64>,
}

fn log() -> OutputFile {
    OutputFile::named(Moment::Run, "states", "log")
}

impl Writer for Json {
    fn name(&self) -> &'static str {
        "json"
    }

    fn about(&self) -> &'static str {
        "all states of cells as JSON, and a log of them"
    }

    fn files(&self, subject: Subject<'_>) -> Vec<OutputFile> {
        let views = subject.views().filter(|view| !view.shows_items());
        views.map(|view| OutputFile::of_view(Moment::Each, view, "json")).chain([log()]).collect()
    }

    fn record(&mut self, state: RecordedState<'_>) -> Result<(), Failure> {
        for view in state.subject().views() {
            let Some(cells) = state.cells(view) else { continue };
            let mut substates = Vec::new();
            for substate in cells.substates() {
                let (name, values) = (substate.field().name.to_owned(), substate.values()?.component(0));
                substates.push(Substate { name, values });
            }
            let layer = Layer { time: state.time(), cells: cells.extents(), substates };
            let file = OutputFile::of_view(Moment::Each, view, "json");
            fs::write(state.path(&file), serde_json::to_string(&layer)?)?;
        }
        let line = format!("state after step {}\n", state.step());
        let mut log = OpenOptions::new().create(true).append(true).open(state.path(&log()))?;
        log.write_all(line.as_bytes())?;
        self.logged += line.len() as u64;
        Ok(())
    }

    fn memory(&self) -> Value {
        self.logged.into()
    }

    fn resume(&mut self, run: ResumedRun<'_>, memory: &Value) -> Result<(), Failure> {
        self.logged = memory.as_u64().ok_or("the length of the log is missing")?;
        Ok(OpenOptions::new().write(true).open(run.path(&log(), 0))?.set_len(self.logged)?)
    }

    fn read(&self, path: &Path) -> Option<Result<SavedState, Failure>> {
        (path.extension()? == "json").then(|| read(path))
    }
}

fn read(path: &Path) -> Result<SavedState, Failure> {
    let Layer { time, cells, substates } = serde_json::from_slice(&fs::read(path)?)?;
    let arrays = substates.into_iter().map(|Substate { name, values }| ReadArray {
        name,
        numbers: NumberType::F64,
        components: 1,
        component_names: vec![String::new()],
        states: Vec::new(),
        bytes: values.iter().flat_map(|value| value.to_ne_bytes()).collect(),
    });
    Ok(SavedState::of_cells(time, cells, arrays.collect()))
}
