//! Models put together from what chance says.

use super::cover::covered;
use super::lattice::{Terrain, mix, terrain_of};
use super::medium::{self, Medium, Tuning};
use super::reduced;
use super::sky::{self, Sky, Weather, weather_of};
use super::walker::{self, Walker};
use xca_core::prelude::*;
use xca_core::{ModelBuilder, Parity};

/// Everything that makes a random model.
#[derive(Debug, Clone)]
pub struct Recipe {
    /// The number of cells; enlarged where the neighbourhood needs more.
    pub extents: [usize; 3],
    /// Which cells a cell sees.
    pub neighbourhood: Neighbourhood,
    /// What lies beyond the faces; changed where it has no meaning.
    pub boundaries: Faces<Boundary>,
    /// Whether some flat faces have outside values of their own.
    pub outsides: bool,
    /// The side of a cell.
    pub side: f64,
    /// The processes by their numbers, see [`add`].
    pub processes: Vec<usize>,
    /// Whether some processes run every second or third step only.
    pub cadence: bool,
    /// How many items a cell can hold; 0 for a model without items.
    pub slots: usize,
    /// How many items the fullest cells have at the start, if there are as many slots.
    pub crowding: usize,
    /// Whether items start on a grid with three points along each axis of a cell, so that by a radius of a
    /// cell side many of them are exactly as far apart as the radius, and rounding says whether they are
    /// near.
    pub aligned: bool,
    /// What the initial state is made of.
    pub salt: u32,
    /// One cell in so many has a state by chance, the others have none, and beyond the faces is none either:
    /// most processes leave it alone until something reaches it.
    pub calm: Option<u32>,
    /// What the processes are told.
    pub tuning: Tuning,
    /// Whether items may leave the space.
    pub open: bool,
    /// Whether steering changes state and parameters between steps, with all reductions in it.
    pub steered: bool,
}

/// How many processes [`add`] knows.
pub const PROCESSES: usize = 33;

/// Processes that leave nothing as nothing. Some of them are told by items, and move these.
pub const CALM: [usize; 16] = [0, 1, 2, 4, 5, 6, 7, 9, 11, 19, 20, 23, 25, 28, 29, 30];

/// Whether the process with this number needs items.
fn needs_items(number: usize) -> bool {
    matches!(number, 14..=27 | 31..)
}

/// Whether it needs the second struct of cells.
fn needs_sky(number: usize) -> bool {
    number >= 28
}

/// Adds the process with this number, which runs every so many steps.
pub fn add(builder: ModelBuilder, number: usize, every: u64) -> ModelBuilder {
    match number {
        0 => builder.process_every(every, medium::breed),
        1 => builder.process_every(every, medium::relax),
        2 => builder.process_every(every, medium::trade),
        3 => builder.process_every(every, medium::shake),
        4 => builder.process_every(every, medium::slope),
        5 => builder.process_every(every, medium::swirl),
        6 => builder.process_every(every, medium::settle_down),
        7 => builder.process_every(every, medium::blend),
        8 => builder.process_every(every, medium::tire),
        9 => builder.process_every(every, medium::peek),
        10 => builder.process_every(every, medium::percolate),
        11 => builder.process_every(every, medium::erode),
        12 => builder.process_every(every, medium::mark_paths),
        13 => builder.process_every(every, medium::overreach),
        14 => builder.process_every(every, walker::attract),
        15 => builder.process_every(every, walker::share),
        16 => builder.process_every(every, walker::remember),
        17 => builder.process_every(every, walker::follow_first),
        18 => builder.process_every(every, walker::feel),
        19 => builder.process_every(every, walker::weigh),
        20 => builder.process_every(every, walker::crowd),
        21 => builder.process_every(every, walker::recall),
        22 => builder.process_every(every, walker::look_down),
        23 => builder.process_every(every, walker::listen),
        24 => builder.process_every(every, walker::forget),
        // A walk that is not settled ends in a fault soon, so both come together.
        25 => builder.process_every(every, walker::walk).process_every(every, walker::settle),
        26 => builder.process_every(every, walker::walk).process_every(every, walker::wander),
        27 => builder.process_every(every, walker::stumble),
        28 => builder.process_every(every, sky::drift),
        29 => builder.process_every(every, sky::rain),
        30 => builder.repeat(2, (sky::drift, sky::rain)),
        31 => builder.process_every(every, sky::shiver),
        _ => builder.process_every(every, (sky::shelter, sky::drift)),
    }
}

impl Recipe {
    /// The model.
    ///
    /// # Errors
    /// Where [`Self::fit`] has left something that does not fit, which the suites take for a failure.
    pub fn build(&self) -> Result<Model, ModelError> {
        let recipe = self.fit();
        let (extents, side, slots, salt) = (recipe.extents, recipe.side, recipe.slots, recipe.salt);
        let (most, aligned) = (recipe.crowding.min(slots), recipe.aligned);
        let mut builder = Model::builder("random")
            .extents(extents)
            .cell_side(side)
            .neighbourhood(recipe.neighbourhood)
            .boundaries(recipe.boundaries)
            .parameters(recipe.tuning)
            .substates_with_outside(if recipe.calm.is_some() { NOTHING } else { medium_of(mix(salt, 17)) })
            .fill(move |site| {
                let [x, y, z] = site.cell().map(|index| index as u32);
                let salt = mix(mix(mix(salt, x), y), z);
                let is_calm = recipe.calm.is_some_and(|rarity| !mix(salt, 99).is_multiple_of(rarity));
                if is_calm { NOTHING } else { medium_of(salt) }
            });
        let has_sky = recipe.processes.iter().any(|number| needs_sky(*number));
        if has_sky {
            builder = builder.substates::<Sky>().fill(move |site| {
                let [x, y, z] = site.cell().map(|index| index as u32);
                if recipe.calm.is_some() { CLEAR } else { sky_of(mix(mix(mix(salt, z), y), x)) }
            });
        }
        for (face, number) in Face::ALL.into_iter().zip(0..) {
            let is_apart = recipe.outsides && mix(salt, number).is_multiple_of(2);
            if is_apart && recipe.boundaries[face] == Boundary::Flat {
                builder = builder.outside(face, medium_of(mix(salt, 18 + number)));
                if has_sky {
                    builder = builder.outside(face, sky_of(mix(salt, 24 + number)));
                }
            }
        }
        if slots > 0 {
            builder = builder
                .population::<Walker>(slots)
                .initialise(move |state| Ok(state.set_items(walkers(extents, side, most, aligned, salt))?));
            if recipe.open {
                builder = builder.items_may_leave::<Walker>();
            }
        }
        for (&number, place) in recipe.processes.iter().zip(60..) {
            if slots > 0 || !needs_items(number) {
                let every = if recipe.cadence { [1, 1, 2, 3][(mix(salt, place) % 4) as usize] } else { 1 };
                builder = add(builder, number, every);
            }
        }
        if recipe.steered && recipe.calm.is_some() {
            builder = builder.steer(Schedule::Every(3), nudge);
        } else if recipe.steered {
            builder = builder.steer(Schedule::Every(2), steer);
            if slots > 0 {
                builder = builder.steer(Schedule::Every(1), steer_items);
            }
            if has_sky {
                builder = builder.steer(Schedule::EveryFromStart(3), steer_sky);
            }
        }
        builder.build()
    }

    /// The same recipe with extents and boundaries that the neighbourhood allows.
    pub fn fit(&self) -> Self {
        let mut fitted = self.clone();
        let alternating = match self.neighbourhood.parity() {
            Parity::None => None,
            Parity::Row => Some(1),
            Parity::Column => Some(0),
        };
        for (axis, reach) in self.neighbourhood.reach().into_iter().enumerate() {
            let faces = Face::ALONG[axis];
            let mirrors = self.slots == 0 && alternating != Some(axis);
            for face in faces {
                if fitted.boundaries[face] == Boundary::Reflecting && !mirrors {
                    fitted.boundaries[face] = Boundary::Toroidal;
                }
            }
            // A torus has no face.
            let toroidal = faces.map(|face| fitted.boundaries[face]).contains(&Boundary::Toroidal);
            let extent = &mut fitted.extents[axis];
            if toroidal {
                for face in faces {
                    fitted.boundaries[face] = Boundary::Toroidal;
                }
                if reach > 0 {
                    *extent = (*extent).max(2 * reach + 1);
                }
                if alternating == Some(axis) {
                    *extent += *extent % 2;
                }
            } else {
                *extent = (*extent).max(reach);
            }
        }
        let [x, y, z] = Face::ALONG.map(|[low, _]| i32::from(fitted.boundaries[low] == Boundary::Toroidal));
        fitted.tuning.torus = Vector3::new(x, y, z);
        // A search beyond what is covered is a fault, which only the greedy are to meet.
        if self.tuning.greed == 0 {
            let covered = covered(&fitted.neighbourhood, fitted.extents, fitted.boundaries);
            fitted.tuning.radius = fitted.tuning.radius.min(covered * fitted.side);
        }
        fitted
    }
}

/// A fraction of 1 from some bits.
fn fraction(salt: u32, number: u32) -> f64 {
    f64::from(mix(salt, number) >> 8) / 16_777_216.0
}

/// What [`medium::breed`], `relax`, `trade`, `slope`, `swirl`, `settle_down`, `blend`, `peek` and `erode`
/// without rain leave alone.
const NOTHING: Medium = Medium {
    life: 0,
    charge: 0,
    bits: 0,
    heat: 0.0,
    energy: 0.0,
    level: 0.0,
    flow: Vector3 { x: 0.0, y: 0.0, z: 0.0 },
    pair: Vector2 { x: 0, y: 0 },
    blend: Vector4 { x: 0.0, y: 0.0, z: 0.0, w: 0.0 },
    terrain: Terrain::Rock,
    wet: false,
    flows: [0.0; 3],
    paths: [Vector2 { x: 0, y: 0 }; 2],
    marks: [false; 4],
    long: [0; 11],
};

/// The same for the second struct.
const CLEAR: Sky = Sky { cloud: 0.0, drops: [0; 2], weather: Weather::Clear, lit: false };

fn sky_of(salt: u32) -> Sky {
    Sky {
        cloud: fraction(salt, 0) * 8.0 - 4.0,
        drops: [mix(salt, 1), mix(salt, 2)],
        weather: weather_of(mix(salt, 3)),
        lit: mix(salt, 4).is_multiple_of(2),
    }
}

fn medium_of(salt: u32) -> Medium {
    let part = |number| fraction(salt, number) * 2.0 - 1.0;
    Medium {
        life: (mix(salt, 0) % 5) as u8,
        charge: mix(salt, 1) as i32,
        bits: mix(salt, 2),
        heat: part(3) as f32,
        energy: part(4),
        level: part(5),
        flow: Vector3::new(part(6), part(7), part(8)),
        pair: Vector2::new(mix(salt, 9) as i32 >> 4, mix(salt, 10) as i32),
        blend: Vector4::new(part(11) as f32, part(12) as f32, part(13) as f32, 0.5),
        terrain: terrain_of(mix(salt, 14)),
        wet: mix(salt, 15).is_multiple_of(2),
        flows: [16, 17, 18].map(part),
        paths: [19, 20].map(|number| Vector2::new(mix(salt, number) as i32, number as i32)),
        marks: [21, 22, 23, 24].map(|number| mix(salt, number).is_multiple_of(3)),
        long: std::array::from_fn(|element| mix(salt, 25 + element as u32) as u8),
    }
}

/// Items in half of the cells, `most` in some. Their labels are in no order.
fn walkers(extents: [usize; 3], side: f64, most: usize, aligned: bool, salt: u32) -> Vec<Item<Walker>> {
    let mut items = Vec::new();
    for number in 0..extents.iter().product() {
        let cell =
            [number % extents[0], number / extents[0] % extents[1], number / (extents[0] * extents[1])];
        let salt = mix(salt, number as u32);
        let count = match salt % 8 {
            0..=3 => 0,
            4..=6 => most.div_ceil(3),
            _ => most,
        };
        for slot in 0..count {
            let salt = mix(salt, slot as u32);
            let place = |axis: usize| {
                let (first, part) = (cell[axis] as f64, fraction(salt, axis as u32));
                let part = if aligned { ((3.0 * part).floor() + 0.5) / 3.0 } else { 0.98 * part + 0.01 };
                (first + part) * side
            };
            let part = |number| fraction(salt, number) - 0.5;
            let state = Walker {
                position: Vector3::new(place(0), place(1), place(2)),
                velocity: Vector3::new(part(3), part(4), part(5)) * side,
                mass: 1.0 + part(6),
                kind: (salt % 3) as u8,
                seen: salt,
                load: salt as i32,
                warmth: part(7),
                memory: [8, 9, 10].map(|number| mix(salt, number)),
                speeds: [11, 14]
                    .map(|first| Vector3::new(part(first), part(first + 1), part(first + 2)) * side),
                terrain: terrain_of(mix(salt, 17)),
                awake: mix(salt, 18).is_multiple_of(2),
            };
            // Odd multiples of an odd number: all different, and in no order.
            let label = ((number * most + slot) as u32).wrapping_mul(0x9E37_79B1);
            items.push(Item { label, cell, state });
        }
    }
    items
}

/// Single cells, whole substates and parameters change between steps. What all reductions say goes into a
/// cell.
fn steer(state: &mut State<'_>) -> Result<(), SteeringError> {
    let extents = state.geometry().extents();
    let which = state.parameters::<Tuning>()?.salt;
    let reductions = reduced::of_cells(state, which)?;
    state.set(Medium::BITS, [0; 3], reductions)?;
    state.set(Medium::LEVEL, extents.map(|extent| extent - 1), 7.5)?;
    state.set(Medium::LIFE, [0; 3], 1)?;
    let mut charges = state.read(Medium::CHARGE)?;
    charges.reverse();
    state.write(Medium::CHARGE, &charges)?;
    let mut tuning = state.parameters::<Tuning>()?;
    tuning.salt += 1;
    tuning.rate = state.maximum(Medium::LEVEL)?.unwrap_or(0.0).abs().min(0.5);
    state.set_parameters(tuning)?;
    state.set_parameter("drift", "0.125, -0.25, 0.5")?;
    state.set_parameter("weights", "0.25, -0.5, 0.125")?;
    state.set_parameter("turns_to", "Soil")?;
    let rains = !state.get(Medium::WET, [0; 3])?;
    state.set_parameter("rains", if rains { "true" } else { "false" })?;
    let mut flows = state.read(Medium::FLOWS)?;
    flows.rotate_left(1);
    state.write(Medium::FLOWS, &flows)?;
    state.set(Medium::MARKS, [0; 3], [rains, true, false, !rains])?;
    state.set(Medium::TERRAIN, extents.map(|extent| extent - 1), terrain_of(which))?;
    Ok(())
}

/// The second struct changes too, by what a reduction of it says.
fn steer_sky(state: &mut State<'_>) -> Result<(), SteeringError> {
    let extents = state.geometry().extents();
    let which = state.parameters::<Tuning>()?.salt;
    state.set(Sky::WEATHER, [0; 3], weather_of(which))?;
    let storms = state.count_where(|sky: &Sky| sky.weather == Weather::Stormy && sky.cloud > 0.0)?;
    state.set(Sky::DROPS, extents.map(|extent| extent - 1), [storms as u32, which])?;
    Ok(())
}

/// Another cell each time wakes up, or a parameter changes; all else stays as it is.
fn nudge(state: &mut State<'_>) -> Result<(), SteeringError> {
    let extents = state.geometry().extents();
    let mut tuning = state.parameters::<Tuning>()?;
    let turn = state.step() as u32 / 3;
    let cell = [0, 1, 2].map(|axis| mix(mix(tuning.salt, turn), axis as u32) as usize % extents[axis]);
    match turn % 4 {
        0 => state.set(Medium::LIFE, cell, 3)?,
        1 => {
            tuning.rate = 0.75 - tuning.rate;
            state.set_parameters(tuning)?;
        }
        2 => state.set_cells(Medium::LEVEL, [(cell, 4.5)])?,
        _ => state.set(Medium::TERRAIN, cell, Terrain::Water)?,
    }
    Ok(())
}

/// Whole substates of items change, and some items go.
fn steer_items(state: &mut State<'_>) -> Result<(), SteeringError> {
    let which = state.parameters::<Tuning>()?.salt;
    let reductions = reduced::of_items(state, which)?;
    let mut loads = state.read(Walker::LOAD)?;
    let by = loads.len().min(1);
    loads.rotate_right(by);
    if let Some(load) = loads.first_mut() {
        *load = reductions as i32;
    }
    state.write(Walker::LOAD, &loads)?;
    if state.step() == 3 {
        let mut items = state.items::<Walker>()?;
        items.retain(|item| item.label % 4 != 1);
        items.reverse();
        state.set_items(items)?;
    }
    Ok(())
}
