//! The self-checking population.
//!
//! Every item knows where it must be and, from [`path`](super::path), which other items every search must
//! find and in which order. What it holds after each process is a function of its label, the step and the
//! process, so that it can verify the substates of all others too. Items rest, go on and go back, across
//! toroidal faces and out through flat ones.

use super::lattice::{Lattice, Shape, Terrain, linear, mix, neighbour_place, terrain_of};
use super::path::{
    ALL, follow, follow_cell, follow_neighbours, is_taken, label_of, motion, place_of, quarters_of, residents,
};
use std::collections::HashMap;
use xca_core::prelude::*;

/// The fault of an item that is not in the cell where it must be.
pub const WRONG_CELL: u32 = 11;
/// The fault of an item whose own state is not as it must be.
pub const WRONG_SELF: u32 = 12;
/// The fault of an item that a search shows other items, or in another order; the value is the number of the
/// search.
pub const WRONG_OTHERS: u32 = 13;
/// The fault of an item that another's state is not as it must be.
pub const WRONG_STATE: u32 = 14;
/// The fault of an item that finds its cell's state not as it must be, and of a cell that finds a neighbour's
/// so.
pub const WRONG_GROUND: u32 = 15;
/// The fault of a cell that holds other items than it must.
pub const WRONG_CONTENT: u32 = 16;

/// An item.
#[derive(Substates, Clone, Copy, Debug, PartialEq)]
pub struct Traveller {
    /// Where it is.
    #[position]
    pub position: Vector3<Real>,
    /// Where it started; no process writes it.
    pub home: Vector3<i32>,
    /// Its class; no process writes it.
    pub class: u8,
    /// Written by [`meet`], which reads it of others too, by [`rest`] and by [`look_ahead`].
    pub stamp: u32,
    /// Written by [`look_around`].
    pub weight: f64,
    /// Written by [`meet`], which reads it of others too.
    pub memory: [u32; 3],
    /// Written by [`look_around`].
    pub terrain: Terrain,
    /// Written by [`look_around`], which reads it of others too.
    pub awake: [bool; 2],
}

/// What belongs to a cell.
#[derive(Substates, Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// What [`follow`] gives of the cell's items.
    pub content: u32,
}

/// What an item holds after a process.
#[helper]
fn mark(label: u32, step: u32, process: u32) -> u32 {
    mix(mix(label, step), process)
}

/// Everything that an item can see without a radius.
#[elementary_process]
pub fn meet(me: &mut Slot<Traveller>, p: &Lattice, space: &Space) {
    let here = me.index();
    let step = space.step();
    let extents = space.extents();
    let label = me.label();
    let quarters = quarters_of(p, label, extents, step);
    if quarters.x >> 2 != here.x || quarters.y >> 2 != here.y || quarters.z >> 2 != here.z {
        me.fault(WRONG_CELL, label as Real);
    }
    if label != label_of(linear(me.home, extents), me.class as u32, extents.x * extents.y * extents.z) {
        me.fault(WRONG_SELF, label as Real);
    }
    let quarter = 0.25 * space.side();
    let place = Vector3::new(quarters.x as Real, quarters.y as Real, quarters.z as Real) * quarter;
    if me.position.x != place.x || me.position.y != place.y || me.position.z != place.z {
        me.fault(WRONG_SELF, me.position.x);
    }
    if me.stamp != mark(label, step, 0) || me.weight != (mark(label, step.wrapping_sub(1), 2) & 0xFFFF) as f64
    {
        me.fault(WRONG_SELF, 1.0);
    }
    // Written first: others must be seen as they were all the same.
    me.stamp = mark(label, step, 1);
    me.memory[(step % 3) as usize] = me.stamp;
    let mut found = 0;
    for other in me.others() {
        found = follow(found, other.label());
        if other.stamp != mark(other.label(), step, 0) || other.class != (other.label() % 3) as u8 {
            me.fault(WRONG_STATE, other.label() as Real);
        }
        let last = step.wrapping_sub(1);
        let all = other.memory;
        if step > 1
            && (other.memory[(last % 3) as usize] != mark(other.label(), last, 1)
                || all[(step % 3) as usize] != 0)
        {
            me.fault(WRONG_STATE, other.label() as Real);
        }
    }
    me.memory[((step + 1) % 3) as usize] = 0;
    let mut in_cell = 0;
    for other in me.others_in_cell() {
        in_cell = follow(in_cell, other.label());
    }
    let mut in_neighbours = 0;
    for other in me.others_in_neighbours() {
        in_neighbours = follow(in_neighbours, other.label());
    }
    let wanted = follow_cell(p, 0, label, here, extents, step, ALL);
    if in_cell != wanted {
        me.fault(WRONG_OTHERS, 1.0);
    }
    if found != follow_neighbours(p, wanted, label, here, extents, step, ALL) {
        me.fault(WRONG_OTHERS, 2.0);
    }
    if in_neighbours != follow_neighbours(p, 0, label, here, extents, step, ALL) {
        me.fault(WRONG_OTHERS, 3.0);
    }
}

/// Everything that an item can see within a radius.
#[elementary_process]
pub fn look_around(me: &mut Slot<Traveller>, p: &Lattice, space: &Space) {
    let here = me.index();
    let step = space.step();
    let extents = space.extents();
    let label = me.label();
    let mut in_cell = 0;
    for other in me.others_in_cell_within(p.radius) {
        in_cell = follow(in_cell, other.label());
    }
    let mut found = 0;
    // Where the neighbourhood covers nothing, only a radius of nothing is allowed beyond the own cell.
    let far = if p.covered == 1 { p.radius } else { 0.0 };
    for other in me.others_within(far) {
        found = follow(found, other.label());
        if other.stamp != mark(other.label(), step, 1) {
            me.fault(WRONG_STATE, other.label() as Real);
        }
        let last = mark(other.label(), step.wrapping_sub(1), 2);
        let terrain: Terrain = terrain_of(last);
        if other.terrain != terrain || other.awake != [last & 1 == 1, last & 2 == 2] {
            me.fault(WRONG_STATE, other.label() as Real);
        }
        let quarters = quarters_of(p, other.label(), extents, step);
        if other.position.x != quarters.x as Real * (0.25 * space.side()) {
            me.fault(WRONG_STATE, other.position.x);
        }
    }
    let mut in_neighbours = 0;
    for other in me.others_in_neighbours_within(far) {
        in_neighbours = follow(in_neighbours, other.label());
    }
    let wanted = follow_cell(p, 0, label, here, extents, step, step);
    if in_cell != wanted {
        me.fault(WRONG_OTHERS, 4.0);
    }
    if p.covered == 0 && (found != 0 || in_neighbours != 0) {
        me.fault(WRONG_OTHERS, 8.0);
    }
    if p.covered == 1 && found != follow_neighbours(p, wanted, label, here, extents, step, step) {
        me.fault(WRONG_OTHERS, 5.0);
    }
    if p.covered == 1 && in_neighbours != follow_neighbours(p, 0, label, here, extents, step, step) {
        me.fault(WRONG_OTHERS, 6.0);
    }
    let now = mark(label, step, 2);
    me.weight = (now & 0xFFFF) as f64;
    let terrain: Terrain = terrain_of(now);
    me.terrain = terrain;
    me.awake[0] = now & 1 == 1;
    me.awake[1] = now & 2 == 2;
}

/// The same when all have moved but none has changed its cell: a search goes by the cells of now and the
/// positions of now.
#[elementary_process]
pub fn look_ahead(me: &mut Slot<Traveller>, p: &Lattice, space: &Space) {
    let here = me.index();
    let step = space.step();
    let extents = space.extents();
    let label = me.label();
    let mut found = 0;
    let far = if p.covered == 1 { p.radius } else { 0.0 };
    for other in me.others_within(far) {
        found = follow(found, other.label());
        if other.weight != (mark(other.label(), step, 2) & 0xFFFF) as f64 {
            me.fault(WRONG_STATE, other.label() as Real);
        }
    }
    let wanted = follow_cell(p, 0, label, here, extents, step, step + 1);
    if p.covered == 1 && found != follow_neighbours(p, wanted, label, here, extents, step, step + 1) {
        me.fault(WRONG_OTHERS, 7.0);
    }
    me.stamp = mark(label, step + 1, 0);
}

/// What a cell must hold after this number of steps.
#[helper]
fn content_of(p: &Lattice, here: Vector3<i32>, extents: Vector3<i32>, step: u32) -> u32 {
    let labels = residents(p, here, extents, step);
    follow(follow(follow(0, labels.x), labels.y), labels.z)
}

/// What a cell holds, and what its neighbours held in the step before.
#[elementary_process]
pub fn take_stock(cell: &mut Cell<Ground>, slots: &Slots<Traveller>, p: &Lattice, space: &Space) {
    let here = cell.index();
    let step = space.step();
    let extents = space.extents();
    cell.content = 0;
    for item in slots {
        cell.content = follow(cell.content, item.label());
        if item.stamp != mark(item.label(), step, 1) {
            cell.fault(WRONG_CONTENT, item.label() as Real);
        }
    }
    if cell.content != content_of(p, here, extents, step) {
        cell.fault(WRONG_CONTENT, -1.0);
    }
    for n in 0..cell.neighbour_count() {
        let there = neighbour_place(p, here, extents, n);
        let wanted = if there.x < 0 || step == 0 { 0 } else { content_of(p, there, extents, step - 1) };
        if cell.neighbour(n).content != wanted {
            cell.fault(WRONG_GROUND, n as Real);
        }
    }
}

/// What the cell says of its items.
#[elementary_process]
pub fn rest(me: &mut Slot<Traveller>, cell: &Cell<Ground>, p: &Lattice, space: &Space) {
    if cell.content != content_of(p, me.index(), space.extents(), space.step()) {
        me.fault(WRONG_GROUND, cell.content as Real);
    }
    me.stamp = mark(me.label(), space.step(), 3);
}

/// The coordinate on a torus.
#[helper]
fn wrapped(coordinate: Real, period: Real, boundary: i32) -> Real {
    if boundary == 1 && coordinate >= period {
        return coordinate - period;
    }
    if boundary == 1 && coordinate < 0.0 {
        return coordinate + period;
    }
    coordinate
}

/// The next position.
#[elementary_process]
pub fn travel(me: &mut Slot<Traveller>, p: &Lattice, space: &Space) {
    let quarters = motion(p, me.class as u32);
    let quarter = 0.25 * space.side();
    let extents = space.extents();
    me.position += Vector3::new(quarters.x as Real, quarters.y as Real, quarters.z as Real) * quarter;
    me.position.x = wrapped(me.position.x, extents.x as Real * space.side(), p.low.x);
    me.position.y = wrapped(me.position.y, extents.y as Real * space.side(), p.low.y);
    me.position.z = wrapped(me.position.z, extents.z as Real * space.side(), p.low.z);
}

/// To the cell of the position.
#[migration]
pub fn arrive(me: &Slot<Traveller>, space: &Space) -> Destination {
    space.cell_containing(me.position)
}

/// The side of a cell: a power of two, so that quarters of it are exact.
pub const SIDE: f64 = 0.5;

/// The items at the start. They are given in the order of labels, not of cells.
pub fn at_start(p: &Lattice, extents: [usize; 3]) -> Vec<Item<Traveller>> {
    let extents = Vector3::new(extents[0] as i32, extents[1] as i32, extents[2] as i32);
    let cells = extents.x * extents.y * extents.z;
    let mut items = Vec::new();
    for (number, class) in (0..cells).flat_map(|number| (0..3).map(move |class| (number, class))) {
        if !is_taken(p, number, class) {
            continue;
        }
        let home = place_of(number, extents);
        let label = label_of(number, class, cells);
        let [x, y, z] = [home.x, home.y, home.z].map(|index| (f64::from(index) + 0.5) * SIDE);
        let state = Traveller {
            position: Vector3::new(x, y, z),
            home,
            class: class as u8,
            stamp: mark(label, 0, 0),
            weight: f64::from(mark(label, u32::MAX, 2) & 0xFFFF),
            memory: [0; 3],
            terrain: terrain_of(mark(label, u32::MAX, 2)),
            awake: [1, 2].map(|bit| mark(label, u32::MAX, 2) & bit == bit),
        };
        items.push(Item { label, cell: [home.x as usize, home.y as usize, home.z as usize], state });
    }
    items.sort_by_key(|item| item.label);
    items
}

/// How many items there are after this number of steps and how many the fullest cell has, found by following
/// each item.
pub fn present(p: &Lattice, extents: [usize; 3], step: u32) -> (usize, u32) {
    let whole = Vector3::new(extents[0] as i32, extents[1] as i32, extents[2] as i32);
    let mut counts = HashMap::new();
    for item in at_start(p, extents) {
        let quarters = quarters_of(p, item.label, whole, step);
        let cell = [quarters.x >> 2, quarters.y >> 2, quarters.z >> 2];
        if cell.iter().zip(extents).all(|(index, extent)| (0..extent as i32).contains(index)) {
            *counts.entry(cell).or_insert(0) += 1;
        }
    }
    (counts.values().sum::<u32>() as usize, counts.into_values().max().unwrap_or(0))
}

/// Compares what the engine counts with what there must be.
fn count(p: &Lattice, extents: [usize; 3], state: &State<'_>) -> Result<(), SteeringError> {
    let (items, most) = present(p, extents, state.step() as u32);
    let found = (state.count_items::<Traveller>()?, state.largest_occupancy::<Traveller>()?);
    if found != (items, most) {
        return Err(format!("{found:?} items and most in a cell, not {:?}", (items, most)).into());
    }
    let left = (at_start(p, extents).len() - items) as u64;
    if state.count_left::<Traveller>()? != left {
        return Err(format!("{} items left, not {left}", state.count_left::<Traveller>()?).into());
    }
    Ok(())
}

/// The population in a space.
///
/// # Errors
/// Where the neighbourhood and the boundaries do not fit the extents.
pub fn model(
    shape: Shape,
    extents: [usize; 3],
    boundaries: [Boundary; 3],
    p: Lattice,
) -> Result<Model, ModelError> {
    Model::builder(format!("travellers, {shape:?}, {extents:?}, {boundaries:?}, {p:?}"))
        .extents(extents)
        .cell_side(SIDE)
        .neighbourhood(shape.neighbourhood())
        .boundaries(boundaries)
        .parameters(p)
        .population::<Traveller>(3)
        .items_may_leave::<Traveller>()
        .substates::<Ground>()
        .process(meet)
        .process(look_around)
        .process(take_stock)
        .process(rest)
        .process(travel)
        .process(look_ahead)
        .process(arrive)
        .initialise(move |state| Ok(state.set_items(at_start(&p, extents))?))
        .steer(Schedule::Every(1), move |state| count(&p, extents, state))
        .build()
}
