//! Spots and stripes: reaction and diffusion after Gray and Scott (Pearson, Science 261, 1993).

use xca_core::prelude::*;

/// Two substances.
#[derive(Substates, Clone, Copy, Debug)]
pub struct Mixture {
    /// Share of the substance that is fed.
    pub u: Real,
    /// Share of the substance that the other turns into.
    pub v: Real,
}

/// Rates, in a cell and a step.
#[derive(Parameters, Clone, Copy, Debug)]
pub struct Rates {
    /// Feed of `u`.
    #[parameter(range = 0.0..=1.0)]
    pub feed: Real,
    /// Removal of `v`.
    #[parameter(range = 0.0..=1.0)]
    pub kill: Real,
    /// Diffusion of `u`: stable up to 1/4.
    #[parameter(range = 0.0..=0.25)]
    pub diffusion_u: Real,
    /// Diffusion of `v`: stable up to 1/4.
    #[parameter(range = 0.0..=0.25)]
    pub diffusion_v: Real,
}

impl Default for Rates {
    /// Rates that make worms and spots.
    fn default() -> Self {
        Self { feed: 0.037, kill: 0.06, diffusion_u: 0.2, diffusion_v: 0.1 }
    }
}

/// Diffusion to the four neighbours, and `u + 2 v` becoming `3 v`.
#[elementary_process]
pub fn react(cell: &mut Cell<Mixture>, rates: &Rates) {
    let mut around_u = -4.0 * cell.u;
    let mut around_v = -4.0 * cell.v;
    for n in 1..cell.neighbour_count() {
        around_u += cell.neighbour(n).u;
        around_v += cell.neighbour(n).v;
    }
    let reaction = cell.u * cell.v * cell.v;
    cell.u += rates.diffusion_u * around_u - reaction + rates.feed * (1.0 - cell.u);
    cell.v += rates.diffusion_v * around_v + reaction - (rates.feed + rates.kill) * cell.v;
}

/// A square dish on a torus, which begins as the function says.
///
/// # Errors
/// Where a rate is out of its range.
pub fn model(
    size: usize,
    rates: Rates,
    begin: impl Fn(Site) -> Mixture + Send + Sync + 'static,
) -> Result<Model, ModelError> {
    Model::builder("reaction and diffusion")
        .extents([size, size, 1])
        .neighbourhood(Neighbourhood::von_neumann_2d(1))
        .boundary(Boundary::Toroidal)
        .substates::<Mixture>()
        .parameters(rates)
        .process(react)
        .fill(begin)
        .build()
}
