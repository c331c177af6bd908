//! One view of a model, drawn in one way.

use super::shown::Shown;
use crate::view::AnyView;
use xca_core::Model;

/// One view, drawn in one way.
#[derive(Debug)]
pub struct Panel {
    pub(super) shown: Shown,
    /// The scale that was asked for.
    pub(super) range: Option<[f64; 2]>,
}

impl Panel {
    /// The scale, if it does not depend on the states that are drawn.
    pub(super) fn fixed_range(&self, model: &Model) -> Option<[f64; 2]> {
        let schema = model.groups()[self.shown.group].schema();
        let (range, categories) = match &self.shown.view {
            AnyView::Items(view) => (self.range, view.categories(schema)),
            AnyView::Cells(view) => (view.range, view.categories(schema)),
        };
        // Kinds and states have no scale.
        if categories.is_empty() { range } else { Some([0.0; 2]) }
    }

    pub(super) fn is_slice(&self) -> bool {
        matches!(&self.shown.view, AnyView::Cells(view) if !view.block)
    }
}
