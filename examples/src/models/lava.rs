//! Lava that flows down a volcano, cools and becomes rock: SCIARA-fv2 (Spataro, Avolio, Lupiano, Trunfio,
//! Rongo and D'Ambrosio, ICCS 2010).
//!
//! The minimisation of differences shares the lava of a cell with its neighbours, if it is thicker than
//! what the yield strength holds back. Yield strength and flow rate follow from the temperature. Vents give
//! lava at a rate that changes with time.

use crate::models::flows::{check_thickness, shares};
use xca_core::prelude::*;

/// A side or a corner is shared with so many cells.
const NEIGHBOURS: usize = 8;

/// A volcano.
#[derive(Substates, Clone, Copy, Debug)]
pub struct Volcano {
    /// Of the ground and of lava that is solid, in m.
    #[substate(unit = "m")]
    pub altitude: Real,
    /// Of fluid lava, in m.
    #[substate(unit = "m")]
    pub thickness: Real,
    /// Of the lava.
    #[substate(unit = "K")]
    pub temperature: Real,
    /// Of lava that has become solid here, in m.
    #[substate(unit = "m")]
    pub solid: Real,
    /// Thickness that leaves for each neighbour, in m.
    pub outflow: [Real; NEIGHBOURS],
    /// False beyond the map, and where it has no value: nothing flows there.
    pub is_ground: bool,
}

/// What lava is like.
#[derive(Parameters, Clone, Copy, Debug)]
pub struct Lava {
    /// Time of a step.
    #[parameter(unit = "s", positive)]
    pub clock: Real,
    /// Temperature below which lava is solid.
    #[parameter(unit = "K", positive)]
    pub solid_temperature: Real,
    /// Temperature of the lava that vents give.
    #[parameter(unit = "K", positive)]
    pub vent_temperature: Real,
    /// Relaxation rate at the temperature of solidification.
    #[parameter(range = 0.0..=1.0)]
    pub solid_rate: Real,
    /// Relaxation rate at the vent.
    #[parameter(range = 0.0..=1.0)]
    pub vent_rate: Real,
    /// Thickness that the yield strength holds back, at the temperature of solidification.
    #[parameter(unit = "m", positive)]
    pub solid_yield: Real,
    /// The same at the vent.
    #[parameter(unit = "m", positive)]
    pub vent_yield: Real,
    /// Loss of heat by radiation: `3 emissivity sigma clock / (density specific_heat)`, in m / K³ a step.
    #[parameter(unit = "m/K3", range = 0.0..)]
    pub cooling: Real,
}

impl Default for Lava {
    /// Of Etna, steps of a minute.
    fn default() -> Self {
        Self {
            clock: 60.0,
            solid_temperature: 1143.0,
            vent_temperature: 1360.0,
            solid_rate: 0.075,
            vent_rate: 0.9,
            solid_yield: 6.0,
            vent_yield: 0.4,
            cooling: 3.0 * 0.9 * 5.68e-8 * 60.0 / (2600.0 * 1150.0),
        }
    }
}

/// A value between that of solidification and that of the vent, by a power law of the temperature.
#[helper]
fn power_law(solid: Real, vent: Real, temperature: Real, lava: &Lava) -> Real {
    let part = (temperature - lava.solid_temperature) / (lava.vent_temperature - lava.solid_temperature);
    solid * (vent / solid).powf(part)
}

/// What leaves for each neighbour: towards corners, heights count at the distance of a side.
#[elementary_process]
pub fn flow(cell: &mut Cell<Volcano>, lava: &Lava, space: &Space) {
    for n in 0..NEIGHBOURS {
        cell.outflow[n] = 0.0;
    }
    if cell.thickness <= 0.0 {
        return;
    }
    let mut heights = [cell.altitude; NEIGHBOURS + 1];
    let mut takes_part = [true; NEIGHBOURS + 1];
    let mut cosine = [1.0; NEIGHBOURS + 1];
    for n in 1..cell.neighbour_count() {
        let other = cell.neighbour(n);
        let distance = (cell.displacement(n).length_squared() as Real).sqrt();
        heights[n] = cell.altitude - (cell.altitude - other.altitude) / distance + other.thickness;
        let slope = (cell.altitude + cell.thickness - heights[n]) / space.side();
        takes_part[n] = other.is_ground && slope > 0.0;
        cosine[n] = 1.0 / (1.0 + slope * slope).sqrt();
    }
    let rate = power_law(lava.solid_rate, lava.vent_rate, cell.temperature, lava);
    let held_back = power_law(lava.solid_yield, lava.vent_yield, cell.temperature, lava);
    let out = shares::<{ NEIGHBOURS + 1 }>(heights, takes_part, cell.thickness);
    for n in 1..cell.neighbour_count() {
        if cell.thickness > held_back * cosine[n] {
            cell.outflow[n - 1] = rate * out[n];
        }
    }
}

/// Lava that comes brings its heat.
#[elementary_process]
pub fn mix(cell: &mut Cell<Volcano>) {
    let mut rest = cell.thickness;
    let mut come = 0.0;
    let mut heat = 0.0;
    for n in 1..cell.neighbour_count() {
        rest -= cell.outflow[n - 1];
        let inflow = cell.neighbour(n).outflow[cell.opposite(n) - 1];
        come += inflow;
        heat += inflow * cell.neighbour(n).temperature;
    }
    if rest + come > 0.0 {
        cell.temperature = (rest * cell.temperature + heat) / (rest + come);
    }
    cell.thickness = rest + come;
}

/// Lava radiates; what is too cold becomes rock.
#[elementary_process]
pub fn cool(cell: &mut Cell<Volcano>, lava: &Lava) {
    if cell.thickness > 0.0 {
        let temperature = cell.temperature;
        let cubed = temperature * temperature * temperature;
        cell.temperature = temperature / (1.0 + lava.cooling * cubed / cell.thickness).cbrt();
        if cell.temperature <= lava.solid_temperature {
            cell.altitude += cell.thickness;
            cell.solid += cell.thickness;
            cell.thickness = 0.0;
        }
    }
}

/// A vent, with its rates of emission: each holds from its time on.
#[derive(Debug, Clone)]
pub struct Vent {
    /// The indices of its cell.
    pub cell: [usize; 3],
    /// Times in s, rising, with rates in m³/s.
    pub rates: Vec<Rate>,
}

/// How fast a vent gives lava, from a time on.
#[derive(Debug, Clone, Copy)]
pub struct Rate {
    /// The time, in s.
    pub from: f64,
    /// The rate, in m³/s.
    pub volume: f64,
}

impl Vent {
    /// The rate at a time, in m³/s.
    pub fn rate(&self, time: f64) -> f64 {
        self.rates.iter().rev().find(|rate| rate.from <= time).map_or(0.0, |rate| rate.volume)
    }
}

/// The volume that vents have given before a time, in m³, in steps of the clock.
pub fn emitted(vents: &[Vent], clock: f64, steps: u64) -> f64 {
    let step = |step: u64| vents.iter().map(|vent| vent.rate(step as f64 * clock) * clock).sum::<f64>();
    (0..steps).map(step).sum()
}

/// Has the vents give the lava of a step.
fn erupt(state: &mut State<'_>, vents: &[Vent]) -> Result<(), SteeringError> {
    let lava: Lava = state.parameters()?;
    let (side, time) = (state.geometry().side(), state.step() as f64 * lava.clock);
    for vent in vents {
        let come = vent.rate(time) * lava.clock / (side * side);
        let before = state.get(Volcano::THICKNESS, vent.cell)?;
        if come > 0.0 {
            let temperature = state.get(Volcano::TEMPERATURE, vent.cell)?;
            let mixed = (before * temperature + come * lava.vent_temperature) / (before + come);
            state.set(Volcano::TEMPERATURE, vent.cell, mixed)?;
            state.set(Volcano::THICKNESS, vent.cell, before + come)?;
        }
    }
    Ok(())
}

/// A volcano of this ground, in m, with its vents. Nothing leaves the map, nor flows to cells without ground.
///
/// # Errors
/// Where a parameter is out of its range.
pub fn model(
    extents: [usize; 2],
    side: f64,
    lava: Lava,
    vents: Vec<Vent>,
    ground: impl Fn(Site) -> Option<f64> + Send + Sync + 'static,
) -> Result<Model, ModelError> {
    Model::builder("lava")
        .extents([extents[0], extents[1], 1])
        .cell_side(side)
        .neighbourhood(Neighbourhood::moore_2d(1))
        .substates::<Volcano>()
        .parameters(lava)
        .process((flow, mix, cool))
        .fill(move |site| bare(ground(site)))
        .steer(Schedule::At(vec![0]), |state| check_thickness(state, Volcano::THICKNESS))
        .steer(Schedule::EveryFromStart(1), move |state| erupt(state, &vents))
        .build()
}

/// Ground without lava, or no ground.
fn bare(altitude: Option<f64>) -> Volcano {
    Volcano {
        altitude: altitude.unwrap_or(0.0),
        thickness: 0.0,
        temperature: 0.0,
        solid: 0.0,
        outflow: [0.0; NEIGHBOURS],
        is_ground: altitude.is_some(),
    }
}
