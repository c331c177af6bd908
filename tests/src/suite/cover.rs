//! How far searches can reach, from the definition: cell by cell, without displacements.

use xca_core::prelude::*;

/// The least distance, in sides of a cell, between the boxes of two cells of which one does not have the
/// other in its neighbourhood; infinite where there are no such cells.
pub fn covered(neighbourhood: &Neighbourhood, extents: [usize; 3], boundaries: Faces<Boundary>) -> f64 {
    let cells = || {
        let [width, height, depth] = extents;
        let layer = move |z| (0..height).flat_map(move |y| (0..width).map(move |x| [x, y, z]));
        (0..depth).flat_map(layer)
    };
    let torus = Face::ALONG.map(|[low, _]| boundaries[low] == Boundary::Toroidal);
    let mut least = f64::INFINITY;
    for here in cells() {
        let seen: Vec<[i64; 3]> = neighbourhood
            .displacements(here)
            .iter()
            .map(|step| {
                std::array::from_fn(|axis| {
                    let there = here[axis] as i64 + i64::from(step[axis]);
                    if torus[axis] { there.rem_euclid(extents[axis] as i64) } else { there }
                })
            })
            .collect();
        for there in cells().filter(|there| !seen.contains(&there.map(|index| index as i64))) {
            let gaps = [0, 1, 2].map(|axis| {
                let apart = here[axis].abs_diff(there[axis]);
                let apart = if torus[axis] { apart.min(extents[axis] - apart) } else { apart };
                apart.saturating_sub(1) as f64
            });
            least = least.min(gaps.iter().map(|gap| gap * gap).sum::<f64>().sqrt());
        }
    }
    least
}
