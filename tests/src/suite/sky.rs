//! A second struct of cells of the random models, and processes that take both, with items too.

use super::lattice::{Terrain, mix};
use super::medium::{Medium, Tuning, bounded};
use super::walker::Walker;
use xca_core::prelude::*;

/// What is above a cell.
#[derive(Substates, Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "they mean nothing")]
pub struct Sky {
    pub cloud: Real,
    pub drops: [u32; 2],
    pub weather: Weather,
    pub lit: bool,
}

/// A state that only [`Sky`] has.
#[derive(States, Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "they mean nothing")]
pub enum Weather {
    Clear,
    Cloudy,
    Stormy,
}

/// The weather that some bits stand for.
pub const fn weather_of(bits: u32) -> Weather {
    match bits % 3 {
        0 => Weather::Clear,
        1 => Weather::Cloudy,
        _ => Weather::Stormy,
    }
}

/// Writes one struct; reads it and another one at neighbours.
#[elementary_process]
pub fn drift(sky: &mut Cell<Sky>, ground: &Cell<Medium>, p: &Tuning) {
    let mut cloud = 0.0;
    let mut storms = 0;
    for n in 1..sky.neighbour_count() {
        let below = ground.neighbour(n);
        cloud += sky.neighbour(n).cloud * p.rate + below.flows[n % 3];
        if sky.neighbour(n).weather == Weather::Stormy || below.terrain == Terrain::Water {
            storms += 1;
        }
        sky.drops[n % 2] = sky.drops[n % 2] ^ sky.neighbour(n).drops[1 - n % 2];
    }
    sky.cloud = bounded(0.5 * sky.cloud + 0.25 * cloud, 40.0);
    sky.weather = match storms {
        0 => Weather::Clear,
        1 => Weather::Cloudy,
        _ => Weather::Stormy,
    };
    sky.lit = ground.wet != (sky.weather == Weather::Cloudy);
}

/// Writes the other struct, with what the first one has become.
#[elementary_process]
pub fn rain(ground: &mut Cell<Medium>, sky: &Cell<Sky>) {
    let last = ground.neighbour_count() - 1;
    if sky.weather == Weather::Stormy {
        ground.level = bounded(ground.level + 0.125 * sky.neighbour(last).cloud, 100.0);
        ground.charge = ground.charge ^ sky.neighbour(0).drops[0] as i32;
    }
    if sky.lit && ground.neighbour(last).level > ground.level {
        ground.wet = sky.neighbour(last).lit;
    }
}

/// An item and both structs of its cell.
#[elementary_process]
pub fn shiver(me: &mut Slot<Walker>, ground: &Cell<Medium>, sky: &Cell<Sky>) {
    me.awake = sky.lit || ground.wet;
    me.seen = mix(me.seen, sky.drops[(me.kind % 2) as usize]);
    me.warmth = 0.5 * me.warmth + 0.25 * bounded(sky.cloud - ground.level, 100.0) as f64;
}

/// A cell, the other struct at neighbours, and its items.
#[elementary_process]
pub fn shelter(sky: &mut Cell<Sky>, ground: &Cell<Medium>, slots: &Slots<Walker>, p: &Tuning) {
    let n = mix(p.salt, sky.drops[0]) as usize % sky.neighbour_count();
    for item in slots {
        sky.drops[1] = mix(sky.drops[1], item.label());
        sky.cloud = bounded(sky.cloud + item.mass * ground.neighbour(n).flow.x, 40.0);
        if item.awake {
            sky.weather = Weather::Cloudy;
        }
    }
}
