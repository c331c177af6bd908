//! What a cell sees: itself, its neighbours, the space, random numbers, its items.

use crate::common::{PRECISIONS, cells, step};
use xca_core::prelude::*;
use xca_core::{Draw, Stream};

#[derive(Substates, Clone, Copy, Debug, PartialEq, Default)]
struct State {
    value: i32,
    seen: i32,
    real: Real,
    place: Vector3<i32>,
    bits: u32,
}

/// A row of six cells, whose neighbours are the left one, then the right one; beyond the ends lie cells of
/// value 100.
fn row() -> ModelBuilder {
    Model::builder("row")
        .extents([6, 1, 1])
        .cell_side(0.5)
        .neighbourhood(Neighbourhood::custom(vec![[0, 0, 0], [-1, 0, 0], [1, 0, 0]]).expect("a list"))
        .substates_with_outside(State { value: 100, ..State::default() })
        .fill(|site| State { value: site.cell()[0] as i32 + 1, ..State::default() })
}

fn after_step(model: ModelBuilder) -> Vec<State> {
    let model = model.build().expect("the model is right");
    let [single, double] = PRECISIONS.map(|precision| step::<State>(&model, precision).expect("a step"));
    assert_eq!(single, double);
    double
}

#[elementary_process]
fn see(cell: &mut Cell<State>) {
    cell.value += 1000;
    cell.value *= 2;
    let left = cell.neighbour(1);
    let itself = cell.neighbour(0);
    let mut sum = 0;
    for n in 1..cell.neighbour_count() {
        let other = cell.neighbour(n);
        sum += other.value + cell.neighbour(n).value;
    }
    cell.seen = sum + left.value * 10_000 + itself.value * 1_000_000 + cell.neighbour_count() as i32;
    cell.seen -= cell.value - cell.neighbour(0).value * 2;
}

/// The own cell shows what has been written, neighbours (and the cell as its own neighbour) the state before.
#[test]
fn own_writes_are_seen_and_those_of_neighbours_are_not() {
    let after = after_step(row().process(see));
    for (x, cell) in after.iter().enumerate() {
        let value = |x: i32| if (0..6).contains(&x) { x + 1 } else { 100 };
        let x = x as i32;
        let (left, right) = (value(x - 1), value(x + 1));
        assert_eq!(cell.value, 2 * (value(x) + 1000));
        assert_eq!(cell.seen, 2 * (left + right) + left * 10_000 + value(x) * 1_000_000 + 3 - 2000);
    }
}

#[elementary_process]
fn copy_value(cell: &mut Cell<State>) {
    cell.seen = cell.value;
}

/// A process sees what the one before has left, and what none writes stays.
#[test]
fn processes_follow_each_other() {
    let after = after_step(row().process(see).process(copy_value));
    assert!(after.iter().all(|cell| cell.seen == cell.value && cell.value > 2000 && cell.bits == 0));
}

#[elementary_process]
fn place(cell: &mut Cell<State>, space: &Space) {
    cell.place = cell.index() + space.extents() * 10;
    cell.seen = cell.index().x * 2;
    cell.real = space.side() * (space.step() as Real + 1.0);
    cell.value += space.extents().x;
}

#[test]
fn index_extents_side_and_step() {
    let model = row().process(place).build().expect("right");
    for precision in PRECISIONS {
        let options = RunOptions { precision, ..RunOptions::default() };
        let mut simulation = Simulation::new(&model, &Reference, options).expect("starts");
        simulation.run(3).expect("runs");
        for (x, cell) in cells::<State>(&simulation, precision).into_iter().enumerate() {
            let x = x as i32;
            assert_eq!(cell.place, Vector3::new(x + 60, 10, 10));
            assert_eq!((cell.seen, cell.value), (2 * x, x + 1 + 18));
            assert_eq!(cell.real, 1.5);
        }
    }
}

#[elementary_process]
fn draw(cell: &mut Cell<State>) {
    cell.bits = cell.random_bits(0);
    cell.real = cell.random(1);
    // A literal number twice would be refused.
    let again = 1;
    cell.seen = (cell.random(again) * 6.0) as i32;
}

#[test]
fn random_numbers_are_functions_of_seed_step_cell_and_draw() {
    let model = row().process(draw).build().expect("right");
    for precision in PRECISIONS {
        let mut simulation =
            Simulation::new(&model, &Reference, RunOptions { precision, seed: 42 }).expect("starts");
        simulation.run(2).expect("runs");
        for (x, cell) in cells::<State>(&simulation, precision).into_iter().enumerate() {
            let stream = Stream::process(0);
            let word = |number| Draw { stream, step: 1, owner: x as u32, number }.words(42);
            assert_eq!(cell.bits, word(0)[0]);
            let [high, low, ..] = word(1);
            let expected = match precision {
                Precision::F32 => f64::from(high >> 8) / f64::from(1 << 24),
                Precision::F64 => {
                    (f64::from(high >> 5) * f64::from(1 << 26) + f64::from(low >> 6)) / (2.0_f64).powi(53)
                }
            };
            assert_eq!(cell.real, expected);
            assert_eq!(cell.seen, (expected * 6.0) as i32);
        }
    }
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Grain {
    mass: Real,
    kind: u8,
}

#[elementary_process]
fn weigh(cell: &mut Cell<State>, grains: &Slots<Grain>) {
    cell.real = 0.0;
    for grain in grains {
        if grain.kind == 2 {
            continue;
        }
        if grain.kind == 9 {
            break;
        }
        cell.real += grain.mass;
        cell.seen = cell.seen * 10 + grain.label() as i32;
    }
    let mut pairs = 0;
    for one in grains {
        for other in grains {
            if one.label() < other.label() {
                pairs += 1;
            }
        }
    }
    cell.value = pairs;
}

#[test]
fn a_cell_goes_through_its_items_by_label() {
    let item = |label, x, mass, kind| Item { label, cell: [x, 0, 0], state: Grain { mass, kind } };
    let grains = vec![
        item(5, 1, 0.5, 1),
        item(2, 1, 0.25, 1),
        item(3, 1, 8.0, 2),
        item(7, 4, 1.0, 1),
        item(8, 4, 1.0, 9),
        item(9, 4, 1.0, 1),
    ];
    let model = row()
        .population::<Grain>(4)
        .initialise(move |state| Ok(state.set_items(grains.clone())?))
        .process(weigh);
    let after = after_step(model);
    let seen: Vec<(Real, i32, i32)> = after.iter().map(|cell| (cell.real, cell.seen, cell.value)).collect();
    let empty = (0.0, 0, 0);
    assert_eq!(seen, [empty, (0.75, 25, 3), empty, empty, (1.0, 7, 3), empty]);
}
