//! Views of a model, drawn again and again on the same scales.

use super::look::{Look, LookError};
use super::painting::Frame;
use super::panel::Panel;
use super::saved::SavedError;
use super::saved_run::SavedRun;
use super::seen::{Seen, wider};
use super::source::Source;
use super::{RecordError, Recorder};
use xca_core::{EngineFailure, Model, Precision, Simulation, Snapshot};
use xca_picture::{PanelPicture, Picture};

/// What is drawn of every state: one panel, or several side by side.
#[derive(Debug)]
pub struct Drawing<'a> {
    recorder: &'a Recorder,
    panels: Vec<Panel>,
    /// Width and height in pixels.
    size: Option<[usize; 2]>,
}

/// The ends of the scale of each panel, where they are known.
#[derive(Debug, Clone, PartialEq)]
pub struct Scales(Vec<Option<[f64; 2]>>);

impl Scales {
    pub fn are_known(&self) -> bool {
        self.0.iter().all(Option::is_some)
    }
}

/// Width and height of pictures of items and blocks, in pixels.
const SIZE: [usize; 2] = [800, 600];
/// Of a panel beside others, unless a size is given.
const PANEL: [usize; 2] = [600, 520];
/// Of a panel beside others, at least.
const LEAST_PANEL: [usize; 2] = [320, 280];

impl Recorder {
    /// A drawing with a panel for each of these looks, in a picture of this size.
    pub fn drawing(&self, looks: &[Look], size: Option<[usize; 2]>) -> Result<Drawing<'_>, LookError> {
        let panels: Vec<Panel> = looks.iter().map(|look| self.panel(look)).collect::<Result<_, _>>()?;
        let is_layered = |look: &Look| look.axis.is_some() || look.layer.is_some();
        if looks.iter().any(is_layered) && !panels.iter().any(Panel::is_slice) {
            return Err(LookError::NotLayered);
        }
        if let (Some([width, height]), 2..) = (size, panels.len()) {
            let least_width = LEAST_PANEL[0] * panels.len();
            let least_height = LEAST_PANEL[1] + PanelPicture::ABOVE;
            if width < least_width || height < least_height {
                let panels = panels.len();
                return Err(LookError::Pixels { width, height, panels, least_width, least_height });
            }
        }
        Ok(Drawing { recorder: self, panels, size })
    }
}

impl Drawing<'_> {
    pub fn model(&self) -> &Model {
        self.recorder.model()
    }

    /// What is drawn of a state: for each panel what it shows.
    pub fn seen(&self, simulation: &Simulation) -> Result<Vec<Seen>, EngineFailure> {
        self.seen_of(simulation.options().precision, Source::Simulation(simulation))
    }

    /// As [`Drawing::seen`], of a snapshot.
    pub fn seen_at(&self, precision: Precision, snapshot: &Snapshot) -> Result<Vec<Seen>, EngineFailure> {
        self.seen_of(precision, Source::Snapshot(snapshot))
    }

    fn seen_of(&self, precision: Precision, source: Source<'_>) -> Result<Vec<Seen>, EngineFailure> {
        self.panels.iter().map(|panel| panel.shown.seen(self.model(), precision, source)).collect()
    }

    /// The name of a view that is drawn and that no format of the run gives back, if there is one.
    pub fn unreadable(&self) -> Option<&str> {
        let mut views = self.panels.iter().map(|panel| &panel.shown);
        views.find(|shown| !self.recorder.has_reader(shown)).map(|shown| shown.view.name())
    }

    /// The steps after which a run has saved all that is drawn.
    pub fn saved_steps(&self, run: &SavedRun) -> Vec<u64> {
        let mut of_panels = self.panels.iter().map(|panel| self.recorder.saved_steps(&panel.shown, run));
        let mut steps = of_panels.next().unwrap_or_default();
        for others in of_panels {
            steps.retain(|step| others.contains(step));
        }
        steps
    }

    /// As [`Drawing::seen`], of a saved state.
    pub fn seen_in(&self, run: &SavedRun, step: u64) -> Result<Vec<Seen>, SavedError> {
        self.panels.iter().map(|panel| self.recorder.seen_in(&panel.shown, run, step)).collect()
    }

    /// The scales, as far as they do not depend on the states that are drawn.
    pub fn fixed_scales(&self) -> Scales {
        Scales(self.panels.iter().map(|panel| panel.fixed_range(self.model())).collect())
    }

    /// Widens the scales that are not fixed to what a state has.
    pub fn widen(&self, scales: &mut Scales, seen: &[Seen]) {
        for ((panel, range), seen) in self.panels.iter().zip(&mut scales.0).zip(seen) {
            if panel.fixed_range(self.model()).is_none() {
                let now = seen.range();
                *range = range.map_or(now, |range| Some(wider(range, now)));
            }
        }
    }

    /// The state after a step, on these scales.
    pub fn picture(&self, step: u64, seen: &[Seen], scales: &Scales) -> Result<Option<Picture>, RecordError> {
        let (title, recorder) = (&self.recorder.set_up.title, self.recorder);
        if let ([panel], [seen]) = (self.panels.as_slice(), seen) {
            let caption = panel.shown.whole_caption(recorder.subject(), seen, step);
            let size = if panel.is_slice() { self.size } else { Some(self.size.unwrap_or(SIZE)) };
            let frame = Frame { title, caption: &caption, range: scales.0[0], size };
            return Ok(panel.shown.paint(self.model(), seen, frame)?);
        }
        let count = self.panels.len().max(1);
        let size = self.size.map_or(PANEL, |[width, height]| [width / count, height - PanelPicture::ABOVE]);
        let mut panels = Vec::new();
        for ((panel, seen), range) in self.panels.iter().zip(seen).zip(&scales.0) {
            let caption = panel.shown.details(self.model(), seen, true).unwrap_or_default();
            let frame = Frame { title: "", caption: &caption, range: *range, size: Some(size) };
            panels.extend(panel.shown.paint(self.model(), seen, frame)?);
        }
        let caption = recorder.subject().caption(step);
        Ok(Some(PanelPicture { panels: &panels, title, caption: &caption, size: self.size }.render()?))
    }
}
