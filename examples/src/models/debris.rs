//! A debris flow over hexagons that tears soil from its bed: SCIDDICA-S3hex (D'Ambrosio, Di Gregorio and
//! Iovine, Natural Hazards and Earth System Sciences 3, 2003).

use crate::models::flows::{check_thickness, shares};
use xca_core::prelude::*;

/// The sides of a hexagon.
const SIDES: usize = 6;

/// A slope.
#[derive(Substates, Clone, Copy, Debug)]
pub struct Slope {
    /// Of the bed, soil included.
    #[substate(unit = "m")]
    pub altitude: Real,
    /// Soil that can be eroded.
    #[substate(unit = "m")]
    pub soil: Real,
    /// Steps until the soil breaks loose by itself; 0 where it does not.
    pub breaks_loose: u32,
    /// Of debris.
    #[substate(unit = "m")]
    pub thickness: Real,
    /// Thickness times run-up: the momentum of the debris.
    #[substate(unit = "m2")]
    pub momentum: Real,
    /// Thickness that leaves for each neighbour.
    #[substate(unit = "m")]
    pub debris: [Real; SIDES],
    /// Momentum that leaves for each neighbour.
    #[substate(unit = "m2")]
    pub carried: [Real; SIDES],
    /// False beyond the map: nothing flows there.
    pub is_ground: bool,
}

/// What debris is like.
#[derive(Parameters, Clone, Copy, Debug)]
pub struct Debris {
    /// Thickness of what sticks to the ground.
    #[parameter(unit = "m", range = 0.0..)]
    pub adherence: Real,
    /// Run-up that debris loses in a step.
    #[parameter(unit = "m", range = 0.0..)]
    pub run_up_loss: Real,
    /// The part of the flow that a step moves.
    #[parameter(range = 0.0..=1.0)]
    pub relaxation: Real,
    /// Difference of heights that friction holds.
    #[parameter(unit = "m", range = 0.0..)]
    pub friction: Real,
    /// Momentum above which debris erodes.
    #[parameter(unit = "m2", range = 0.0..)]
    pub mobilisation: Real,
    /// Depth of erosion for each momentum.
    #[parameter(unit = "1/m", range = 0.0..)]
    pub erosion: Real,
}

impl Default for Debris {
    fn default() -> Self {
        Self {
            adherence: 0.01,
            run_up_loss: 0.6,
            relaxation: 0.99,
            friction: 0.1,
            mobilisation: 3.5,
            erosion: 0.015,
        }
    }
}

/// Soil breaks loose by itself, or is torn away by debris with enough momentum.
#[elementary_process]
pub fn erode(cell: &mut Cell<Slope>, p: &Debris) {
    let mut depth = 0.0;
    if cell.breaks_loose == 1 {
        depth = cell.soil;
    } else if cell.momentum > p.mobilisation {
        depth = cell.soil.min(cell.momentum * p.erosion);
    }
    if cell.breaks_loose > 0 {
        cell.breaks_loose -= 1;
    }
    if depth > 0.0 {
        let mut run_up = depth;
        if cell.thickness > 0.0 {
            run_up += cell.momentum / cell.thickness;
        }
        cell.altitude -= depth;
        cell.soil -= depth;
        cell.thickness += depth;
        cell.momentum = cell.thickness * run_up;
    }
}

/// Debris and momentum that leave for each neighbour.
#[elementary_process]
pub fn flow(cell: &mut Cell<Slope>, p: &Debris) {
    for n in 0..SIDES {
        cell.debris[n] = 0.0;
        cell.carried[n] = 0.0;
    }
    if cell.thickness <= p.adherence {
        return;
    }
    let run_up = cell.momentum / cell.thickness;
    let head = cell.altitude + run_up;
    let mut heights = [cell.altitude; SIDES + 1];
    let mut takes_part = [true; SIDES + 1];
    for n in 1..cell.neighbour_count() {
        heights[n] = cell.neighbour(n).altitude + cell.neighbour(n).thickness;
        takes_part[n] = cell.neighbour(n).is_ground && head - heights[n] >= p.friction;
    }
    let out = shares::<7>(heights, takes_part, run_up);
    for n in 1..cell.neighbour_count() {
        let debris = cell.thickness * out[n] / run_up * p.relaxation;
        cell.debris[n - 1] = debris;
        cell.carried[n - 1] = (head - heights[n]) * debris;
    }
}

/// What leaves and what comes.
#[elementary_process]
pub fn settle(cell: &mut Cell<Slope>) {
    let mut run_up = 0.0;
    if cell.thickness > 0.0 {
        run_up = cell.momentum / cell.thickness;
    }
    for n in 1..cell.neighbour_count() {
        let from = cell.opposite(n) - 1;
        let gone = cell.debris[n - 1];
        cell.thickness += cell.neighbour(n).debris[from] - gone;
        cell.momentum += cell.neighbour(n).carried[from] - run_up * gone;
    }
}

/// Friction takes run-up; a column keeps that of its own thickness.
#[elementary_process]
pub fn lose(cell: &mut Cell<Slope>, p: &Debris) {
    if cell.thickness > p.adherence {
        let run_up = cell.momentum / cell.thickness - p.run_up_loss;
        cell.momentum = cell.thickness * run_up.max(cell.thickness);
    }
}

/// A slope of hexagons with a corner up, which begins as the function says. Nothing leaves the map.
///
/// # Errors
/// Where a parameter is out of its range.
pub fn model(
    extents: [usize; 2],
    side: f64,
    debris: Debris,
    begin: impl Fn(Site) -> Slope + Send + Sync + 'static,
) -> Result<Model, ModelError> {
    Model::builder("debris")
        .extents([extents[0], extents[1], 1])
        .cell_side(side)
        .neighbourhood(Neighbourhood::hexagonal(Hexagons::CornerUp))
        .substates::<Slope>()
        .parameters(debris)
        .process((erode, flow, settle, lose))
        .fill(begin)
        .steer(Schedule::At(vec![0]), |state| check_thickness(state, Slope::THICKNESS))
        .build()
}

impl Slope {
    /// Rock at altitude 0.
    pub fn bare() -> Self {
        Self {
            altitude: 0.0,
            soil: 0.0,
            breaks_loose: 0,
            thickness: 0.0,
            momentum: 0.0,
            debris: [0.0; SIDES],
            carried: [0.0; SIDES],
            is_ground: true,
        }
    }
}
