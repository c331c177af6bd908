//! The memory that outputs of a state take.

use super::Recorder;
use crate::set_up::SetUp;
use crate::view::AnyView;
use xca_core::{Engine, EngineFailure, Model, Precision, Simulation};

/// What a picture holds of an item, in bytes: its position and colour.
const DRAWN_ITEM: u128 = 32;

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
    pub(super) fn memory_of_outputs(&self, simulation: &Simulation) -> Result<u128, EngineFailure> {
        let populations = simulation.outline().populations.into_iter().enumerate();
        let mut items = vec![0; self.model().groups().len()];
        let mut drawn = 0;
        for (group, counts) in populations.filter_map(|(group, counts)| Some((group, counts?))) {
            items[group] = simulation.items_at_once(group)?;
            drawn += counts.items as u128 * DRAWN_ITEM;
        }
        Ok(drawn + self.output_memory(simulation.options().precision, |group| items[group]))
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
