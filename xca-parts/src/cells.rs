//! The cells of each part, out of a list.

use crate::cut::Cut;
use xca_core::Geometry;

/// The cells of one part, out of a list.
#[derive(Debug, Clone, Default)]
pub(crate) struct CellsOfPart {
    /// Their linear indices.
    pub(crate) cells: Vec<usize>,
    /// Their indices in the list.
    pub(crate) places: Vec<usize>,
}

impl CellsOfPart {
    /// The cells of each part.
    pub(crate) fn all(geometry: &Geometry, cut: &Cut, cells: &[usize]) -> Vec<Self> {
        let mut parts = vec![Self::default(); cut.count()];
        for (place, cell) in cells.iter().enumerate() {
            let [_, y, z] = geometry.indices(*cell);
            let part = &mut parts[cut.part_of([y, z])];
            part.cells.push(*cell);
            part.places.push(place);
        }
        parts
    }
}
