//! Small models on the reference engine, checked by hand.

use xca_core::prelude::*;

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Life {
    alive: u8,
}

#[elementary_process]
fn evolve(cell: &mut Cell<Life>) {
    let mut count = 0;
    for n in 1..cell.neighbour_count() {
        count += cell.neighbour(n).alive;
    }
    cell.alive = if count == 3 || (count == 2 && cell.alive == 1) { 1 } else { 0 };
}

const GLIDER: [[usize; 2]; 5] = [[1, 0], [2, 1], [0, 2], [1, 2], [2, 2]];

/// On a torus a glider is back after four steps a cell, one cell further along both axes.
#[test]
fn glider_goes_round_the_torus() -> Result<(), Box<dyn std::error::Error>> {
    let model = Model::builder("life")
        .extents([8, 8, 1])
        .neighbourhood(Neighbourhood::moore_2d(1))
        .boundary(Boundary::Toroidal)
        .substates::<Life>()
        .process(evolve)
        .fill(|site| Life { alive: u8::from(GLIDER.contains(&[site.cell()[0], site.cell()[1]])) })
        .build()?;
    let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
    let before = simulation.state().read(Life::ALIVE)?;
    simulation.run(4)?;
    let after = simulation.state().read(Life::ALIVE)?;
    for y in 0..8 {
        for x in 0..8 {
            assert_eq!(after[(y + 1) % 8 * 8 + (x + 1) % 8], before[y * 8 + x]);
        }
    }
    simulation.run(28)?;
    assert_eq!(simulation.state().read(Life::ALIVE)?, before);
    assert_eq!(simulation.state().sum(Life::ALIVE)?, 5);
    Ok(())
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Walker {
    #[position]
    position: Vector3<Real>,
    seen: u32,
}

#[elementary_process]
fn walk(me: &mut Slot<Walker>) {
    me.seen = 0;
    for other in me.others_within(0.75) {
        me.seen = 10 * me.seen + other.label();
    }
}

#[elementary_process]
fn step_right(me: &mut Slot<Walker>) {
    me.position.x += 0.25;
}

#[migration]
fn settle(me: &Slot<Walker>, space: &Space) -> Destination {
    space.cell_containing(me.position)
}

#[test]
fn items_see_each_other_in_order_and_move() -> Result<(), Box<dyn std::error::Error>> {
    let model = Model::builder("walkers")
        .extents([4, 1, 1])
        .neighbourhood(Neighbourhood::custom(vec![[0, 0, 0], [-1, 0, 0], [1, 0, 0]])?)
        .population::<Walker>(4)
        .items_may_leave::<Walker>()
        .process(walk)
        .process(step_right)
        .process(settle)
        .initialise(|state| {
            let at = |label, x: f64| Item {
                label,
                cell: [x as usize, 0, 0],
                state: Walker { position: Vector3::new(x, 0.5, 0.5), seen: 0 },
            };
            // Given in no order; the engine sorts by cell and label.
            state.set_items(vec![at(5, 1.25), at(3, 1.5), at(4, 0.875), at(1, 2.0), at(2, 3.875)])?;
            Ok(())
        })
        .build()?;
    let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
    simulation.step()?;
    let items = simulation.state().items::<Walker>()?;
    let seen: Vec<(u32, usize, u32)> =
        items.iter().map(|item| (item.label, item.cell[0], item.state.seen)).collect();
    // 4 and 5 are 0.375 apart, 4 and 3 0.625, 5 and 3 0.25, 3 and 1 0.5; 5 and 1 exactly 0.75, which is not
    // within.
    assert_eq!(seen, [(3, 1, 541), (4, 1, 35), (5, 1, 34), (1, 2, 3)]);
    assert_eq!(simulation.state().count_left::<Walker>()?, 1);
    Ok(())
}
