//! Predators and prey that wander over a torus, breed, hunt and starve.
//!
//! The scheme is that of McKane and Newman (Physical Review Letters 94, 2005): individuals and free places
//! are fixed in number together, and react in pairs. Here each kind has free places of its own, and a patch
//! is a cell (as in Lugo and McKane, Physical Review E 78, 2008). A free place becomes prey as often as it
//! meets prey. Prey is eaten as often as it meets a predator. A free place becomes a predator as often as
//! it meets a predator with prey. A predator dies at a constant rate. In a well-mixed meadow the shares `x`
//! of prey and `y` of predators follow `x' = breeding x (1 - x) - hunting x y`, `y' = growth x y (1 - y) -
//! death y` a step.

use xca_core::prelude::*;

/// Who lives in a cell.
#[derive(States, Clone, Copy, Debug, PartialEq)]
pub enum Inhabitants {
    /// Neither prey nor predators.
    Nobody,
    /// Prey alone.
    Prey,
    /// Predators alone.
    Predators,
    /// Prey and predators.
    Both,
}

/// A meadow.
#[derive(Substates, Clone, Copy, Debug)]
pub struct Meadow {
    /// Prey that lives in the cell.
    pub prey: u32,
    /// Predators that live in the cell.
    pub predators: u32,
    /// Who lives in the cell.
    pub inhabitants: Inhabitants,
}

/// A place for prey.
#[derive(Substates, Clone, Copy, Debug, PartialEq)]
pub struct Prey {
    /// Where it is.
    #[position]
    pub position: Vector3<Real>,
    /// Whether it is taken.
    pub alive: bool,
}

/// A place for a predator.
#[derive(Substates, Clone, Copy, Debug, PartialEq)]
pub struct Predator {
    /// Where it is.
    #[position]
    pub position: Vector3<Real>,
    /// Whether it is taken.
    pub alive: bool,
}

/// Rates of a step, and how far an individual goes.
#[derive(Parameters, Clone, Copy, Debug)]
pub struct Ecology {
    /// Births of prey.
    #[parameter(range = 0.0..=1.0)]
    pub breeding: Real,
    /// Deaths of prey by predators.
    #[parameter(range = 0.0..=1.0)]
    pub hunting: Real,
    /// Births of predators.
    #[parameter(range = 0.0..=1.0)]
    pub growth: Real,
    /// Deaths of predators.
    #[parameter(range = 0.0..=1.0)]
    pub death: Real,
    /// The longest way in a step along x and along y, in cells.
    #[parameter(range = 0.0..=1.0)]
    pub stride: Real,
    /// Places of each kind in a cell, on average.
    #[parameter(range = 1..=10_000)]
    pub places: u32,
}

impl Default for Ecology {
    /// Waves of prey that predators follow.
    fn default() -> Self {
        Self { breeding: 0.2, hunting: 0.8, growth: 0.8, death: 0.08, stride: 0.8, places: 4 }
    }
}

/// Counts the prey of the cell.
#[elementary_process]
pub fn count_prey(meadow: &mut Cell<Meadow>, prey: &Slots<Prey>) {
    meadow.prey = 0;
    for one in prey {
        meadow.prey += one.alive as u32;
    }
}

/// Counts the predators of the cell, and says who lives there.
#[elementary_process]
pub fn count_predators(meadow: &mut Cell<Meadow>, predators: &Slots<Predator>) {
    meadow.predators = 0;
    for one in predators {
        meadow.predators += one.alive as u32;
    }
    meadow.inhabitants = match (meadow.prey > 0) as u32 + 2 * (meadow.predators > 0) as u32 {
        0 => Inhabitants::Nobody,
        1 => Inhabitants::Prey,
        2 => Inhabitants::Predators,
        _ => Inhabitants::Both,
    };
}

/// Prey is eaten; a free place is taken by young.
#[elementary_process]
pub fn live_as_prey(me: &mut Slot<Prey>, meadow: &Cell<Meadow>, p: &Ecology) {
    let places = p.places as Real;
    let eaten = p.hunting * meadow.predators as Real / places;
    let born = p.breeding * meadow.prey as Real / places;
    me.alive = if me.alive { me.random(0) >= eaten } else { me.random(0) < born };
}

/// Predators die; a free place is taken by young of those that eat.
#[elementary_process]
pub fn live_as_predator(me: &mut Slot<Predator>, meadow: &Cell<Meadow>, p: &Ecology) {
    let places = p.places as Real;
    let born = p.growth * (meadow.prey as Real / places) * (meadow.predators as Real / places);
    me.alive = if me.alive { me.random(0) >= p.death } else { me.random(0) < born };
}

/// A step at random along x and y, from two numbers between 0 and 1.
#[helper]
fn step(x: Real, y: Real, p: &Ecology) -> Vector3<Real> {
    Vector3::new(2.0 * x - 1.0, 2.0 * y - 1.0, 0.0) * p.stride
}

/// Prey and free places wander.
#[elementary_process]
pub fn wander_as_prey(me: &mut Slot<Prey>, p: &Ecology, space: &Space) {
    me.position = space.wrapped(me.position + step(me.random(0), me.random(1), p));
}

/// Predators and free places wander.
#[elementary_process]
pub fn wander_as_predator(me: &mut Slot<Predator>, p: &Ecology, space: &Space) {
    me.position = space.wrapped(me.position + step(me.random(0), me.random(1), p));
}

/// Prey belongs to the cell where it is.
#[migration]
pub fn prey_migrates(me: &Slot<Prey>, space: &Space) -> Destination {
    space.cell_containing(me.position)
}

/// A predator belongs to the cell where it is.
#[migration]
pub fn predator_migrates(me: &Slot<Predator>, space: &Space) -> Destination {
    space.cell_containing(me.position)
}

/// The place with this number among those of a cell, and whether it is taken at first.
fn place(site: &Site, number: usize, share: f64) -> (Vector3<f64>, bool) {
    let offset = Vector3::new(site.random(3 * number) - 0.5, site.random(3 * number + 1) - 0.5, 0.0);
    (site.centre() + offset, site.random(3 * number + 2) < share)
}

/// A square meadow on a torus. The function gives the shares of places that prey and predators take at first.
///
/// # Errors
/// Where the meadow has fewer than 3 cells a side, or a parameter is out of its range.
pub fn model(
    size: usize,
    ecology: Ecology,
    share_alive: impl Fn(&Site) -> Shares + Clone + Send + Sync + 'static,
) -> Result<Model, ModelError> {
    // So far above the mean no cell comes by chance.
    let places = ecology.places as usize;
    let most = 8 * places + 32;
    let of_prey = share_alive.clone();
    let prey = move |number: usize, site: &Site| {
        let (position, alive) = place(site, number, of_prey(site).prey);
        Prey { position, alive }
    };
    let predator = move |number: usize, site: &Site| {
        let (position, alive) = place(site, number, share_alive(site).predators);
        Predator { position, alive }
    };
    Model::builder("predators")
        .extents([size, size, 1])
        .neighbourhood(Neighbourhood::moore_2d(1))
        .boundaries([Boundary::Toroidal, Boundary::Toroidal, Boundary::Flat])
        .substates::<Meadow>()
        .population::<Prey>(most)
        .population::<Predator>(most)
        .parameters(ecology)
        .process((count_prey, count_predators, live_as_prey, live_as_predator))
        .process((wander_as_prey, wander_as_predator, prey_migrates, predator_migrates))
        .populate(move |site| (0..places).map(|number| prey(number, &site)).collect::<Vec<_>>())
        .populate(move |site| (0..places).map(|number| predator(number, &site)).collect::<Vec<_>>())
        .build()
}

/// Shares of the places that are taken.
#[derive(Debug, Clone, Copy)]
pub struct Shares {
    /// Of those for prey.
    pub prey: f64,
    /// Of those for predators.
    pub predators: f64,
}
