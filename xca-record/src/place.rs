//! Where the cells of a model lie.

use xca_core::Model;
use xca_io::map::{Map, Placement};

/// The place of the cells where no map says one.
pub(crate) fn unplaced(model: &Model) -> Placement {
    let geometry = model.geometry();
    let [columns, rows, _] = geometry.extents();
    Placement { extents: [columns, rows], corner: [0.0; 2], side: geometry.side() }
}

/// The place of the cells on the map.
pub(crate) fn place_of(model: &Model, map: Option<&Map>) -> Placement {
    // The side of the model: that of the map may have other digits.
    let cells = unplaced(model);
    map.map_or(cells, |map| Placement { corner: map.placement().corner, ..cells })
}
