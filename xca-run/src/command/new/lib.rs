//! An excitable medium: fronts that run through it, and spirals where they break.
//!
//! A cell rests until enough of its neighbours are excited, is excited for one step, and then recovers for some steps in which nothing
//! excites it (J. M. Greenberg and S. P. Hastings, "Spatial patterns for discrete models of diffusion in excitable media", 1978).

use xca_run::prelude::*;

/// What a cell is.
#[derive(Substates, Clone, Debug)]
pub struct Medium {
    /// 0 at rest, 1 excited, and counted on while it recovers.
    pub phase: u32,
}

/// What `--set` can change.
#[derive(Parameters, Clone, Copy, Debug)]
pub struct Excitation {
    /// How many excited neighbours excite a cell.
    pub threshold: u32,
    /// How many steps a cell is not at rest.
    pub duration: u32,
}

/// What a cell does in a step. Neighbours are seen as they were before it; number 0 is the cell itself.
#[elementary_process]
fn excite(cell: &mut Cell<Medium>, p: &Excitation) {
    let mut excited: u32 = 0;
    for n in 1..cell.neighbour_count() {
        if cell.neighbour(n).phase == 1 {
            excited += 1;
        }
    }
    if cell.phase > 0 {
        cell.phase = (cell.phase + 1) % (p.duration + 1);
    } else if excited >= p.threshold {
        cell.phase = 1;
    }
}

/// The whole model: space, neighbourhood, substates, parameters, processes, initial state.
pub fn model() -> Result<Model, ModelError> {
    Model::builder("new-model")
        .extents([160, 160, 1])
        .neighbourhood(Neighbourhood::moore_2d(1))
        .boundary(Boundary::Toroidal)
        .substates::<Medium>()
        .parameters(Excitation { threshold: 1, duration: 7 })
        .process(excite)
        .fill(|site| Medium { phase: (site.random(0) * 9.0) as u32 % 8 })
        .build()
}
