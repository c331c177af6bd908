//! A view of a model, and what it sees of a state.

use super::cells::{CellState, Ground};
use super::items::ItemState;
use super::seen::Seen;
use super::source::Source;
use crate::view::{AnyCellView, AnyItemView, AnyView};
use xca_core::{EngineFailure, Geometry, Model, Precision};
use xca_io::map::{Map, MapUnit};

/// How lengths of a space are measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum LengthScale {
    Of(MapUnit),
    Cells,
}

impl LengthScale {
    pub(super) fn unit(self) -> &'static str {
        match self {
            Self::Of(unit) => unit.sign(),
            Self::Cells => "cells",
        }
    }
}

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
        source: Source<'a>,
    ) -> Option<ItemState<'a>> {
        match &self.view {
            AnyView::Items(view) => Some(self.items_of(view, model, precision, source)),
            AnyView::Cells(_) => None,
        }
    }

    fn items_of<'a>(
        &'a self,
        view: &'a AnyItemView,
        model: &'a Model,
        precision: Precision,
        source: Source<'a>,
    ) -> ItemState<'a> {
        ItemState::new(view, self.group, model, (precision, source), self.ground().corner)
    }

    /// The substates of cells, if it is a view of these.
    pub(crate) fn cells<'a>(
        &'a self,
        model: &'a Model,
        precision: Precision,
        source: Source<'a>,
    ) -> Option<CellState<'a>> {
        match &self.view {
            AnyView::Cells(view) => Some(self.cells_of(view, model, precision, source)),
            AnyView::Items(_) => None,
        }
    }

    fn cells_of<'a>(
        &'a self,
        view: &'a AnyCellView,
        model: &'a Model,
        precision: Precision,
        source: Source<'a>,
    ) -> CellState<'a> {
        CellState::new(view, self.group, model, (precision, source), self.ground())
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

    /// How lengths of the space are measured.
    pub(super) fn scale(&self, geometry: &Geometry) -> LengthScale {
        match &self.map {
            Some(map) => LengthScale::Of(map.unit()),
            // A side that no one gave is no length.
            None if geometry.side() == 1.0 => LengthScale::Cells,
            None => LengthScale::Of(MapUnit::Metre),
        }
    }

    /// What it draws of a state.
    pub(crate) fn seen(
        &self,
        model: &Model,
        precision: Precision,
        source: Source<'_>,
    ) -> Result<Seen, EngineFailure> {
        match &self.view {
            AnyView::Items(view) => self.items_of(view, model, precision, source).seen(),
            AnyView::Cells(view) => self.cells_of(view, model, precision, source).seen(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SetUp;
    use std::sync::Arc;
    use xca_core::prelude::*;
    use xca_io::geotiff::GeoKeys;
    use xca_io::raster::Raster;

    #[derive(Substates, Clone, Copy, Debug, PartialEq)]
    struct Ground {
        height: Real,
    }

    #[elementary_process]
    fn rest(cell: &mut Cell<Ground>) {
        cell.height += 0.0;
    }

    /// The unit of lengths of a model whose cells have this side, on a map with these keys.
    fn unit(side: f64, keys: Option<Option<GeoKeys>>) -> &'static str {
        let builder = Model::builder("ground").extents([2, 2, 1]).cell_side(side);
        let mut set_up = SetUp::new(builder.substates::<Ground>().process(rest).build().unwrap(), 1);
        if let Some(keys) = keys {
            let raster = Raster::new([2, 2], side, vec![1.0; 4]).unwrap();
            set_up = set_up.map(&raster.with_coordinate_system(keys.map(Arc::new)));
        }
        let recorder = crate::record::Recorder::new(set_up).unwrap();
        recorder.shown[0].scale(recorder.model().geometry()).unit()
    }

    #[test]
    fn lengths_are_in_degrees_where_the_map_is() {
        assert_eq!(unit(0.01, Some(Some(GeoKeys::geographic(4326)))), "°");
        assert_eq!(unit(1.0, Some(Some(GeoKeys::geographic(4258)))), "°");
        assert_eq!(unit(30.0, Some(Some(GeoKeys::projected(32_633)))), "m");
        assert_eq!(unit(1.0, Some(None)), "m");
        assert_eq!(unit(30.0, None), "m");
        assert_eq!(unit(1.0, None), "cells");
    }
}
