//! Models of one row, as pictures of space and time.

use super::{Moment, OutputFile, RecordedState, ResumedRun, Subject, View, Writer};
use crate::failure::Failure;
use crate::record::{Frame, Seen};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;
use xca_checkpoint::Exact;
use xca_core::Model;

/// `final_spacetime.png` of the first view of cells, `final_spacetime_NAME.png` of the others: a row of the
/// picture for each recorded state, the initial one on top.
#[derive(Debug, Default)]
pub(super) struct SpaceTime {
    /// By the numbers of the views.
    histories: BTreeMap<usize, History>,
    /// The first and the last recorded step.
    steps: Option<[u64; 2]>,
}

/// What a view has seen.
#[derive(Debug, Default, Serialize, Deserialize)]
struct History {
    is_float: bool,
    rows: Vec<Vec<Exact>>,
}

/// What a checkpoint keeps.
#[derive(Serialize, Deserialize)]
struct Memory<Histories> {
    histories: Histories,
    steps: Option<[u64; 2]>,
}

/// A model with more than one row.
#[derive(Debug, thiserror::Error)]
#[error("the format spacetime is for models of one row, and `{model}` has {rows} rows in {layers} layers")]
struct Rows {
    model: String,
    rows: usize,
    layers: usize,
}

/// Whether a model is a row of cells.
pub(crate) fn is_row(model: &Model) -> bool {
    matches!(model.geometry().extents(), [columns, 1, 1] if columns > 1)
}

fn file(subject: Subject<'_>, view: View<'_>) -> OutputFile {
    let first = subject.views().find(|view| !view.shows_items()).map(|first| first.number());
    let name = if first == Some(view.number()) {
        "spacetime".to_owned()
    } else {
        format!("spacetime_{}", view.stem())
    };
    OutputFile::named(Moment::Last, &name, "png")
}

impl Writer for SpaceTime {
    fn name(&self) -> &'static str {
        "spacetime"
    }

    fn about(&self) -> &'static str {
        "one row of cells in space and time: final_spacetime.png"
    }

    fn check(&self, subject: Subject<'_>) -> Result<(), Failure> {
        let model = subject.model();
        let [_, rows, layers] = model.geometry().extents();
        let error = || Rows { model: model.name().to_owned(), rows, layers };
        if is_row(model) { Ok(()) } else { Err(error().into()) }
    }

    fn files(&self, subject: Subject<'_>) -> Vec<OutputFile> {
        let views = subject.views().filter(|view| !view.shows_items());
        views.map(|view| file(subject, view)).collect()
    }

    fn record(&mut self, state: RecordedState<'_>) -> Result<(), Failure> {
        for view in state.subject().views().filter(|view| !view.shows_items()) {
            let Seen::Cells { is_float, values, .. } = state.seen(view)? else { continue };
            let history = self.histories.entry(view.number()).or_default();
            history.is_float = is_float;
            history.rows.push(values.into_iter().map(Exact).collect());
        }
        let [first, _] = self.steps.unwrap_or([state.step(); 2]);
        self.steps = Some([first, state.step()]);
        Ok(())
    }

    fn finish(&mut self, state: RecordedState<'_>) -> Result<(), Failure> {
        let subject = state.subject();
        let [first, last] = self.steps.unwrap_or_default();
        let caption = format!("steps {first} to {last}, downwards");
        for view in subject.views() {
            let Some(history) = self.histories.get(&view.number()) else { continue };
            // The lowest row of a picture comes first.
            let values: Vec<f64> = history.rows.iter().rev().flatten().map(|value| value.0).collect();
            let seen = Seen::Cells { is_float: history.is_float, values, heights: None, hidden: None };
            let frame = Frame { title: subject.title(), caption: &caption, range: None, size: None };
            if let Some(picture) = view.shown.paint_rows(subject.model(), &seen, history.rows.len(), frame)? {
                picture.write(&state.path(&file(subject, view)))?;
            }
        }
        Ok(())
    }

    fn memory(&self) -> Value {
        serde_json::to_value(Memory { histories: &self.histories, steps: self.steps }).unwrap_or_default()
    }

    fn resume(&mut self, _run: ResumedRun<'_>, memory: &Value) -> Result<(), Failure> {
        let Memory { histories, steps } = Memory::<BTreeMap<usize, History>>::deserialize(memory)?;
        (self.histories, self.steps) = (histories, steps);
        Ok(())
    }
}
