//! Pictures of the first and the final state.

use super::{Moment, OutputFile, RecordedState, ResumedRun, Subject, View, Writer};
use crate::failure::Failure;
use crate::record::Frame;
use serde_json::Value;
use xca_checkpoint::Exact;

/// `initial.png` and `final.png` of the first view, `initial_NAME.png` and `final_NAME.png` of the others.
#[derive(Debug, Default)]
pub(super) struct Pictures {
    /// For each view of cells, the scale of the first picture. Items have a scale of their own in each
    /// picture.
    scales: Vec<Option<[f64; 2]>>,
}

fn file(moment: Moment, view: View<'_>) -> OutputFile {
    if view.number() == 0 {
        OutputFile::unnamed(moment, "png")
    } else {
        OutputFile::of_view(moment, view, "png")
    }
}

impl Pictures {
    fn draw(&mut self, moment: Moment, state: RecordedState<'_>) -> Result<(), Failure> {
        let subject = state.subject();
        let model = subject.model();
        self.scales.resize(subject.shown.len(), None);
        for view in subject.views() {
            let seen = state.seen(view)?;
            let scale = &mut self.scales[view.number()];
            let caption = view.shown.whole_caption(subject, &seen, state.step());
            let frame = Frame { title: subject.title(), caption: &caption, range: *scale, size: None };
            if let Some(picture) = view.shown.paint(model, &seen, frame)? {
                picture.write(&state.path(&file(moment, view)))?;
            }
            if !view.shows_items() {
                *scale = scale.or_else(|| seen.range());
            }
        }
        Ok(())
    }
}

impl Writer for Pictures {
    fn name(&self) -> &'static str {
        "png"
    }

    fn about(&self) -> &'static str {
        "first and final state, drawn: initial.png, final.png"
    }

    fn files(&self, subject: Subject<'_>) -> Vec<OutputFile> {
        subject
            .views()
            .flat_map(|view| [Moment::First, Moment::Last].map(|moment| file(moment, view)))
            .collect()
    }

    fn begin(&mut self, state: RecordedState<'_>) -> Result<(), Failure> {
        self.draw(Moment::First, state)
    }

    fn finish(&mut self, state: RecordedState<'_>) -> Result<(), Failure> {
        self.draw(Moment::Last, state)
    }

    fn memory(&self) -> Value {
        let exact = |scale: &Option<[f64; 2]>| serde_json::to_value(scale.map(|scale| scale.map(Exact)));
        self.scales.iter().map(|scale| exact(scale).unwrap_or_default()).collect()
    }

    fn resume(&mut self, _run: ResumedRun<'_>, memory: &Value) -> Result<(), Failure> {
        let scales: Vec<Option<[Exact; 2]>> = serde_json::from_value(memory.clone())?;
        let scales = scales.into_iter();
        self.scales = scales.map(|scale| scale.map(|scale| scale.map(|number| number.0))).collect();
        Ok(())
    }
}
