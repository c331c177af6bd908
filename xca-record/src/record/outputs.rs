//! The memory that outputs of a state take.

use super::Recorder;
use crate::set_up::SetUp;
use crate::view::AnyView;
use xca_core::{Engine, Model, Precision, Simulation};

impl SetUp {
    /// An estimate of the bytes that a run takes on an engine, with its outputs and without items.
    #[doc(hidden)]
    pub fn least_memory(&self, engine: &dyn Engine, precision: Precision) -> u128 {
        let cells = held(&self.model, self.views.iter());
        engine.least_memory(&self.model, precision) + self.model.output_memory(precision, cells, |_| 0)
    }
}

impl Recorder {
    /// The same, once the views are complete.
    pub(crate) fn least_memory(&self, engine: &dyn Engine, precision: Precision) -> u128 {
        engine.least_memory(self.model(), precision) + self.output_memory(precision, |_| 0)
    }

    /// An estimate of the bytes that outputs of the present state take, beside the state.
    pub(super) fn memory_of_outputs(&self, simulation: &Simulation) -> u128 {
        let populations = simulation.outline().populations;
        let items = |group: usize| populations[group].map_or(0, |counts| counts.items);
        self.output_memory(simulation.options().precision, items)
    }

    fn output_memory(&self, precision: Precision, items: impl Fn(usize) -> usize) -> u128 {
        let views = self.shown.iter().map(|shown| &shown.view);
        self.model().output_memory(precision, held(self.model(), views), items)
    }
}

/// The number of cells whose values outputs hold at once: those of pictures, and of rasters of one layer.
fn held<'a>(model: &Model, views: impl Iterator<Item = &'a AnyView>) -> usize {
    let geometry = model.geometry();
    let [columns, rows, _] = geometry.extents();
    let drawn = views.map(|view| match view {
        AnyView::Items(_) => 0,
        AnyView::Cells(view) if view.block => geometry.cells(),
        AnyView::Cells(view) => geometry.cells() / geometry.extents()[view.axis],
    });
    // A model without views gets one of the middle layer.
    drawn.chain([columns * rows]).max().unwrap_or_default()
}
