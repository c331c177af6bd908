//! A view of a model, and what it sees of a state.

use super::cells::{CellState, Ground};
use super::items::ItemState;
use super::seen::Seen;
use crate::view::AnyView;
use xca_core::{GroupSnapshot, Model, Precision, Snapshot};
use xca_io::map::Map;

/// A view of a model.
#[derive(Debug)]
pub(crate) struct Shown {
    pub(crate) group: usize,
    pub(crate) view: AnyView,
    /// Where cells lie on a map.
    map: Option<Map>,
}

impl Shown {
    /// A view of the group with this number.
    pub(crate) fn new(group: usize, view: AnyView, map: Option<Map>) -> Self {
        Self { group, view, map }
    }

    pub(crate) fn is_of_items(&self) -> bool {
        matches!(self.view, AnyView::Items(_))
    }

    /// The items, if it is a view of items.
    pub(crate) fn items<'a>(
        &'a self,
        model: &'a Model,
        precision: Precision,
        snapshot: &'a Snapshot,
    ) -> Option<ItemState<'a>> {
        let (group, geometry) = (&model.groups()[self.group], model.geometry());
        match (&self.view, &snapshot.groups[self.group]) {
            (AnyView::Items(view), GroupSnapshot::Population(population, _)) => {
                Some(ItemState::new(view, group, geometry, precision, population, self.ground().corner))
            }
            _ => None,
        }
    }

    /// The substates of cells, if it is a view of these.
    pub(crate) fn cells<'a>(
        &'a self,
        model: &'a Model,
        precision: Precision,
        snapshot: &'a Snapshot,
    ) -> Option<CellState<'a>> {
        let (group, geometry) = (&model.groups()[self.group], model.geometry());
        match (&self.view, &snapshot.groups[self.group]) {
            (AnyView::Cells(view), GroupSnapshot::Cells(fields)) => {
                Some(CellState::new(view, group, geometry, precision, fields, self.ground()))
            }
            _ => None,
        }
    }

    /// A view of the same group and the same place.
    pub(crate) fn with_view(&self, view: AnyView) -> Self {
        Self::new(self.group, view, self.map.clone())
    }

    /// Where its cells lie on the map.
    pub(super) fn ground(&self) -> Ground<'_> {
        let corner = self.map.as_ref().map(|map| map.placement().corner).unwrap_or_default();
        Ground { corner, missing: self.map.as_ref().and_then(Map::missing) }
    }

    /// The lower corner of the space, if it lies on a map.
    pub(super) fn corner_on_map(&self) -> Option<[f64; 2]> {
        self.map.as_ref().map(|map| map.placement().corner)
    }

    /// What it draws of a state.
    pub(crate) fn seen(&self, model: &Model, precision: Precision, snapshot: &Snapshot) -> Option<Seen> {
        let items = self.items(model, precision, snapshot).map(|items| items.seen());
        items.or_else(|| self.cells(model, precision, snapshot).map(|cells| cells.seen()))
    }
}
