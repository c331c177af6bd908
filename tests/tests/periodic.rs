//! Positions and separations on a torus: `space.wrapped` and `space.nearest_image`, on every engine.

use std::error::Error;
use xca_core::prelude::*;
use xca_tests::suite::engines::{self, PRECISIONS};

const SIDE: f64 = 0.7;
const EXTENTS: [usize; 3] = [5, 6, 7];
/// z is flat.
const BOUNDARIES: [Boundary; 3] = [Boundary::Toroidal, Boundary::Toroidal, Boundary::Flat];

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Place {
    given: Vector3<Real>,
    wrapped: Vector3<Real>,
    shorter: Vector3<Real>,
}

#[elementary_process]
fn bring_in(cell: &mut Cell<Place>, space: &Space) {
    cell.wrapped = space.wrapped(cell.given);
    cell.shorter = space.nearest_image(cell.given);
}

/// Coordinates along an axis of this length, in either precision: in, out, and as near to the faces as
/// numbers can be.
fn coordinates(length: f64, precision: Precision) -> Vec<f64> {
    let next = |value: f64, up: bool| match (precision, up) {
        (Precision::F64, true) => value.next_up(),
        (Precision::F64, false) => value.next_down(),
        (Precision::F32, true) => f64::from((value as f32).next_up()),
        (Precision::F32, false) => f64::from((value as f32).next_down()),
    };
    let faces = [0.0, length, length / 2.0, -length / 2.0, -length];
    let around = faces.into_iter().flat_map(|face| [face, next(face, true), next(face, false)]);
    let others = (-30..60).map(|number| f64::from(number) * length / 31.7);
    around.chain(others).chain([-0.0, -1e-30, 1e-30, -1e-9]).collect()
}

#[test]
fn positions_come_in_and_separations_go_the_shorter_way() -> Result<(), Box<dyn Error>> {
    for precision in PRECISIONS {
        let as_stored =
            |value: f64| if precision == Precision::F32 { f64::from(value as f32) } else { value };
        let epsilon = if precision == Precision::F32 { f64::from(f32::EPSILON) } else { f64::EPSILON };
        let lengths = EXTENTS.map(|extent| extent as f64 * SIDE);
        let all: Vec<Vec<f64>> = lengths.iter().map(|length| coordinates(*length, precision)).collect();
        let count = all[0].len();
        let given = {
            let all = all.clone();
            move |cell: usize| {
                Vector3::new(all[0][cell % count], all[1][(cell * 7) % count], all[2][cell % count])
            }
        };
        let of_cell = given.clone();
        let [width, height, _] = EXTENTS;
        let model = Model::builder("torus")
            .extents(EXTENTS)
            .cell_side(SIDE)
            .boundaries(BOUNDARIES)
            .substates::<Place>()
            .process(bring_in)
            .fill(move |site| {
                let [x, y, z] = site.cell();
                let given = of_cell((z * height + y) * width + x);
                Place { given, wrapped: Vector3::splat(0.0), shorter: Vector3::splat(0.0) }
            })
            .build()?;
        for engine in engines::all()? {
            let mut simulation = Simulation::new(&model, &*engine, RunOptions { precision, seed: 0 })?;
            simulation.step()?;
            let state = simulation.state();
            let (wrapped, shorter) = (state.read(Place::WRAPPED)?, state.read(Place::SHORTER)?);
            assert!(wrapped.len() > count, "all coordinates are there");
            for (cell, (wrapped, shorter)) in wrapped.iter().zip(&shorter).enumerate() {
                let [before, wrapped, shorter] =
                    [given(cell), *wrapped, *shorter].map(|vector| [vector.x, vector.y, vector.z]);
                let name = format!("{} {precision}: {before:?}", engine.name());
                for axis in 0..2 {
                    let (before, length) = (as_stored(before[axis]), lengths[axis]);
                    // The same place on the torus, up to rounding.
                    let turns = |other: f64| (other - before) / length;
                    for other in [wrapped[axis], shorter[axis]] {
                        let turns = turns(other);
                        assert!((turns - turns.round()).abs() < 8.0 * epsilon, "{name}: {other}");
                    }
                    // In the cells of the space, by the arithmetic of the run.
                    let number = match precision {
                        Precision::F32 => f64::from((wrapped[axis] as f32 / SIDE as f32).floor()),
                        Precision::F64 => (wrapped[axis] / SIDE).floor(),
                    };
                    if (-length..2.0 * length).contains(&before) {
                        assert!((0.0..EXTENTS[axis] as f64).contains(&number), "{name}: {}", wrapped[axis]);
                        let is_in = (0.0..length).contains(&before) && before / length < 1.0 - 4.0 * epsilon;
                        assert!(!is_in || wrapped[axis] == before, "{name}: {}", wrapped[axis]);
                    }
                    if before.abs() <= 1.5 * length {
                        let half = length / 2.0 * (1.0 + 4.0 * epsilon);
                        assert!(shorter[axis].abs() <= half, "{name}: {}", shorter[axis]);
                    }
                }
                assert_eq!([wrapped[2], shorter[2]], [as_stored(before[2]); 2], "{name}");
            }
        }
    }
    Ok(())
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Atom {
    #[position]
    position: Vector3<Real>,
    velocity: Vector3<Real>,
    force: Vector3<Real>,
}

#[elementary_process]
fn repel(me: &mut Slot<Atom>, space: &Space) {
    me.force = Vector3::splat(0.0);
    for other in me.others_within(space.side()) {
        let apart = space.nearest_image(me.position - other.position);
        let distance = apart.length();
        me.force = me.force + apart * ((space.side() - distance) / distance);
    }
}

#[elementary_process]
fn fly(me: &mut Slot<Atom>, space: &Space) {
    me.velocity = me.velocity + me.force * 0.02;
    me.position = space.wrapped(me.position + me.velocity * 0.02);
}

#[migration]
fn follow(me: &Slot<Atom>, space: &Space) -> Destination {
    space.cell_containing(me.position)
}

/// Atoms in a cube of this many cells each way.
const CUBE: usize = 4;
const ATOMS: usize = 60;

fn atom(number: usize) -> ([f64; 3], [f64; 3]) {
    let length = CUBE as f64 * SIDE;
    let place =
        [0.754_877_666, 0.569_840_291, 0.430_159_709].map(|step| (step * number as f64).fract() * length);
    let velocity = [0.31, 0.77, 0.53].map(|step| 2.0 * (step * number as f64).fract() - 1.0);
    (place, velocity)
}

/// The same gas in an endless space: each atom meets all images of all others.
fn among_images(steps: usize) -> Vec<[f64; 3]> {
    let (mut places, mut velocities): (Vec<_>, Vec<_>) = (0..ATOMS).map(atom).unzip();
    let length = CUBE as f64 * SIDE;
    for _ in 0..steps {
        let force_on = |own: usize| {
            let mut force = [0.0; 3];
            for other in (0..ATOMS).filter(|other| *other != own) {
                for image in 0..27_i32 {
                    let shift = [image % 3 - 1, image / 3 % 3 - 1, image / 9 - 1];
                    let apart: [f64; 3] = std::array::from_fn(|axis| {
                        let turns = ((places[own][axis] - places[other][axis]) / length).round();
                        places[own][axis] - places[other][axis] - (turns + f64::from(shift[axis])) * length
                    });
                    let distance = apart.iter().map(|lane| lane * lane).sum::<f64>().sqrt();
                    if distance < SIDE {
                        (0..3).for_each(|axis| force[axis] += apart[axis] * (SIDE - distance) / distance);
                    }
                }
            }
            force
        };
        let forces: Vec<[f64; 3]> = (0..ATOMS).map(force_on).collect();
        for (atom, force) in forces.iter().enumerate() {
            for axis in 0..3 {
                velocities[atom][axis] += force[axis] * 0.02;
                // Never brought in again.
                places[atom][axis] += velocities[atom][axis] * 0.02;
            }
        }
    }
    places
}

#[test]
fn a_gas_on_a_torus_is_one_among_its_images() -> Result<(), Box<dyn Error>> {
    const STEPS: usize = 200;
    let length = CUBE as f64 * SIDE;
    let model = Model::builder("gas")
        .extents([CUBE; 3])
        .cell_side(SIDE)
        .boundary(Boundary::Toroidal)
        .neighbourhood(Neighbourhood::moore(1))
        .population::<Atom>(12)
        .process(repel)
        .process(fly)
        .process(follow)
        .initialise(|state| {
            let item = |number: usize| {
                let (place, velocity) = atom(number);
                let vector = |[x, y, z]: [f64; 3]| Vector3::new(x, y, z);
                Item {
                    label: number as u32,
                    cell: place.map(|along| (along / SIDE) as usize),
                    state: Atom {
                        position: vector(place),
                        velocity: vector(velocity),
                        force: Vector3::splat(0.0),
                    },
                }
            };
            Ok(state.set_items((0..ATOMS).map(item).collect())?)
        })
        .build()?;
    let wanted = among_images(STEPS);
    let crossed = wanted.iter().flatten().filter(|along| !(0.0..length).contains(*along)).count();
    assert!(crossed > 20, "{crossed} have crossed a face");
    for precision in PRECISIONS {
        let mut first = None;
        for engine in engines::all()? {
            let mut simulation = Simulation::new(&model, &*engine, RunOptions { precision, seed: 0 })?;
            simulation.run(STEPS as u64)?;
            let mut items = simulation.state().items::<Atom>()?;
            items.sort_by_key(|item| item.label);
            for (item, wanted) in items.iter().zip(&wanted) {
                let Vector3 { x, y, z } = item.state.position;
                for (along, wanted) in [x, y, z].into_iter().zip(wanted) {
                    assert!((0.0..=length).contains(&along));
                    let turns = (along - wanted) / length;
                    let apart = (turns - turns.round()).abs();
                    let within = if precision == Precision::F64 { 1e-10 } else { 1e-2 };
                    assert!(apart < within, "{} {precision}: {} {apart}", engine.name(), item.label);
                }
            }
            let snapshot = simulation.snapshot()?;
            let first = first.get_or_insert_with(|| snapshot.clone());
            assert!(*first == snapshot, "{} {precision}", engine.name());
        }
    }
    Ok(())
}
