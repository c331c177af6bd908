//! Neighbour lists in parts of a space: items that are seen across borders, cross them and come back. The
//! reference engine, which has no lists, gives the expected results.

use crate::TestResult;
use crate::models::number;
use std::error::Error;
use xca_core::Snapshot;
use xca_core::prelude::*;
use xca_cpu::Cpu;
use xca_parts::{Grid, Parts};

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Grain {
    #[position]
    position: Vector3<Real>,
    velocity: Vector3<Real>,
    seen: u32,
}

#[elementary_process]
fn look(me: &mut Slot<Grain>) {
    for other in me.others_within(0.45) {
        me.seen = me.seen.wrapping_mul(31).wrapping_add(other.label());
    }
}

#[elementary_process]
fn fly(me: &mut Slot<Grain>, space: &Space) {
    me.position = space.wrapped(me.position + me.velocity);
}

/// Grains return after six steps.
#[elementary_process]
fn turn_back(me: &mut Slot<Grain>) {
    me.velocity = -me.velocity;
}

#[migration]
fn settle(me: &Slot<Grain>, space: &Space) -> Destination {
    space.cell_containing(me.position)
}

const EXTENTS: [usize; 3] = [4, 12, 10];
const COUNT: u32 = 1200;
/// Parts do the steps of a leap without asking each other.
const LEAPS: [u64; 5] = [1, 1, 2, 3, 8];
const STEPS: u64 = 15;

/// The speeds of grains, in sides a step.
struct Motion {
    together: [f64; 3],
    /// The largest speed beside the common one.
    apart: f64,
    /// The share of grains that move, as one in so many.
    one_in: u32,
}

/// Grains everywhere.
fn crowd(motion: &Motion) -> Vec<Item<Grain>> {
    let Motion { together, apart, one_in } = *motion;
    let item = |label: u32| {
        let share = |which| f64::from(number([which, 7, 7], label, 10_000)) / 10_000.0;
        let place = [0, 1, 2].map(|axis| share(axis) * EXTENTS[axis] as f64);
        let moves = f64::from(u8::from(label.is_multiple_of(one_in)));
        let speed = |axis: usize| moves * (together[axis] + apart * (2.0 * share(3 + axis) - 1.0));
        grain(label, place, [0, 1, 2].map(speed))
    };
    (0..COUNT).map(item).collect()
}

fn grain(label: u32, place: [f64; 3], [u, v, w]: [f64; 3]) -> Item<Grain> {
    let [x, y, z] = place;
    let state = Grain { position: Vector3::new(x, y, z), velocity: Vector3::new(u, v, w), seen: 0 };
    Item { label, cell: place.map(|place| place as usize), state }
}

fn grains(boundary: Boundary, items: Vec<Item<Grain>>) -> Result<Model, ModelError> {
    Model::builder("grains")
        .extents(EXTENTS)
        .neighbourhood(Neighbourhood::moore(1))
        .boundary(boundary)
        .population::<Grain>(100)
        .items_may_leave::<Grain>()
        .process((look, fly))
        .process_every(6, turn_back)
        .process(settle)
        .initialise(move |state| Ok(state.set_items(items.clone())?))
        .build()
}

/// The snapshots after each leap, and the passes of all parts that had lists.
fn run(
    model: &Model,
    engine: &dyn Engine,
    precision: Precision,
) -> Result<(Vec<Snapshot>, f64), Box<dyn Error>> {
    let mut simulation = Simulation::new(model, engine, RunOptions { precision, seed: 0 })?;
    let mut snapshots = Vec::new();
    for steps in LEAPS {
        simulation.run(steps)?;
        snapshots.push(simulation.snapshot()?);
    }
    let figures = simulation.figures().into_iter();
    let listed = figures.filter(|figure| figure.name.ends_with("grain_passes_with_lists"));
    Ok((snapshots, listed.map(|figure| figure.value).sum()))
}

#[test]
fn lists_of_parts_do_not_change_a_bit() -> TestResult {
    let rest = [0.0; 3];
    let motions = [
        ("at rest", Motion { together: rest, apart: 0.0, one_in: 1 }),
        ("slow", Motion { together: rest, apart: 0.03, one_in: 1 }),
        ("together", Motion { together: [0.1, -0.2, 0.15], apart: 0.005, one_in: 1 }),
        ("past each other", Motion { together: [0.0, -0.05, 0.04], apart: 0.01, one_in: 2 }),
        ("one in twenty", Motion { together: rest, apart: 0.08, one_in: 20 }),
        ("fast", Motion { together: rest, apart: 0.6, one_in: 1 }),
    ];
    for (name, motion) in &motions {
        for (boundary, precision) in [(Boundary::Flat, Precision::F32), (Boundary::Toroidal, Precision::F64)]
        {
            let model = grains(boundary, crowd(motion))?;
            let (wanted, _) = run(&model, &Reference, precision)?;
            for (threads, [y, z]) in [1, 2, 1, 2].into_iter().zip([[2, 1], [1, 2], [2, 2], [4, 3]]) {
                for skin in [1e-3, 0.3, 1e9] {
                    let engine = Cpu::with_threads(threads)?.with_skin(skin);
                    let (got, listed) = run(&model, &Parts::with_grid(engine, Grid { y, z }), precision)?;
                    let step = wanted.iter().zip(&got).position(|(wanted, got)| wanted != got);
                    let case = format!("{name}, {boundary}, {y} x {z} parts, skin {skin}");
                    assert_eq!(step, None, "{case}");
                    assert!(motion.apart > 0.1 || listed >= (STEPS as f64) / 2.0, "{case}: {listed} passes");
                }
            }
        }
    }
    Ok(())
}

/// The first grain goes to the other part. Its place becomes that of the second, which the third sees once.
#[test]
fn what_has_gone_to_another_part_is_in_no_list() -> TestResult {
    let rest = [0.0; 3];
    let items = vec![
        grain(0, [0.5, 6.05, 0.5], [0.0, -0.02, 0.0]),
        grain(1, [0.5, 6.9, 0.5], rest),
        grain(2, [0.5, 7.0, 0.5], rest),
    ];
    let model = grains(Boundary::Flat, items)?;
    let engine = Cpu::with_threads(1)?.with_skin(1e9);
    let parts = Parts::with_grid(engine, Grid { y: 2, z: 1 });
    let (got, listed) = run(&model, &parts, Precision::F64)?;
    assert!(got == run(&model, &Reference, Precision::F64)?.0);
    assert!(listed >= (STEPS as f64) / 2.0, "{listed} passes");
    Ok(())
}
