//! Neighbour lists in parts of a space: items that are seen across borders, cross them and come back. The
//! reference engine, which has no lists, gives the expected results.

use crate::TestResult;
use crate::models::number;
use std::error::Error;
use xca_core::Snapshot;
use xca_core::prelude::*;
use xca_cpu::Cpu;
use xca_parts::{Cut, Parts};

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
const STEPS: u64 = 15;

/// Grains that move by up to `apart` sides in a step, besides a common motion.
fn grains(boundary: Boundary, together: [f64; 3], apart: f64) -> Result<Model, ModelError> {
    let item = move |label: u32| {
        let share = |which| f64::from(number([which, 7, 7], label, 10_000)) / 10_000.0;
        let place = [0, 1, 2].map(|axis| share(axis) * EXTENTS[axis] as f64);
        let [u, v, w] = [0, 1, 2].map(|axis| together[axis] + apart * (2.0 * share(3 + axis) - 1.0));
        let [x, y, z] = place;
        let state = Grain { position: Vector3::new(x, y, z), velocity: Vector3::new(u, v, w), seen: 0 };
        Item { label, cell: place.map(|place| place as usize), state }
    };
    Model::builder("grains")
        .extents(EXTENTS)
        .neighbourhood(Neighbourhood::moore(1))
        .boundary(boundary)
        .population::<Grain>(100)
        .items_may_leave::<Grain>()
        .process((look, fly))
        .process_every(6, turn_back)
        .process(settle)
        .initialise(move |state| Ok(state.set_items((0..COUNT).map(item).collect::<Vec<_>>())?))
        .build()
}

/// The snapshots after each step, and the passes of all parts that had lists.
fn run(
    model: &Model,
    engine: &dyn Engine,
    precision: Precision,
) -> Result<(Vec<Snapshot>, f64), Box<dyn Error>> {
    let mut simulation = Simulation::new(model, engine, RunOptions { precision, seed: 0 })?;
    let mut snapshots = Vec::new();
    for _ in 0..STEPS {
        simulation.step()?;
        snapshots.push(simulation.snapshot()?);
    }
    let figures = simulation.figures().into_iter();
    let listed = figures.filter(|figure| figure.name.ends_with("grain_passes_with_lists"));
    Ok((snapshots, listed.map(|figure| figure.value).sum()))
}

#[test]
fn lists_of_parts_do_not_change_a_bit() -> TestResult {
    let motions = [
        ("at rest", [0.0; 3], 0.0),
        ("slow", [0.0; 3], 0.03),
        ("together", [0.1, -0.2, 0.15], 0.005),
        ("fast", [0.0; 3], 0.6),
    ];
    let cuts = [[2, 1], [1, 2], [2, 2], [5, 1], [4, 3]];
    for (name, together, apart) in motions {
        for boundary in [Boundary::Flat, Boundary::Toroidal] {
            let model = grains(boundary, together, apart)?;
            for (turn, precision) in [Precision::F32, Precision::F64].into_iter().enumerate() {
                let (wanted, _) = run(&model, &Reference, precision)?;
                for (number, [y, z]) in cuts.into_iter().enumerate() {
                    let skin = [1e-3, 0.3, 1e9][(turn + number) % 3];
                    let engine = Cpu::with_threads(1 + number % 2)?.with_skin(skin);
                    let (got, listed) = run(&model, &Parts::with_cut(engine, Cut { y, z }), precision)?;
                    let step = wanted.iter().zip(&got).position(|(wanted, got)| wanted != got);
                    let case = format!("{name}, {boundary}, {precision}, {y} x {z} parts, skin {skin}");
                    assert_eq!(step, None, "{case}");
                    assert!(apart > 0.1 || listed >= (STEPS as f64) / 2.0, "{case}: {listed} passes");
                }
            }
        }
    }
    Ok(())
}
