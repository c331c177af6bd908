//! SCIDDICA-T in its simplest form: debris that runs down a slope, cell by cell.
//!
//! Debris above a layer that sticks to the ground can move. The minimisation of differences shares it with
//! the four neighbours, and a step moves a part of that.

use super::flows::{check_thickness, shares};
use xca_core::prelude::*;

/// The sides of a cell.
const SIDES: usize = 4;

/// Ground, and debris on it.
#[derive(Substates, Clone, Copy, Debug)]
pub struct Slope {
    /// Of the ground below the debris.
    #[substate(unit = "m")]
    pub altitude: Real,
    /// Of the debris.
    #[substate(unit = "m")]
    pub thickness: Real,
    /// Thickness that leaves for each neighbour.
    #[substate(unit = "m")]
    pub outflow: [Real; SIDES],
    /// False beyond the map, and where it has no value: nothing flows there.
    pub is_ground: bool,
}

impl Slope {
    /// Ground at height 0, without debris.
    pub fn bare() -> Self {
        Self { altitude: 0.0, thickness: 0.0, outflow: [0.0; SIDES], is_ground: true }
    }
}

/// How debris moves.
#[derive(Parameters, Clone, Copy, Debug)]
pub struct Debris {
    /// Thickness of what sticks to the ground.
    #[parameter(unit = "m", range = 0.0..)]
    pub adherence: Real,
    /// The part of the flow that a step moves.
    #[parameter(range = 0.0..=1.0)]
    pub rate: Real,
}

#[elementary_process]
fn flow(cell: &mut Cell<Slope>, p: &Debris) {
    for n in 0..SIDES {
        cell.outflow[n] = 0.0;
    }
    let mobile = cell.thickness - p.adherence;
    if mobile <= 0.0 {
        return;
    }
    let mut heights = [cell.altitude + p.adherence; SIDES + 1];
    let mut takes_part = [true; SIDES + 1];
    for n in 1..cell.neighbour_count() {
        heights[n] = cell.neighbour(n).altitude + cell.neighbour(n).thickness;
        takes_part[n] = cell.neighbour(n).is_ground;
    }
    let out = shares::<{ SIDES + 1 }>(heights, takes_part, mobile);
    for n in 1..cell.neighbour_count() {
        cell.outflow[n - 1] = p.rate * out[n];
    }
}

#[elementary_process]
fn settle(cell: &mut Cell<Slope>) {
    let mut gone = 0.0;
    let mut come = 0.0;
    for n in 1..cell.neighbour_count() {
        gone += cell.outflow[n - 1];
        come += cell.neighbour(n).outflow[cell.opposite(n) - 1];
    }
    cell.thickness += come - gone;
}

/// Debris on the slope that `begin` tells, in cells of `side` metres. A thickness below 0 is refused at step
/// 0. Nothing stops the model.
pub fn builder(
    [columns, rows]: [usize; 2],
    side: f64,
    debris: Debris,
    begin: impl Fn(Site) -> Slope + Send + Sync + 'static,
) -> ModelBuilder {
    Model::builder("landslide")
        .extents([columns, rows, 1])
        .cell_side(side)
        .neighbourhood(Neighbourhood::von_neumann_2d(1))
        .boundary(Boundary::Flat)
        .substates::<Slope>()
        .parameters(debris)
        .process((flow, settle))
        .fill(begin)
        .steer(Schedule::At(vec![0]), |state| check_thickness(state, Slope::THICKNESS))
}
