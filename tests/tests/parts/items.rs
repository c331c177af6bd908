//! Items in parts of their space: they are seen across borders, and they cross them.

use crate::borders::{Behind, Manner};
use crate::models::number;
use crate::{TestResult, cpu};
use std::error::Error;
use xca_core::Snapshot;
use xca_core::engine::Figure;
use xca_core::prelude::*;
use xca_parts::{Grid, Parts};

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
pub(crate) struct Walker {
    #[position]
    pub(crate) position: Vector3<Real>,
    pub(crate) velocity: Vector3<Real>,
    pub(crate) met: u32,
    pub(crate) heard: [Real; 2],
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ground {
    worn: u32,
}

/// Sees others, and what they have heard, which goes to a second buffer.
#[elementary_process]
pub(crate) fn meet(me: &mut Slot<Walker>, space: &Space) {
    for other in me.others_within(0.75 * space.side()) {
        me.met = 31 * (me.met % 100_000) + other.label();
        me.heard[0] += 0.25 * other.heard[1] + other.velocity.x;
    }
    me.heard[1] = 0.5 * me.heard[0] + me.random(0);
}

#[elementary_process]
pub(crate) fn walk(me: &mut Slot<Walker>, space: &Space) {
    me.position = space.wrapped(me.position + me.velocity);
}

#[migration]
pub(crate) fn settle(me: &Slot<Walker>, space: &Space) -> Destination {
    space.cell_containing(me.position)
}

#[elementary_process]
pub(crate) fn wear(ground: &mut Cell<Ground>, walkers: &Slots<Walker>) {
    for walker in walkers {
        ground.worn += 1 + walker.label() % 3;
    }
}

/// Walkers everywhere, which go up to a cell further in each step.
fn walkers(
    extents: [usize; 3],
    boundary: Boundary,
    slots: usize,
    count: u32,
) -> Result<Model, Box<dyn Error>> {
    Ok(crowd(extents, boundary, slots, count).process((meet, walk, settle, wear)).build()?)
}

/// The same, before they have a process.
pub(crate) fn crowd(extents: [usize; 3], boundary: Boundary, slots: usize, count: u32) -> ModelBuilder {
    let item = move |label: u32| {
        let cell = [0, 1, 2].map(|axis| number([axis, 3, 3], label, extents[axis] as u32));
        let [x, y, z] = cell.map(|index| f64::from(index) + 0.5);
        let way = |axis| f64::from(number([axis, 5, 5], label, 101)) / 60.0 - 0.8;
        let velocity = if extents[2] == 1 {
            Vector3::new(way(0), way(1), 0.0)
        } else {
            Vector3::new(way(0), way(1), way(2))
        };
        let state = Walker { position: Vector3::new(x, y, z), velocity, met: 0, heard: [0.0; 2] };
        Item { label, cell: cell.map(|index| index as usize), state }
    };
    let neighbourhood = if extents[2] == 1 { Neighbourhood::moore_2d(1) } else { Neighbourhood::moore(1) };
    Model::builder("walkers")
        .extents(extents)
        .neighbourhood(neighbourhood)
        .boundary(boundary)
        .substates::<Ground>()
        .population::<Walker>(slots)
        .items_may_leave::<Walker>()
        .initialise(move |state| Ok(state.set_items((0..count).map(item).collect::<Vec<_>>())?))
}

pub(crate) const STEPS: u64 = 12;

/// Parts do these steps without asking each other.
const LEAP: u64 = 9;

/// What a simulation looks like after a step.
#[derive(Debug, PartialEq)]
pub(crate) struct Seen {
    snapshot: Snapshot,
    /// Sums of floats depend on their order.
    heard: u64,
    largest_occupancy: u32,
}

/// What is seen after each step, some of which are done twice, and after a last leap.
fn run(model: &Model, engine: &dyn Engine) -> Result<Vec<Seen>, Box<dyn Error>> {
    Ok(run_and_report(model, engine)?.0)
}

/// The same, with the figures of the engine.
pub(crate) fn run_and_report(
    model: &Model,
    engine: &dyn Engine,
) -> Result<(Vec<Seen>, Vec<Figure>), Box<dyn Error>> {
    let options = RunOptions { precision: Precision::F64, seed: 3 };
    let mut simulation = Simulation::new(model, engine, options)?;
    let mut seen: Vec<Seen> = Vec::new();
    for step in 0..STEPS {
        if step == 7 {
            simulation.restore(&seen[2].snapshot)?;
        }
        simulation.run(if step + 1 == STEPS { LEAP } else { 1 })?;
        let snapshot = simulation.snapshot()?;
        let state = simulation.state();
        let heard = state.sum(Walker::HEARD)?[1].to_bits();
        let largest_occupancy = state.largest_occupancy::<Walker>()?;
        seen.push(Seen { snapshot, heard, largest_occupancy });
    }
    Ok((seen, simulation.figures()))
}

#[test]
fn items_cross_all_borders() -> TestResult {
    for (extents, cuts) in
        [([5, 9, 1], vec![[2, 1], [3, 1], [9, 1]]), ([4, 5, 6], vec![[2, 1], [1, 2], [2, 2], [5, 6]])]
    {
        for boundary in [Boundary::Flat, Boundary::Toroidal] {
            let model = walkers(extents, boundary, 60, 80)?;
            let wanted = run(&model, &Reference)?;
            for (turn, [y, z]) in cuts.iter().enumerate() {
                let grid = Grid { y: *y, z: *z };
                let parts = Parts::with_grid(cpu(1 + turn % 3, turn)?, grid);
                assert!(run(&model, &parts)? == wanted, "{extents:?} {boundary} {grid}");
            }
            let late = Behind { engine: cpu(2, 3)?, manner: Manner::Late };
            let parts = Parts::with_grid(late, Grid { y: 3, z: extents[2].min(2) });
            assert!(run(&model, &parts)? == wanted, "{extents:?} {boundary}, late");
        }
    }
    Ok(())
}

/// Walkers that search while they are up to 0.8 sides outside their cells, which may be in other parts.
#[test]
fn walkers_are_found_outside_their_cells() -> TestResult {
    for (extents, cuts) in [([5, 9, 1], vec![[2, 1], [9, 1]]), ([4, 5, 6], vec![[2, 2], [5, 6]])] {
        for boundary in [Boundary::Flat, Boundary::Toroidal] {
            let model = crowd(extents, boundary, 60, 80).process((walk, meet, settle, wear)).build()?;
            let wanted = run(&model, &Reference)?;
            for [y, z] in cuts.clone() {
                let parts = Parts::with_grid(cpu(1, 0)?, Grid { y, z });
                assert!(run(&model, &parts)? == wanted, "{extents:?} {boundary} {y} {z}");
            }
        }
    }
    Ok(())
}

/// The border of a part fails while items are seen, while they cross, and while parts agree.
#[test]
fn a_part_that_cannot_go_on_ends_all() -> TestResult {
    let model = walkers([4, 8, 1], Boundary::Toroidal, 60, 40)?;
    for uses in 1..24 {
        let engine = Behind { engine: cpu(1, 1)?, manner: Manner::Fails { y: 2, uses } };
        let parts = Parts::with_grid(engine, Grid { y: 4, z: 1 });
        let mut simulation = Simulation::new(&model, &parts, RunOptions::default())?;
        let error = simulation.run(100).expect_err("a part cannot go on").to_string();
        assert!(error.contains("part 1: ") && error.contains("as planned"), "{error}");
    }
    Ok(())
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Lost {
    #[position]
    position: Vector3<Real>,
    goal: u32,
}

/// Goes beyond the space, beyond its neighbours, to nowhere, or to the cell before it along y.
#[migration]
fn stray(me: &Slot<Lost>, space: &Space) -> Destination {
    let far = if me.goal == 1 { 100.0 } else { 0.0 };
    let further = if me.goal == 2 { 3.0 } else { 0.0 };
    let back = if me.goal == 4 { 1.0 } else { 0.0 };
    let nowhere = if me.goal == 3 { (0.0 * far - 1.0).sqrt() } else { 0.0 };
    space.cell_containing(Vector3::new(me.position.x + far, me.position.y + further - back + nowhere, 0.5))
}

/// Each kind of fault of a migration in another part: the first by kind and cell is told.
#[test]
fn the_first_fault_of_a_migration() -> TestResult {
    // The rows of items in a space of eight, and their goals.
    const CASES: [&[(u32, u32)]; 7] = [
        &[(1, 1), (6, 2)],
        &[(6, 1), (1, 2)],
        &[(2, 3), (7, 1)],
        &[(7, 3), (2, 2), (3, 2)],
        // Two come where one has room for none of them, and one is lost in a later part.
        &[(2, 0), (3, 4), (6, 1)],
        &[(1, 0), (2, 4), (5, 0), (6, 4)],
        &[(3, 0), (4, 4)],
    ];
    for items in CASES {
        let all = move || {
            let item = |(label, (row, goal)): (u32, &(u32, u32))| Item {
                label,
                cell: [1, *row as usize, 0],
                state: Lost { position: Vector3::new(1.5, f64::from(*row) + 0.5, 0.5), goal: *goal },
            };
            (0..).zip(items).map(item).collect::<Vec<_>>()
        };
        let model = Model::builder("lost")
            .extents([3, 8, 1])
            .neighbourhood(Neighbourhood::moore_2d(1))
            .population::<Lost>(1)
            .process(stray)
            .initialise(move |state| Ok(state.set_items(all())?))
            .build()?;
        let outcome = |engine: &dyn Engine| -> Result<String, Box<dyn Error>> {
            let mut simulation = Simulation::new(&model, engine, RunOptions::default())?;
            let error = simulation.step().expect_err("there is a fault");
            Ok(format!("{error} {error:?}"))
        };
        let wanted = outcome(&Reference)?;
        for y in [1, 2, 4, 8] {
            let parts = Parts::with_grid(cpu(1, 1)?, Grid { y, z: 1 });
            assert_eq!(outcome(&parts)?, wanted, "{items:?} in {y} parts");
        }
    }
    Ok(())
}
