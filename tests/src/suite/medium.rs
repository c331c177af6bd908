//! Elementary processes over cells from which random models are put together: each uses the engine in another
//! way.
//!
//! Their values stay bounded, so that no run ends in infinities that hide differences.

use super::lattice::{Terrain, mix, terrain_of};
use xca_core::prelude::*;

/// The fault that [`tire`] reports.
pub const TIRED: u32 = 21;

/// The state of a cell, with each type of substate.
#[derive(Substates, Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "they mean nothing")]
pub struct Medium {
    pub life: u8,
    pub charge: i32,
    pub bits: u32,
    pub heat: f32,
    pub energy: f64,
    pub level: Real,
    pub flow: Vector3<Real>,
    pub pair: Vector2<i32>,
    pub blend: Vector4<f32>,
    pub terrain: Terrain,
    pub wet: bool,
    pub flows: [Real; 3],
    pub paths: [Vector2<i32>; 2],
    pub marks: [bool; 4],
    pub long: [u8; 11],
}

/// What the processes are told, those over items too.
#[derive(Parameters, Clone, Copy, Debug, PartialEq)]
pub struct Tuning {
    /// A weight between 0 and 1.
    pub rate: Real,
    /// The radius of searches, in metres.
    pub radius: Real,
    /// How far an item goes in a step at most, in cells.
    pub pace: Real,
    /// A constant push.
    pub drift: Vector3<Real>,
    /// Mixed into what is drawn.
    pub salt: u32,
    /// One draw in so many is a fault; 0 for never.
    pub rarity: u32,
    /// How far beyond the neighbourhood a cell looks at most. Where it is 0, searches stay within what is
    /// covered.
    pub greed: u32,
    /// 1 for each toroidal axis, else 0.
    pub torus: Vector3<i32>,
    /// A weight for each element.
    pub weights: [Real; 3],
    /// Whether it rains.
    pub rains: bool,
    /// What soil turns into.
    pub turns_to: Terrain,
    /// Which marks count.
    pub counts: [bool; 4],
}

/// A number of this size or smaller.
#[helper]
pub fn bounded(value: Real, size: Real) -> Real {
    value.max(-size).min(size)
}

/// Counts neighbours: an integer that is read elsewhere and written.
#[elementary_process]
pub fn breed(cell: &mut Cell<Medium>) {
    let mut count = 0;
    for n in 1..cell.neighbour_count() {
        count += (cell.neighbour(n).life & 1) as u32;
    }
    cell.life = match count {
        0 => cell.life / 2,
        1..=2 => cell.life,
        3 if cell.life < 9 => 201,
        _ => (count % 7) as u8,
    };
}

/// Relaxes a floating substate, each neighbour with another weight.
#[elementary_process]
pub fn relax(cell: &mut Cell<Medium>, p: &Tuning) {
    let mut sum = 0.0;
    let mut weights = 0.0;
    for n in 0..cell.neighbour_count() {
        let weight = 1.0 / (n as Real + 3.0);
        sum += weight * cell.neighbour(n).level;
        weights += weight;
    }
    cell.level += p.rate * (sum / weights - cell.level);
}

/// Two integer substates, both read elsewhere and written.
#[elementary_process]
pub fn trade(cell: &mut Cell<Medium>) {
    let mut given = 0;
    for n in 1..cell.neighbour_count() {
        let other = cell.neighbour(n);
        given = given ^ other.charge.wrapping_mul(n as i32 + 5);
        cell.pair.x = cell.pair.x.wrapping_add(other.pair.y);
    }
    cell.pair.y = cell.pair.x ^ cell.neighbour(0).pair.y;
    cell.charge = cell.charge.wrapping_sub(given >> 3);
}

/// In place, with random numbers: nothing is read elsewhere.
#[elementary_process]
pub fn shake(cell: &mut Cell<Medium>, p: &Tuning, space: &Space) {
    let here = cell.index();
    cell.bits = mix(cell.bits ^ p.salt, cell.random_bits(space.step() as usize + 1));
    cell.level = bounded(cell.level + p.rate * (cell.random(0) - 0.5), 100.0);
    if (here.x + here.y * 2 + here.z * 3) % 4 == 1 {
        cell.heat = cell.random(7) as f32;
    }
}

/// Reads one substate elsewhere and writes others in place, without a look at their old values.
#[elementary_process]
pub fn slope(cell: &mut Cell<Medium>) {
    let last = cell.neighbour_count() - 1;
    let first = cell.neighbour(0).level;
    let difference = cell.neighbour(last).level - first;
    cell.heat = difference as f32;
    cell.energy = difference as f64 * 0.1 + 3.0;
}

/// Reads several substates elsewhere; writes a vector that is read elsewhere too.
#[elementary_process]
pub fn swirl(cell: &mut Cell<Medium>, p: &Tuning) {
    let mut turned = Vector3::splat(0.0);
    for n in 1..cell.neighbour_count() {
        let other = cell.neighbour(n);
        turned += other.flow.cross(p.drift) * 0.25 + other.flow * (other.level * 0.001);
        if other.life > 100 {
            continue;
        }
        turned.x += other.heat as Real * 0.01;
    }
    let length = turned.length() + 1.0;
    cell.flow = cell.flow * p.rate + turned * (1.0 / length);
    cell.level = bounded(cell.level + cell.flow.dot(p.drift), 100.0);
}

/// A chain of substates in place: may run together with its neighbours in the order of processes.
#[elementary_process]
pub fn settle_down(cell: &mut Cell<Medium>) {
    let mut rest = cell.energy;
    let mut turns = 0;
    while rest > 0.5 && turns < 6 {
        rest *= 0.5;
        turns += 1;
    }
    cell.energy = rest.max(-10.0).min(10.0);
    cell.blend.x += turns as f32 * 0.125 - cell.blend.x * 0.5;
    cell.blend.w = cell.heat.abs().sqrt();
    cell.charge = cell.charge.wrapping_add(turns);
}

/// Four lanes, read elsewhere and written lane by lane.
#[elementary_process]
pub fn blend(cell: &mut Cell<Medium>) {
    for n in 1..cell.neighbour_count() {
        let other = cell.neighbour(n);
        if other.blend.y > cell.blend.z {
            cell.blend.z = other.blend.x * 0.5 + 0.25;
        } else {
            cell.blend.y = (cell.blend.y + other.blend.w * 0.5).min(8.0);
        }
    }
}

/// Tired cells report a fault, rarely; all others write first.
#[elementary_process]
pub fn tire(cell: &mut Cell<Medium>, p: &Tuning) {
    cell.bits = cell.bits.wrapping_add(1);
    if p.rarity > 0 && cell.random_bits(p.salt as usize) % p.rarity == 0 {
        cell.fault(TIRED, cell.level);
        return;
    }
    cell.life = cell.life ^ 3;
}

/// Looks at one neighbour that its own state names, perhaps beyond the neighbourhood.
#[elementary_process]
pub fn peek(cell: &mut Cell<Medium>, p: &Tuning) {
    let n = mix(cell.bits, p.salt) as usize % (cell.neighbour_count() + p.greed as usize);
    cell.pair.x = cell.neighbour(n).charge;
    cell.energy = cell.neighbour(n).energy * 0.5;
}

/// An array that is read elsewhere and written, element by element and as a whole.
#[elementary_process]
pub fn percolate(cell: &mut Cell<Medium>, p: &Tuning) {
    let mut sum = 0.0;
    for n in 1..cell.neighbour_count() {
        let other = cell.neighbour(n);
        for k in 0..3 {
            sum += p.weights[k] * other.flows[2 - k];
        }
        if other.terrain == Terrain::Water && n % 3 == 1 {
            cell.flows = other.flows;
        }
    }
    cell.flows[(cell.bits % 3) as usize] = bounded(sum * 0.25, 50.0);
    if cell.flows == cell.neighbour(0).flows {
        cell.wet = !cell.wet;
    }
}

/// States by neighbours, in a match without a rest.
#[elementary_process]
pub fn erode(cell: &mut Cell<Medium>, p: &Tuning) {
    let mut waters = 0;
    for n in 1..cell.neighbour_count() {
        if cell.neighbour(n).terrain == Terrain::Water || cell.neighbour(n).wet {
            waters += 1;
        }
    }
    cell.terrain = match cell.terrain {
        Terrain::Rock if waters > 2 => Terrain::Soil,
        Terrain::Rock => Terrain::Rock,
        Terrain::Soil => {
            if p.rains {
                p.turns_to
            } else {
                Terrain::Rock
            }
        }
        Terrain::Water => terrain_of(waters),
    };
    cell.wet = cell.wet != p.rains;
}

/// Arrays in place: of vectors, of truth values and a long one.
#[elementary_process]
pub fn mark_paths(cell: &mut Cell<Medium>, p: &Tuning) {
    let turn = (cell.bits >> 3) & 1;
    cell.paths[turn as usize].x = cell.paths[1 - turn as usize].y.wrapping_add(cell.charge);
    cell.paths[1] = Vector2::new(cell.paths[0].y, cell.paths[1].x / (1 + turn as i32));
    let mut counted = 0;
    for k in 0..4 {
        cell.marks[k] = cell.marks[k] != p.counts[k];
        if cell.marks[3 - k] {
            counted += 1;
        }
    }
    for k in 0..11 {
        cell.long[k] = cell.long[10 - k].wrapping_add(counted);
    }
    cell.marks[cell.terrain as usize] = p.counts == cell.marks;
}

/// Elements that the own state names, perhaps beyond the array, at neighbours too; and a division that may
/// have no result.
#[elementary_process]
pub fn overreach(cell: &mut Cell<Medium>, p: &Tuning) {
    let k = mix(cell.bits, p.salt + 3) % (11 + p.greed);
    let beyond = k / 11;
    cell.life = cell.long[k as usize];
    if cell.neighbour_count() > 1 {
        cell.level = bounded(cell.neighbour(1).flows[(2 * beyond + k % 2) as usize], 100.0);
    }
    if p.greed > 0 && cell.bits % 7 == 0 {
        cell.charge = cell.charge / (cell.bits as i32 % 5);
    } else {
        cell.charge = cell.charge % (k as i32 + 1);
    }
}
