//! The distance between passes that follow each other over the rows.

use super::Layout;
use xca_core::{Boundary, Face};
use xca_wavefront::Lag;

impl Layout {
    /// The distance that a pass must keep from the previous pass. `None` if the halo is wider than the space,
    /// or other parts lie beside layers and not only before and after them.
    pub(crate) fn lag(&self) -> Option<Lag> {
        let [_, height, depth] = self.extents;
        let [_, along, up] = self.reach;
        let borders = |axis: usize| Face::ALONG[axis].map(|face| self.borders[face]);
        let has_border = |axis: usize| borders(axis) != [false; 2];
        let is_ring =
            |axis: usize| self.boundaries[Face::ALONG[axis][0]] == Boundary::Toroidal && !has_border(axis);
        let of_layers = if depth == 1 { 1 } else { 2 };
        if along > height || up > depth || has_border(3 - of_layers) {
            return None;
        }
        if depth == 1 {
            let (is_ring, borders) = (along > 0 && is_ring(1), borders(1));
            return Some(Lag { layers: along, is_ring, borders, ..Lag::NONE });
        }
        if up == 0 && has_border(2) {
            return None;
        }
        if up == 0 {
            // On a torus along y, the first rows of a layer see its last rows.
            let layers = if along > 0 && is_ring(1) { height - 1 } else { along };
            return Some(Lag { layers, ..Lag::NONE });
        }
        let along = (along == 0 || !is_ring(1)).then_some(along);
        Some(Lag { layer: height, layers: up, is_ring: is_ring(2), along, borders: borders(2) })
    }
}
