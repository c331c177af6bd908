//! A model in a crate that depends on `xca` alone, and calls it `cellular`: what the macros write has to name
//! it so.

use cellular::prelude::*;

/// What a cell of the forest holds.
#[derive(States, Clone, Copy, Debug, PartialEq)]
pub enum Ground {
    /// Nothing that burns.
    Bare,
    /// A tree.
    Tree,
    /// A tree on fire.
    Fire,
}

/// A forest.
#[derive(Substates, Clone, Copy, Debug)]
pub struct Forest {
    /// What stands in the cell.
    pub ground: Ground,
}

/// An ember on its way.
#[derive(Substates, Clone, Copy, Debug)]
pub struct Ember {
    /// Where it is.
    #[position]
    pub position: Vector3<Real>,
}

/// How embers fly.
#[derive(Parameters, Clone, Debug)]
pub struct Wind {
    /// Metres a step.
    pub speed: Real,
}

#[helper]
fn is_fire(ground: Ground) -> bool {
    ground == Ground::Fire
}

#[elementary_process]
fn burn(cell: &mut Cell<Forest>, embers: &Slots<Ember>) {
    let mut lit = false;
    for ember in embers {
        lit = lit || ember.position.x >= 0.0;
    }
    for n in 1..cell.neighbour_count() {
        lit = lit || is_fire(cell.neighbour(n).ground);
    }
    cell.ground = match cell.ground {
        Ground::Tree if lit => Ground::Fire,
        Ground::Fire => Ground::Bare,
        _ => cell.ground,
    };
}

#[elementary_process]
fn fly(me: &mut Slot<Ember>, wind: &Wind) {
    me.position.x += wind.speed;
}

#[migration]
fn settle(me: &Slot<Ember>, space: &Space) -> Destination {
    space.cell_containing(me.position)
}

/// A row of trees, and an ember at its left end.
///
/// # Errors
/// None: the model is right.
pub fn model() -> Result<Model, Box<dyn std::error::Error>> {
    let model = Model::builder("forest")
        .extents([8, 1, 1])
        .neighbourhood(Neighbourhood::custom(vec![[0, 0, 0], [-1, 0, 0], [1, 0, 0]])?)
        .substates::<Forest>()
        .population::<Ember>(1)
        .items_may_leave::<Ember>()
        .parameters(Wind { speed: 0.5 })
        .process((burn, fly, settle))
        .fill(|_| Forest { ground: Ground::Tree })
        .initialise(|state| {
            let ember = Ember { position: Vector3::new(0.5, 0.5, 0.5) };
            Ok(state.set_items(vec![Item { label: 0, cell: [0; 3], state: ember }])?)
        })
        .build()?;
    Ok(model)
}

#[cfg(test)]
mod tests {
    use super::{Forest, Ground, model};
    use cellular::prelude::*;

    #[test]
    fn an_ember_burns_down_the_row() {
        let model = model().expect("the model is right");
        for engine in [&Reference as &dyn Engine, &cellular::Cpu::with_threads(2).expect("two threads")] {
            let mut simulation = Simulation::new(&model, engine, RunOptions::default()).expect("a start");
            simulation.run(20).expect("the steps succeed");
            assert_eq!(simulation.state().count(Forest::GROUND, Ground::Bare).expect("a count"), 8);
        }
    }
}
