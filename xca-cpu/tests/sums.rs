//! Loops over others within a radius that add numbers of pairs. Loops over all pairs in plain Rust give the
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
    kind: u8,
    is_wet: bool,
    moments: [Real; 2],
    force: Vector3<Real>,
    pressure: Real,
    count: u32,
    balance: i32,
    twice: Real,
    chain: Real,
    total: Real,
    warmth: Real,
    filled: Real,
    mean: Vector3<Real>,
    near: u32,
    spread: Real,
    grown: Real,
    hidden: Real,
}

#[derive(Parameters, Clone, Copy, Debug)]
struct Law {
    reach: Real,
    strength: Real,
}

/// The push of another grain; nothing from too far away.
#[helper]
fn push(law: &Law, away: Vector3<Real>, weight: Real) -> Vector3<Real> {
    let distance = away.length();
    if distance >= 0.9 * law.reach {
        return Vector3::splat(0.0);
    }
    away / distance * (law.strength * weight / (distance + 0.1))
}

#[helper]
fn factor(kind: u8) -> Real {
    match kind {
        0 => 0.5,
        1 => 2.0,
        _ => -1.0,
    }
}

#[helper]
fn first_of(moments: [Real; 2]) -> Real {
    moments[0] - moments[1]
}

/// All that begins with loops that only add.
#[elementary_process]
fn press(me: &mut Slot<Grain>, law: &Law, space: &Space) {
    if me.weight < 0.1 {
        return;
    }
    for other in me.others_in_cell_within(law.reach) {
        if other.kind != 2 && me.is_wet {
            let away = space.nearest_image(me.position - other.position);
            me.force += push(law, away, other.weight * factor(other.kind));
            me.pressure -= if other.is_wet { other.weight } else { 0.25 };
        }
    }
    for other in me.others_in_neighbours_within(law.reach) {
        if other.weight < me.weight {
            continue;
        }
        if other.kind == me.kind {
            continue;
        }
        me.force -= push(law, space.nearest_image(other.position - me.position), me.weight);
        me.count += 1;
    }
    if me.kind == 1 {
        return;
    }
    for other in me.others_within(law.reach) {
        let (more, less) = (first_of(other.moments), me.velocity.x);
        me.pressure += more * less;
        me.balance -= other.kind as i32 - 1;
    }
    for other in me.others_in_cell() {
        if other.weight > 0.9 {
            me.pressure *= 0.5;
        }
    }
}

/// Loops that are no plain sums, or come too late.
#[elementary_process]
fn chain(me: &mut Slot<Grain>, law: &Law) {
    for other in me.others_within(law.reach) {
        me.chain += 0.25 * me.chain + other.weight;
    }
    for other in me.others_within(law.reach) {
        me.total += other.weight / (1.0 + me.chain);
    }
}

/// A loop that adds twice to one sum.
#[elementary_process]
fn add_twice(me: &mut Slot<Grain>, law: &Law) {
    for other in me.others_within(law.reach) {
        me.twice += other.weight;
        me.twice += 1e9 * other.velocity.x;
    }
}

/// Adds as long as the sum is small.
#[elementary_process]
fn fill(me: &mut Slot<Grain>, law: &Law) {
    for other in me.others_within(law.reach) {
        if me.filled < 1.5 {
            me.filled += other.weight;
        }
    }
}

/// Reads of others what it writes.
#[elementary_process]
fn warm(me: &mut Slot<Grain>, law: &Law) {
    if me.weight < 0.3 {
        return;
    }
    for other in me.others_within(law.reach) {
        me.warmth += 0.01 * (other.warmth - other.weight);
    }
}

/// Adds to local variables.
#[elementary_process]
fn average(me: &mut Slot<Grain>, law: &Law) {
    if me.weight < 0.2 {
        return;
    }
    let mut flow = Vector3::new(0.0, 0.0, 0.5);
    let mut weight = 1.5;
    let mut count: u32 = 2;
    for other in me.others_within(law.reach) {
        if other.kind != me.kind {
            continue;
        }
        let part = other.velocity * other.weight;
        flow += part;
        weight -= other.weight;
        count += 1;
    }
    if me.kind == 2 {
        return;
    }
    let mut spread: Real = 0.0;
    for other in me.others_in_neighbours_within(law.reach) {
        spread += (other.velocity - me.velocity).length();
        me.near += 1;
    }
    me.near += count;
    me.mean = flow / weight;
    weight *= 0.5;
    me.spread = spread + weight;
}

/// Local variables that are no plain sums: one that is read while it grows, and one that another one hides.
#[elementary_process]
fn grow(me: &mut Slot<Grain>, law: &Law) {
    let mut grown = 1.0;
    let mut hidden = 1.0;
    for other in me.others_within(law.reach) {
        grown += 0.25 * grown + other.weight;
    }
    for other in me.others_within(law.reach) {
        let mut hidden = 0.5;
        hidden += other.weight;
        me.hidden += hidden;
    }
    hidden += grown;
    me.grown = hidden;
}

#[elementary_process]
fn fly(me: &mut Slot<Grain>, space: &Space) {
    me.position = space.wrapped(me.position + me.velocity);
}

/// Also for grains that fly out.
#[migration]
fn settle(me: &Slot<Grain>, space: &Space) -> Destination {
    space.cell_containing(me.position)
}

const EXTENTS: [usize; 3] = [7, 6, 5];
const LAW: Law = Law { reach: 0.45, strength: 0.7 };

/// The distance along each axis, around a torus if that is shorter.
fn shortest(vector: Vector3<f64>, torus: bool) -> Vector3<f64> {
    let [x, y, z] = EXTENTS.map(|extent| extent as f64);
    let along = |distance: f64, length: f64| match torus {
        true if distance > 0.5 * length => distance - length,
        true if distance < -0.5 * length => distance + length,
        _ => distance,
    };
    Vector3::new(along(vector.x, x), along(vector.y, y), along(vector.z, z))
}

/// The place of a cell among the neighbours of another one. `None` if it is none of them.
fn neighbour(here: [usize; 3], there: [usize; 3], torus: bool) -> Option<[i32; 4]> {
    let mut steps = [0; 3];
    for axis in 0..3 {
        let extent = EXTENTS[axis] as i32;
        let step = there[axis] as i32 - here[axis] as i32;
        steps[axis] = match step {
            step if torus && step == extent - 1 => -1,
            step if torus && step == 1 - extent => 1,
            step => step,
        };
    }
    let [x, y, z] = steps;
    let is_near = steps.iter().all(|step| step.abs() <= 1);
    is_near.then_some([i32::from(steps != [0; 3]), z, y, x])
}

/// The grain after all processes but the last two. The others are those of all cells.
fn expected(me: &Item<Grain>, others: &[Item<Grain>], torus: bool) -> Grain {
    let away = |other: &Grain| shortest(me.state.position - other.position, torus);
    let near = others.iter().filter(|other| other.label != me.label).filter_map(|other| {
        let order = (neighbour(me.cell, other.cell, torus)?, other.label);
        (away(&other.state).length_squared() < LAW.reach * LAW.reach).then_some((order, other))
    });
    let mut near: Vec<_> = near.collect();
    near.sort_by_key(|(order, _)| *order);
    let others_near: Vec<&Grain> = near.iter().map(|(_, other)| &other.state).collect();
    let beside = near.iter().filter(|(_, other)| other.cell != me.cell).map(|(_, other)| &other.state);
    let within = near.iter().filter(|(_, other)| other.cell == me.cell).map(|(_, other)| &other.state);
    let mut grain = me.state;
    for other in &others_near {
        grain.twice += other.weight;
        grain.twice += 1e9 * other.velocity.x;
    }
    for other in &others_near {
        grain.chain += 0.25 * grain.chain + other.weight;
    }
    for other in &others_near {
        grain.total += other.weight / (1.0 + grain.chain);
    }
    for other in &others_near {
        if grain.filled < 1.5 {
            grain.filled += other.weight;
        }
    }
    let mut grown = 1.0;
    for other in &others_near {
        grown += 0.25 * grown + other.weight;
        grain.hidden += 0.5 + other.weight;
    }
    grain.grown = 1.0 + grown;
    if grain.weight >= 0.2 && grain.kind != 2 {
        let (mut flow, mut weight, mut count, mut spread) = (Vector3::new(0.0, 0.0, 0.5), 1.5, 2, 0.0);
        for other in others_near.iter().filter(|other| other.kind == grain.kind) {
            flow += other.velocity * other.weight;
            weight -= other.weight;
            count += 1;
        }
        for other in beside.clone() {
            spread += (other.velocity - grain.velocity).length();
            count += 1;
        }
        grain.near += count;
        grain.mean = flow / weight;
        grain.spread = spread + weight * 0.5;
    }
    if grain.weight >= 0.3 {
        others_near.iter().for_each(|other| grain.warmth += 0.01 * (other.warmth - other.weight));
    }
    if grain.weight < 0.1 {
        return grain;
    }
    for other in within.filter(|other| other.kind != 2 && grain.is_wet) {
        let scale = [0.5, 2.0, -1.0][usize::from(other.kind)];
        grain.force += push(&LAW, away(other), other.weight * scale);
        grain.pressure -= if other.is_wet { other.weight } else { 0.25 };
    }
    for other in beside.filter(|other| other.weight >= grain.weight && other.kind != grain.kind) {
        grain.force -= push(&LAW, shortest(other.position - grain.position, torus), grain.weight);
        grain.count += 1;
    }
    if grain.kind == 1 {
        return grain;
    }
    for other in &others_near {
        grain.pressure += (other.moments[0] - other.moments[1]) * grain.velocity.x;
        grain.balance -= i32::from(other.kind) - 1;
    }
    let in_cell = others.iter().filter(|other| other.label != me.label && other.cell == me.cell);
    for _ in in_cell.filter(|other| other.state.weight > 0.9) {
        grain.pressure *= 0.5;
    }
    grain
}

/// A number from 0 to 1, from `label` and `which`.
fn number(label: u32, which: u32) -> f64 {
    let mixed = (label * 16 + which + 1).wrapping_mul(0x9e37_79b1);
    f64::from((mixed ^ (mixed >> 15)).wrapping_mul(0x846c_a68b) >> 8) / f64::from(1 << 24)
}

fn grain(label: u32) -> Item<Grain> {
    let [x, y, z] = [0, 1, 2].map(|axis| number(label, axis) * EXTENTS[axis as usize] as f64);
    let [u, v, w] = [3, 4, 5].map(|which| 0.06 * (number(label, which) - 0.5));
    let state = Grain {
        position: Vector3::new(x, y, z),
        velocity: Vector3::new(u, v, w),
        weight: number(label, 6),
        kind: (number(label, 7) * 3.0) as u8,
        is_wet: number(label, 8) < 0.6,
        moments: [number(label, 9), number(label, 10)],
        force: Vector3::splat(0.0),
        pressure: 0.0,
        count: 0,
        balance: 0,
        twice: 0.0,
        chain: 0.0,
        total: 0.0,
        warmth: number(label, 11),
        filled: 0.0,
        mean: Vector3::splat(0.0),
        near: 0,
        spread: 0.0,
        grown: 0.0,
        hidden: 0.0,
    };
    Item { label, cell: [x, y, z].map(|place| place as usize), state }
}

fn model(count: u32, boundary: Boundary) -> Result<Model, ModelError> {
    let builder = Model::builder("grains")
        .extents(EXTENTS)
        .neighbourhood(Neighbourhood::moore(1))
        .boundaries([boundary; 3])
        .population::<Grain>(100)
        .parameters(LAW)
        .process((press, chain, add_twice, fill, warm))
        .process((average, grow, fly, settle))
        .initialise(move |state| Ok(state.set_items((0..count).map(grain).collect())?));
    if boundary == Boundary::Toroidal { builder.build() } else { builder.items_may_leave::<Grain>().build() }
}

/// From few pairs in a row to many batches, with lists and without.
#[test]
fn sums_are_those_of_plain_loops() -> TestResult {
    for (count, boundary) in [3, 100, 1000, 3000]
        .into_iter()
        .flat_map(|count| [Boundary::Flat, Boundary::Toroidal].map(|boundary| (count, boundary)))
    {
        let model = model(count, boundary)?;
        let engines: [&dyn Engine; 3] = [&Reference, &Cpu::with_threads(1)?, &Cpu::with_threads(2)?];
        for engine in engines {
            let mut simulation = Simulation::new(&model, engine, RunOptions::default())?;
            for step in 0..if count < 3000 { 10 } else { 3 } {
                let before = simulation.state().items::<Grain>()?;
                simulation.step()?;
                let after = simulation.state().items::<Grain>()?;
                for item in &after {
                    let was = before.iter().find(|other| other.label == item.label).ok_or("a new grain")?;
                    let mut wanted = expected(was, &before, boundary == Boundary::Toroidal);
                    wanted.position = item.state.position;
                    assert_eq!(item.state, wanted, "{count} grains, {boundary:?}, step {step}, {was:?}");
                }
            }
        }
    }
    Ok(())
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Token {
    #[position]
    position: Vector3<Real>,
    divisor: u32,
    total: u32,
}

#[helper]
fn ratio(divisor: u32) -> u32 {
    12 / divisor
}

/// Divides by zero beside a token whose divisor is 0.
#[elementary_process]
fn share(me: &mut Slot<Token>) {
    for other in me.others_within(0.3) {
        me.total += ratio(other.divisor);
    }
}

/// Divides by zero nowhere.
#[elementary_process]
fn share_with_care(me: &mut Slot<Token>) {
    for other in me.others_within(0.3) {
        if other.divisor != 0 {
            me.total += ratio(other.divisor);
        }
    }
}

#[test]
fn a_panic_names_the_item_of_the_pair() -> TestResult {
    let token = |label: u32| {
        let x = 0.25 * f64::from(label) + 0.1;
        let state = Token { position: Vector3::new(x, 0.5, 0.5), divisor: u32::from(label != 77), total: 0 };
        Item { label, cell: [x as usize, 0, 0], state }
    };
    let base = || {
        Model::builder("tokens")
            .extents([40, 1, 1])
            .neighbourhood(Neighbourhood::moore(1))
            .population::<Token>(8)
            .initialise(move |state| Ok(state.set_items((0..150).map(token).collect())?))
    };
    let engines: [&dyn Engine; 2] = [&Reference, &Cpu::with_threads(1)?];
    for engine in engines {
        let careful = base().process(share_with_care).build()?;
        let mut simulation = Simulation::new(&careful, engine, RunOptions::default())?;
        simulation.step()?;
        for Item { label, state, .. } in simulation.state().items::<Token>()? {
            let beside = [label.checked_sub(1), Some(label + 1)].into_iter().flatten();
            let wanted = 12 * beside.filter(|other| *other < 150 && *other != 77).count();
            assert_eq!(state.total as usize, wanted, "token {label}");
        }
        let careless = base().process(share).build()?;
        let mut simulation = Simulation::new(&careless, engine, RunOptions::default())?;
        let message = simulation.step().expect_err("a division by zero").to_string();
        let wanted = "panicked for item 76 in cell [19, 0, 0]: attempt to divide by zero";
        assert!(message.contains(wanted), "{message}");
    }
    Ok(())
}
