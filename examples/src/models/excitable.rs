//! Waves in an excitable medium (Greenberg and Hastings, SIAM Journal on Applied Mathematics 34, 1978).

use xca_core::prelude::*;

/// What a cell of the medium does.
#[derive(States, Clone, Copy, Debug, PartialEq)]
pub enum Tissue {
    /// Waits for an excited neighbour.
    Resting,
    /// Excites its resting neighbours.
    Excited,
    /// Recovers, and cannot be excited.
    Refractory,
}

/// The medium.
#[derive(Substates, Clone, Copy, Debug)]
pub struct Medium {
    /// What the cell does.
    pub tissue: Tissue,
}

/// A resting cell becomes excited beside an excited one, then refractory, then it rests again.
#[elementary_process]
pub fn react(cell: &mut Cell<Medium>) {
    let excited = (1..cell.neighbour_count()).any(|n| cell.neighbour(n).tissue == Tissue::Excited);
    cell.tissue = match cell.tissue {
        Tissue::Resting if excited => Tissue::Excited,
        Tissue::Excited => Tissue::Refractory,
        Tissue::Resting | Tissue::Refractory => Tissue::Resting,
    };
}

/// A square sheet on a torus, whose cells begin as the function says.
///
/// # Errors
/// Where the sheet has fewer than 3 cells a side.
pub fn model(size: usize, begin: fn(Site) -> Tissue) -> Result<Model, ModelError> {
    Model::builder("excitable medium")
        .extents([size, size, 1])
        .neighbourhood(Neighbourhood::von_neumann_2d(1))
        .boundary(Boundary::Toroidal)
        .substates::<Medium>()
        .process(react)
        .fill(move |site| Medium { tissue: begin(site) })
        .build()
}
