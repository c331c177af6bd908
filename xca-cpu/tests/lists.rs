//! Neighbour lists: when they are made, and that they do not change a bit. The reference engine, which has no
//! lists, gives the expected results.

use std::collections::HashMap;
use std::error::Error;
use xca_core::Snapshot;
use xca_core::prelude::*;
use xca_cpu::Cpu;

type TestResult = Result<(), Box<dyn Error>>;

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Grain {
    #[position]
    position: Vector3<Real>,
    velocity: Vector3<Real>,
    radius: Real,
    seen: u32,
}

#[elementary_process]
fn look(me: &mut Slot<Grain>) {
    for other in me.others_within(me.radius) {
        me.seen = me.seen.wrapping_mul(31).wrapping_add(other.label());
    }
    for other in me.others_in_cell_within(me.radius) {
        me.seen = me.seen.wrapping_mul(37).wrapping_add(other.label());
    }
}

/// In the same pass as [`look`], with the same radius for all items.
#[elementary_process]
fn look_again(me: &mut Slot<Grain>) {
    for other in me.others_in_neighbours_within(0.4) {
        me.seen = me.seen.wrapping_mul(41).wrapping_add(other.label());
    }
}

#[elementary_process]
fn fly(me: &mut Slot<Grain>, space: &Space) {
    me.position = space.wrapped(me.position + me.velocity);
}

#[migration]
fn settle(me: &Slot<Grain>, space: &Space) -> Destination {
    space.cell_containing(me.position)
}

/// A number from 0 to 1, from `label` and `which`.
fn number(label: u32, which: u32) -> f64 {
    let mut mixed = (label * 8 + which).wrapping_add(1);
    for factor in [0x7feb_352d_u32, 0x846c_a68b, 0x9e37_79b1] {
        mixed = (mixed ^ (mixed >> 15)).wrapping_mul(factor);
    }
    f64::from(mixed >> 8) / f64::from(1 << 24)
}

/// The motion of grains, and their search radius, in sides of a cell.
struct Motion {
    together: [f64; 3],
    apart: f64,
    radius: fn(u32) -> f64,
}

const EXTENTS: [usize; 3] = [7, 6, 5];

fn grains(boundaries: [Boundary; 3], motion: &Motion) -> Result<Model, ModelError> {
    let Motion { together, apart, radius } = *motion;
    Model::builder("grains")
        .extents(EXTENTS)
        .neighbourhood(Neighbourhood::moore(1))
        .boundaries(boundaries)
        .population::<Grain>(100)
        .items_may_leave::<Grain>()
        .process(look)
        .process(look_again)
        .process(fly)
        .process(settle)
        .initialise(move |state| {
            let item = |label: u32| {
                let place = [0, 1, 2].map(|axis| number(label, axis) * EXTENTS[axis as usize] as f64);
                let speed =
                    [0, 1, 2].map(|axis| together[axis] + apart * (number(label, 3 + axis as u32) - 0.5));
                let [x, y, z] = place;
                let [u, v, w] = speed;
                let state = Grain {
                    position: Vector3::new(x, y, z),
                    velocity: Vector3::new(u, v, w),
                    radius: radius(label),
                    seen: 0,
                };
                Item { label, cell: place.map(|place| place as usize), state }
            };
            Ok(state.set_items((0..600).map(item).collect())?)
        })
        .build()
}

const FLAT: [Boundary; 3] = [Boundary::Flat; 3];
const TORUS: [Boundary; 3] = [Boundary::Toroidal; 3];

/// The skins of the lists, in radii: the engine's choice, nearly zero, typical, and too large.
const SKINS: [Option<f64>; 4] = [None, Some(1e-3), Some(0.3), Some(1e9)];

/// The snapshots after each of `steps` steps.
fn run(
    model: &Model,
    engine: &dyn Engine,
    precision: Precision,
    steps: u64,
) -> Result<Vec<Snapshot>, Box<dyn Error>> {
    let mut simulation = Simulation::new(model, engine, RunOptions { precision, seed: 0 })?;
    let mut snapshots = Vec::new();
    for _ in 0..steps {
        simulation.step()?;
        snapshots.push(simulation.snapshot()?);
    }
    Ok(snapshots)
}

/// The figures of the engine after `steps` steps.
fn figures(model: &Model, engine: &Cpu, steps: u64) -> Result<HashMap<String, f64>, Box<dyn Error>> {
    let mut simulation = Simulation::new(model, engine, RunOptions::default())?;
    simulation.run(steps)?;
    Ok(simulation.figures().into_iter().map(|figure| (figure.name, figure.value)).collect())
}

fn with_skin(threads: usize, skin: Option<f64>) -> Result<Cpu, Box<dyn Error>> {
    let engine = Cpu::with_threads(threads)?;
    Ok(match skin {
        Some(radii) => engine.with_skin(radii),
        None => engine,
    })
}

#[test]
fn no_skin_and_no_motion_changes_a_bit() -> TestResult {
    let same = |_| 0.45;
    let other = |label| 0.2 + 0.4 * number(label, 7);
    let motions = [
        ("at rest", Motion { together: [0.0; 3], apart: 0.0, radius: same }),
        ("slow", Motion { together: [0.0; 3], apart: 0.02, radius: same }),
        ("together", Motion { together: [0.1, -0.2, 0.15], apart: 0.001, radius: same }),
        ("fast", Motion { together: [0.0; 3], apart: 1.2, radius: same }),
        ("each its own radius", Motion { together: [0.03, 0.0, 0.0], apart: 0.03, radius: other }),
        ("as far as there is room", Motion { together: [0.0; 3], apart: 0.01, radius: |_| 0.999 }),
    ];
    for (name, motion) in &motions {
        for boundaries in [FLAT, TORUS, [Boundary::Toroidal, Boundary::Flat, Boundary::Flat]] {
            let model = grains(boundaries, motion)?;
            for precision in [Precision::F32, Precision::F64] {
                let wanted = run(&model, &Reference, precision, 12)?;
                for (threads, skin) in [1, 2, 3, 2].into_iter().zip(SKINS) {
                    let got = run(&model, &with_skin(threads, skin)?, precision, 12)?;
                    let step = wanted.iter().zip(&got).position(|(wanted, got)| wanted != got);
                    assert_eq!(step, None, "{name}, {boundaries:?}, {precision}, skin {skin:?}");
                }
            }
        }
    }
    Ok(())
}

#[test]
fn lists_last_while_nothing_moves_against_each_other() -> TestResult {
    let engine = with_skin(1, Some(0.3))?;
    let radius = |_| 0.45;
    // The speeds are powers of two, so the references in f32 are exact.
    for together in [[0.0; 3], [0.0625, 0.125, -0.0625]] {
        let model = grains(TORUS, &Motion { together, apart: 0.0, radius })?;
        let told = figures(&model, &engine, 40)?;
        assert_eq!(told["grain_searching_passes"], 40.0);
        assert_eq!(told["grain_passes_with_lists"], 39.0, "all but the first, in which the radius is learnt");
        assert_eq!(told["grain_lists_made"], 1.0, "{together:?}");
    }
    // Two grains approach by at most 0.1 sqrt(3) a step. The skin is 0.135.
    let model = grains(TORUS, &Motion { together: [0.0; 3], apart: 0.1, radius })?;
    let told = figures(&model, &engine, 40)?;
    assert!((20.0..=39.0).contains(&told["grain_lists_made"]), "{told:?}");
    Ok(())
}

#[test]
fn lists_hold_what_is_near_and_no_more() -> TestResult {
    let model = grains(TORUS, &Motion { together: [0.0; 3], apart: 0.0, radius: |_| 0.45 })?;
    let told = figures(&model, &with_skin(1, Some(0.3))?, 3)?;
    let places: Vec<[f64; 3]> = (0..600)
        .map(|label| [0, 1, 2].map(|axis| number(label, axis) * EXTENTS[axis as usize] as f64))
        .collect();
    let distance = |one: &[f64; 3], other: &[f64; 3]| {
        let ways = [0, 1, 2].map(|axis| {
            let (way, length) = ((one[axis] - other[axis]).abs(), EXTENTS[axis] as f64);
            way.min(length - way)
        });
        ways.iter().map(|way| way * way).sum::<f64>().sqrt()
    };
    let near = places.iter().flat_map(|one| places.iter().map(move |other| (one, other)));
    let pairs = near.filter(|(one, other)| one != other && distance(one, other) < 0.45 * 1.3).count();
    let wanted = pairs as f64 / 600.0;
    assert!((told["grain_candidates_per_item"] - wanted).abs() < 1e-3 * wanted, "{told:?}, not {wanted}");
    Ok(())
}

#[test]
fn a_radius_that_leaves_no_room_is_searched_without_lists() -> TestResult {
    let model = grains(FLAT, &Motion { together: [0.0; 3], apart: 0.0, radius: |_| 0.999 })?;
    let told = figures(&model, &with_skin(1, Some(0.3))?, 10)?;
    assert_eq!(told["grain_passes_with_lists"], 0.0);
    Ok(())
}
