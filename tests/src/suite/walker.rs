//! Elementary processes over items, and between items and their cells, from which random models are put
//! together.

use super::lattice::{Terrain, mix};
use super::medium::{Medium, Tuning, bounded};
use xca_core::prelude::*;

/// The fault that [`stumble`] reports.
pub const STUMBLED: u32 = 22;

/// An item.
#[derive(Substates, Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "they mean nothing")]
pub struct Walker {
    #[position]
    pub position: Vector3<Real>,
    pub velocity: Vector3<Real>,
    pub mass: Real,
    pub kind: u8,
    pub seen: u32,
    pub load: i32,
    pub warmth: f64,
    pub memory: [u32; 3],
    pub speeds: [Vector3<Real>; 2],
    pub terrain: Terrain,
    pub awake: bool,
}

/// A search within a radius; writes in place what is not read of others.
#[elementary_process]
pub fn attract(me: &mut Slot<Walker>, p: &Tuning) {
    for other in me.others_within(p.radius) {
        me.velocity += (other.position - me.position) * (0.01 * other.mass);
        me.seen = mix(me.seen, other.label());
    }
}

/// Writes a substate that is read of others.
#[elementary_process]
pub fn share(me: &mut Slot<Walker>, p: &Tuning) {
    let mut count = 1.0;
    let mut sum = me.mass;
    for other in me.others() {
        if other.kind == me.kind {
            sum += other.mass;
            count += 1.0;
        }
    }
    me.mass = me.mass * p.rate + (1.0 - p.rate) * (sum / count);
}

/// Two searches of which one is inside the other, and two substates that are read of others and written.
#[elementary_process]
pub fn remember(me: &mut Slot<Walker>, p: &Tuning) {
    let mut steps = 0;
    for other in me.others_in_neighbours() {
        me.load = me.load.wrapping_mul(31).wrapping_add(other.load);
        for near in me.others_in_cell_within(p.radius) {
            if near.label() > other.label() {
                me.seen = mix(me.seen, near.seen);
            }
        }
        steps += 1;
        if steps > 12 {
            break;
        }
    }
}

/// The item that was here first.
#[elementary_process]
pub fn follow_first(me: &mut Slot<Walker>, p: &Tuning) {
    for other in me.others_in_cell() {
        me.velocity += (other.velocity - me.velocity) * (0.5 * p.rate);
        break;
    }
    for other in me.others_in_neighbours_within(p.radius) {
        me.warmth += (other.warmth - me.warmth) * 0.125;
    }
}

/// An item and its cell's substates.
#[elementary_process]
pub fn feel(me: &mut Slot<Walker>, cell: &Cell<Medium>, space: &Space) {
    me.kind = (cell.life % 3) as u8;
    me.load = me.load ^ cell.charge ^ space.step() as i32;
    me.warmth = me.warmth * 0.5 + cell.energy * 0.25 + cell.heat as f64;
    me.velocity += Vector3::new(0.001, 0.0, -0.001) * bounded(cell.level, 10.0);
}

/// A cell and its items' substates.
#[elementary_process]
pub fn weigh(cell: &mut Cell<Medium>, slots: &Slots<Walker>) {
    let mut total = 0.0;
    let mut kinds = 0;
    for item in slots {
        total += item.mass;
        kinds |= 1 << (item.kind as u32 % 8);
        cell.bits = mix(cell.bits, item.label());
    }
    cell.level = bounded(total - cell.level * 0.5, 100.0);
    cell.life = kinds as u8;
}

/// A cell, its items and its neighbours.
#[elementary_process]
pub fn crowd(cell: &mut Cell<Medium>, slots: &Slots<Walker>) {
    let mut count = 0;
    for item in slots {
        count += 1;
        cell.flow += item.velocity * 0.01;
    }
    for n in 1..cell.neighbour_count() {
        count += cell.neighbour(n).pair.x & 3;
    }
    cell.pair.x = count;
}

/// The coordinate on a torus, where there is one.
#[helper]
fn wrapped(coordinate: Real, period: Real, torus: i32) -> Real {
    if torus == 1 && coordinate >= period {
        return coordinate - period;
    }
    // A number that is a little below zero may become the period itself, which is no longer inside.
    if torus == 1 && coordinate < 0.0 {
        return if coordinate + period >= period { 0.0 } else { coordinate + period };
    }
    coordinate
}

/// The next position, with random numbers of items.
#[elementary_process]
pub fn walk(me: &mut Slot<Walker>, p: &Tuning, space: &Space) {
    let push = Vector3::new(me.random(0) - 0.5, me.random(1) - 0.5, me.random(2) - 0.5);
    me.velocity = me.velocity * 0.75 + push + p.drift * 0.25;
    let most = p.pace * space.side();
    let extents = space.extents();
    me.position.x += bounded(me.velocity.x, most);
    me.position.y += bounded(me.velocity.y, most);
    me.position.z += bounded(me.velocity.z, most);
    me.position.x = wrapped(me.position.x, extents.x as Real * space.side(), p.torus.x);
    me.position.y = wrapped(me.position.y, extents.y as Real * space.side(), p.torus.y);
    me.position.z = wrapped(me.position.z, extents.z as Real * space.side(), p.torus.z);
}

/// To the cell of the position.
#[migration]
pub fn settle(me: &Slot<Walker>, space: &Space) -> Destination {
    space.cell_containing(me.position)
}

/// Some stay wherever they are, some go for good.
#[migration]
pub fn wander(me: &Slot<Walker>, p: &Tuning, space: &Space) -> Destination {
    if me.kind == 2 {
        return Destination::Stay;
    }
    if me.random_bits(p.salt as usize) % 16 == 0 {
        return Destination::Outside;
    }
    space.cell_containing(me.position)
}

/// Reports a fault, rarely.
#[elementary_process]
pub fn stumble(me: &mut Slot<Walker>, p: &Tuning) {
    me.seen = me.seen ^ me.random_bits(1);
    if p.rarity > 0 && me.random_bits(p.salt as usize) % p.rarity == 0 {
        me.fault(STUMBLED, me.mass);
    }
}

/// Arrays and states of others, and of the item itself, written where they are read.
#[elementary_process]
pub fn recall(me: &mut Slot<Walker>, p: &Tuning) {
    for other in me.others_within(p.radius) {
        me.memory[(other.label() % 3) as usize] = mix(other.memory[2], other.memory[0]);
        if other.awake && other.terrain != me.terrain {
            me.speeds[1] += other.speeds[0] * 0.125;
        }
    }
    me.speeds[0] = me.velocity;
    me.awake = me.memory[1] & 1 == 1;
    me.velocity += me.speeds[1] * (0.01 * p.weights[2]);
}

/// An item and its cell's arrays and states.
#[elementary_process]
pub fn look_down(me: &mut Slot<Walker>, cell: &Cell<Medium>, p: &Tuning) {
    me.terrain = if cell.wet { p.turns_to } else { cell.terrain };
    me.memory[0] = me.memory[0] ^ cell.long[(me.seen % 11) as usize] as u32;
    me.awake = me.awake != cell.marks[me.terrain as usize];
    me.warmth = me.warmth * 0.5 + cell.flows[1] as f64;
}

/// A cell and its items' arrays and states.
#[elementary_process]
pub fn listen(cell: &mut Cell<Medium>, slots: &Slots<Walker>) {
    for item in slots {
        cell.paths[0].y = cell.paths[0].y ^ item.memory[1] as i32;
        if item.awake {
            cell.terrain = item.terrain;
        }
        cell.flows[2] = bounded(cell.flows[2] + item.speeds[0].x, 50.0);
    }
}

/// An element of the item's memory that may lie beyond it.
#[elementary_process]
pub fn forget(me: &mut Slot<Walker>, p: &Tuning) {
    let k = mix(me.seen, p.salt) % (3 + p.greed);
    me.memory[k as usize] = 0;
    me.load = me.load / (me.memory[2] as i32 % 3 + 3);
}
