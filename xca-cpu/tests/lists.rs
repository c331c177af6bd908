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

/// Does nothing for grains without others nearby.
#[elementary_process]
fn feel(me: &mut Slot<Grain>) {
    if me.seen == 0 || !(me.radius > 0.1) {
        return;
    }
    for other in me.others_in_cell_within(0.4) {
        me.seen = me.seen.wrapping_mul(43).wrapping_add(other.label());
    }
    for other in me.others_in_cell() {
        me.seen = me.seen.wrapping_mul(47).wrapping_add(other.label());
    }
}

/// The same, but all values are copied to a second buffer.
#[elementary_process]
fn exchange(me: &mut Slot<Grain>) {
    for other in me.others_within(0.4) {
        me.seen = me.seen.wrapping_mul(53).wrapping_add(other.seen);
    }
}

/// Writes the positions to a second buffer.
#[elementary_process]
fn lean(me: &mut Slot<Grain>) {
    for other in me.others_in_cell() {
        me.position += (other.position - me.position) * 0.05;
    }
}

/// Always does something.
#[elementary_process]
fn tally(me: &mut Slot<Grain>) {
    me.seen = me.seen.wrapping_add(1);
    for other in me.others_in_neighbours_within(0.4) {
        me.seen = me.seen.wrapping_add(other.label());
    }
}

/// Two radii.
#[elementary_process]
fn look_twice(me: &mut Slot<Grain>) {
    for other in me.others_within(0.3) {
        me.seen = me.seen.wrapping_mul(61).wrapping_add(other.label());
    }
    for other in me.others_within(0.7) {
        me.seen = me.seen.wrapping_add(other.label());
    }
}

/// Does something for some grains.
#[elementary_process]
fn tire(me: &mut Slot<Grain>) {
    if me.radius > 0.5 {
        me.seen = me.seen.wrapping_mul(59);
        return;
    }
    for other in me.others_within(0.4) {
        me.seen = me.seen.wrapping_add(other.label());
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
    space(boundaries).process((look, look_again, fly, settle)).initialise(placed(600, motion)).build()
}

fn space(boundaries: [Boundary; 3]) -> ModelBuilder {
    Model::builder("grains")
        .extents(EXTENTS)
        .neighbourhood(Neighbourhood::moore(1))
        .boundaries(boundaries)
        .population::<Grain>(100)
        .items_may_leave::<Grain>()
}

/// Places so many grains.
fn placed(
    count: u32,
    motion: &Motion,
) -> impl Fn(&mut State<'_>) -> Result<(), SteeringError> + Send + Sync + use<> {
    let Motion { together, apart, radius } = *motion;
    move |state| {
        let item = |label: u32| {
            let place = [0, 1, 2].map(|axis| number(label, axis) * EXTENTS[axis as usize] as f64);
            let speed = [0, 1, 2].map(|axis| together[axis] + apart * (number(label, 3 + axis as u32) - 0.5));
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
        Ok(state.set_items((0..count).map(item).collect())?)
    }
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
            compare(name, &grains(boundaries, motion)?)?;
        }
    }
    Ok(())
}

/// Compares the engine with the reference engine, with all skins.
fn compare(name: &str, model: &Model) -> TestResult {
    for precision in [Precision::F32, Precision::F64] {
        let wanted = run(model, &Reference, precision, 12)?;
        for (threads, skin) in [1, 2, 3, 2].into_iter().zip(SKINS) {
            let got = run(model, &with_skin(threads, skin)?, precision, 12)?;
            let step = wanted.iter().zip(&got).position(|(wanted, got)| wanted != got);
            assert_eq!(step, None, "{name}, {precision}, skin {skin:?}");
        }
    }
    Ok(())
}

/// Few grains are near others, so that most are left out where they do nothing.
#[test]
fn grains_alone_do_what_they_do_in_the_reference_engine() -> TestResult {
    for apart in [0.0, 0.05, 0.8] {
        let motion = Motion { together: [0.02, 0.0, -0.01], apart, radius: |label| number(label, 7) };
        for boundaries in [FLAT, TORUS] {
            for grains in [1, 2, 90] {
                let start = placed(grains, &motion);
                let builder = space(boundaries)
                    .process((look_again, feel, exchange, tally, look_twice, tire, fly, settle));
                compare(&format!("{grains}, {apart}"), &builder.initialise(start).build()?)?;
            }
        }
    }
    Ok(())
}

/// Without a migration, grains move away from their cells.
#[test]
fn grains_outside_of_their_cells_change_no_bit() -> TestResult {
    for apart in [0.01, 0.05, 0.1] {
        let motion = Motion { together: [0.0; 3], apart, radius: |_| 0.3 };
        for boundaries in [FLAT, TORUS] {
            let builder = space(boundaries).process((look, fly));
            compare(&apart.to_string(), &builder.initialise(placed(1500, &motion)).build()?)?;
        }
    }
    Ok(())
}

/// Lists do not know the motion of a pass that writes positions to a second buffer.
#[test]
fn positions_in_a_second_buffer_change_no_bit() -> TestResult {
    for apart in [0.0, 0.1] {
        let motion = Motion { together: [0.0; 3], apart, radius: |_| 0.45 };
        for boundaries in [FLAT, TORUS] {
            let builder = space(boundaries).process((look, lean, look_again, fly, settle));
            compare(&apart.to_string(), &builder.initialise(placed(300, &motion)).build()?)?;
        }
    }
    Ok(())
}

#[derive(Parameters, Clone, Copy, Debug)]
struct Reach {
    radius: Real,
}

#[elementary_process]
fn reach(me: &mut Slot<Grain>, p: &Reach) {
    if me.seen > 5 {
        return;
    }
    for other in me.others_within(2.0 * p.radius) {
        me.seen += other.label();
    }
}

#[elementary_process]
fn grow(me: &mut Slot<Grain>) {
    me.seen += 1;
}

#[elementary_process]
fn divide(me: &mut Slot<Grain>) {
    if 12 / (4 - me.seen) > 100 {
        return;
    }
    for other in me.others_within(0.4) {
        me.seen = me.seen.wrapping_add(other.label());
    }
}

/// A division by zero in a condition is a fault, also of a grain without others.
#[test]
fn a_condition_that_panics_is_a_fault_of_grains_alone() -> TestResult {
    let motion = Motion { together: [0.0; 3], apart: 0.0, radius: |_| 0.1 };
    let model = space(FLAT).process((divide, grow)).initialise(placed(3, &motion)).build()?;
    for skin in SKINS {
        let engine = with_skin(2, skin)?;
        let mut simulation = Simulation::new(&model, &engine, RunOptions::default())?;
        simulation.run(4)?;
        assert!(simulation.run(1).is_err(), "{skin:?}");
    }
    Ok(())
}

/// A search with a wrong radius is a fault, also of a grain without others.
#[test]
fn a_wrong_radius_is_a_fault_of_grains_alone() -> TestResult {
    let motion = Motion { together: [0.0; 3], apart: 0.0, radius: |_| 0.1 };
    for radius in ["-0.1", "0.6"] {
        let builder = space(FLAT).parameters(Reach { radius: 0.1 }).process((look_again, reach));
        // The radius is right until there are lists.
        let model = builder
            .initialise(placed(3, &motion))
            .steer(Schedule::At(vec![4]), move |state| Ok(state.set_parameter("radius", radius)?))
            .build()?;
        let fault = |engine: &dyn Engine| -> Result<String, Box<dyn Error>> {
            let mut simulation = Simulation::new(&model, engine, RunOptions::default())?;
            simulation.run(4)?;
            Ok(simulation.run(1).err().map(|error| error.to_string()).unwrap_or_default())
        };
        let wanted = fault(&Reference)?;
        assert!(!wanted.is_empty(), "{radius}");
        for skin in SKINS {
            assert_eq!(fault(&with_skin(2, skin)?)?, wanted, "{radius}, {skin:?}");
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
