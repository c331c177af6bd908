//! Loops over the others in a cell that want some of these only. Loops over all pairs in plain Rust give the
//! expected results.

use std::error::Error;
use xca_core::prelude::*;
use xca_cpu::Cpu;

type TestResult = Result<(), Box<dyn Error>>;

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Grain {
    #[position]
    position: Vector3<Real>,
    velocity: Vector3<Real>,
    weight: Real,
    chosen: u32,
    picked: u32,
}

/// Does nothing for a grain without the wanted others.
#[elementary_process]
fn choose(me: &mut Slot<Grain>) {
    for other in me.others_in_cell_within(0.2) {
        me.chosen = me.chosen.wrapping_mul(67).wrapping_add(other.label());
    }
    for other in me.others_in_cell() {
        if other.weight > 0.8 && me.weight < other.weight {
            me.chosen = me.chosen.wrapping_mul(71).wrapping_add(other.label());
        }
    }
    for other in me.others_in_cell() {
        if other.weight >= 0.1 || other.velocity.x > 0.0 {
            continue;
        }
        me.chosen = me.chosen.wrapping_mul(73).wrapping_add(other.label());
    }
}

/// Always does something.
#[elementary_process]
fn pick(me: &mut Slot<Grain>) {
    me.picked = me.picked.wrapping_add(3);
    for other in me.others_in_cell() {
        if !(other.weight < 0.7) {
            me.picked = me.picked.wrapping_mul(79).wrapping_add(other.label());
        } else {
            me.picked = me.picked.wrapping_add(1);
        }
    }
    for other in me.others_in_cell() {
        if other.weight < 0.3 {
            me.picked = me.picked.wrapping_mul(83).wrapping_add(other.label());
        }
        me.picked = me.picked.wrapping_add(1);
    }
    for other in me.others_in_cell() {
        if other.weight < 0.05 {
            me.picked = me.picked.wrapping_mul(89).wrapping_add(other.label());
        }
    }
    for other in me.others_in_cell() {
        if other.weight > 0.9 || me.weight > 0.9 {
            me.picked = me.picked.wrapping_mul(97).wrapping_add(other.label());
        }
    }
    for other in me.others_in_cell() {
        if me.weight < 0.5 {
            continue;
        }
        me.picked = me.picked.wrapping_add(other.label());
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

/// The grain after [`choose`] and [`pick`], with the others in its cell sorted by label.
fn expected(me: &Item<Grain>, others: &[&Item<Grain>]) -> (u32, u32) {
    let Grain { position, weight, mut chosen, mut picked, .. } = me.state;
    let mut add = |factor: u32, wanted: &dyn Fn(&Grain) -> bool| {
        for other in others.iter().filter(|other| wanted(&other.state)) {
            chosen = chosen.wrapping_mul(factor).wrapping_add(other.label);
        }
    };
    add(67, &|other| (position - other.position).length() < 0.2);
    add(71, &|other| other.weight > 0.8 && weight < other.weight);
    add(73, &|other| other.weight < 0.1 && other.velocity.x <= 0.0);
    picked = picked.wrapping_add(3);
    for other in others {
        picked = match other.state.weight {
            weight if weight >= 0.7 => picked.wrapping_mul(79).wrapping_add(other.label),
            _ => picked.wrapping_add(1),
        };
    }
    for other in others {
        if other.state.weight < 0.3 {
            picked = picked.wrapping_mul(83).wrapping_add(other.label);
        }
        picked = picked.wrapping_add(1);
    }
    for other in others.iter().filter(|other| other.state.weight < 0.05) {
        picked = picked.wrapping_mul(89).wrapping_add(other.label);
    }
    for other in others.iter().filter(|other| other.state.weight > 0.9 || weight > 0.9) {
        picked = picked.wrapping_mul(97).wrapping_add(other.label);
    }
    for other in others.iter().filter(|_| weight >= 0.5) {
        picked = picked.wrapping_add(other.label);
    }
    (chosen, picked)
}

const EXTENTS: [usize; 3] = [7, 6, 5];

/// A number from 0 to 1, from `label` and `which`.
fn number(label: u32, which: u32) -> f64 {
    let mixed = (label * 8 + which + 1).wrapping_mul(0x9e37_79b1);
    f64::from((mixed ^ (mixed >> 15)).wrapping_mul(0x846c_a68b) >> 8) / f64::from(1 << 24)
}

fn grain(label: u32) -> Item<Grain> {
    let place = [0, 1, 2].map(|axis| number(label, axis) * EXTENTS[axis as usize] as f64);
    let [x, y, z] = place;
    let [u, v, w] = [3, 4, 5].map(|which| 0.1 * (number(label, which) - 0.5));
    let state = Grain {
        position: Vector3::new(x, y, z),
        velocity: Vector3::new(u, v, w),
        weight: number(label, 6),
        chosen: 0,
        picked: 0,
    };
    Item { label, cell: place.map(|place| place as usize), state }
}

/// From few grains in a cell to many, of which some are wanted.
#[test]
fn loops_that_want_some_others_do_what_plain_loops_do() -> TestResult {
    for count in [2, 90, 900] {
        let model = Model::builder("grains")
            .extents(EXTENTS)
            .neighbourhood(Neighbourhood::moore(1))
            .boundaries([Boundary::Toroidal; 3])
            .population::<Grain>(100)
            .process((choose, pick, fly, settle))
            .initialise(move |state| Ok(state.set_items((0..count).map(grain).collect())?))
            .build()?;
        let engines: [&dyn Engine; 3] = [&Reference, &Cpu::with_threads(1)?, &Cpu::with_threads(2)?];
        for engine in engines {
            let mut simulation = Simulation::new(&model, engine, RunOptions::default())?;
            for _ in 0..12 {
                let before = simulation.state().items::<Grain>()?;
                simulation.step()?;
                let mut after = simulation.state().items::<Grain>()?;
                after.sort_by_key(|item| item.label);
                for item in &before {
                    let in_cell = before.iter().filter(|other| other.cell == item.cell);
                    let mut others: Vec<_> = in_cell.filter(|other| other.label != item.label).collect();
                    others.sort_by_key(|other| other.label);
                    let state = after[item.label as usize].state;
                    assert_eq!((state.chosen, state.picked), expected(item, &others), "{item:?}");
                }
            }
        }
    }
    Ok(())
}
