//! The Ising model on a square lattice: Metropolis' algorithm on the two colours of a checkerboard in turn.

use xca_core::prelude::*;

/// The lattice.
#[derive(Substates, Clone, Copy, Debug)]
pub struct Lattice {
    /// -1 or 1.
    pub spin: i32,
}

/// What the spins exchange energy with.
#[derive(Parameters, Clone, Copy, Debug)]
pub struct Bath {
    /// In units of J / k.
    #[parameter(positive)]
    pub temperature: Real,
}

/// Gives the spins of one colour the chance to turn.
#[elementary_process]
pub fn turn<const COLOUR: i32>(cell: &mut Cell<Lattice>, bath: &Bath) {
    let place = cell.index();
    if (place.x + place.y) % 2 == COLOUR {
        let mut around = 0;
        for n in 1..cell.neighbour_count() {
            around += cell.neighbour(n).spin;
        }
        let cost = (2 * cell.spin * around) as Real;
        if cost <= 0.0 || cell.random(0) < (-cost / bath.temperature).exp() {
            cell.spin = -cell.spin;
        }
    }
}

/// A square lattice on a torus, of which this share of the spins is up at first.
///
/// # Errors
/// Where the lattice is too small, or the temperature is not above 0.
pub fn model(size: usize, temperature: f64, up: f64) -> Result<Model, ModelError> {
    Model::builder("ising")
        .extents([size, size, 1])
        .neighbourhood(Neighbourhood::von_neumann_2d(1))
        .boundary(Boundary::Toroidal)
        .substates::<Lattice>()
        .parameters(Bath { temperature })
        .process((turn::<0>, turn::<1>))
        .fill(move |site| Lattice { spin: if site.random(0) < up { 1 } else { -1 } })
        .build()
}

/// Onsager's magnetisation of an infinite lattice (Yang, Physical Review 85, 1952).
pub fn exact_magnetisation(temperature: f64) -> f64 {
    (1.0 - (2.0 / temperature).sinh().powi(-4)).max(0.0).powf(0.125)
}
