//! The abelian sandpile (Bak, Tang and Wiesenfeld, Physical Review Letters 59, 1987): a heap topples until
//! it is stable.

use xca_core::prelude::*;

/// The pile.
#[derive(Substates, Clone, Copy, Debug)]
pub struct Pile {
    /// Grains in the cell.
    pub grains: u32,
    /// Grains that fell over the edge of the table from this cell.
    pub lost: u32,
}

/// Of each four grains one goes to each neighbour; beyond the edge it is lost.
#[elementary_process]
pub fn topple(cell: &mut Cell<Pile>) {
    let before = cell.grains;
    cell.grains = before % 4;
    for n in 1..cell.neighbour_count() {
        cell.grains += cell.neighbour(n).grains / 4;
        if !cell.exists(n) {
            cell.lost += before / 4;
        }
    }
}

/// A square table with so many grains in its middle. The run ends when the pile is stable.
///
/// # Errors
/// Where the table has no cells.
pub fn model(size: usize, grains: u32) -> Result<Model, ModelError> {
    let middle = [size / 2, size / 2, 0];
    Model::builder("sandpile")
        .extents([size, size, 1])
        .neighbourhood(Neighbourhood::von_neumann_2d(1))
        .substates::<Pile>()
        .process(topple)
        .fill(move |site| Pile { grains: if site.cell() == middle { grains } else { 0 }, lost: 0 })
        .stop_when(Schedule::Every(10), |state| {
            let is_stable = state.maximum(Pile::GRAINS)?.is_none_or(|highest| highest < 4);
            Ok(is_stable.then(|| "the pile is stable".to_owned()))
        })
        .build()
}
