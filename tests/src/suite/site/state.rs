//! The state of a cell, what its substates hold, and the faults.

use crate::suite::lattice::{NOWHERE, Terrain, mix};
use xca_core::prelude::*;

/// The fault of a cell that is told other indices than its own.
pub const WRONG_INDEX: u32 = 1;
/// The fault of a cell with a neighbourhood of another size.
pub const WRONG_SIZE: u32 = 2;
/// The fault of a cell whose own state is not as it must be.
pub const WRONG_SELF: u32 = 3;
/// The fault of a cell that finds another cell in the place of a neighbour; the value is the neighbour's
/// number.
pub const WRONG_PLACE: u32 = 4;
/// The fault of a cell whose neighbour's state is not as it must be; the value is the neighbour's number.
pub const WRONG_NEIGHBOUR: u32 = 5;
/// The fault of a cell that is told another step.
pub const WRONG_STEP: u32 = 6;
/// The fault of a cell that is told another displacement of a neighbour; the value is the neighbour's number.
pub const WRONG_DISPLACEMENT: u32 = 7;
/// The fault of a cell that is told wrongly whether a neighbour exists; the value is the neighbour's number.
pub const WRONG_EXISTENCE: u32 = 8;
/// The fault of a cell that is told another opposite of a neighbour; the value is the neighbour's number.
pub const WRONG_OPPOSITE: u32 = 9;

/// The state of a cell: one substate of each kind.
#[derive(Substates, Clone, Copy, Debug, PartialEq)]
pub struct Site {
    /// The cell's own indices; no process writes them.
    pub place: Vector3<i32>,
    /// Written by three processes, in each of the ways that there are.
    pub stamp: u32,
    /// Written by [`third`](super::third).
    pub tag: u8,
    /// Written by [`third`](super::third), which reads it at neighbours too.
    pub count: i32,
    /// Written by [`first`](super::first).
    pub single: f32,
    /// Written by [`first`](super::first).
    pub double: f64,
    /// Written by [`second`](super::second).
    pub level: Real,
    /// Written by [`second`](super::second).
    pub flow: Vector3<Real>,
    /// Written by [`fourth`](super::fourth).
    pub pair: Vector2<f32>,
    /// Written by [`fifth`](super::fifth); the steps done.
    pub steps: Vector4<u32>,
    /// Written by [`first`](super::first), which reads it at neighbours too.
    pub table: [i32; 4],
    /// Written by [`second`](super::second) in place, element by element.
    pub paths: [Vector2<Real>; 2],
    /// Written by [`third`](super::third), which reads it at neighbours too.
    pub terrain: Terrain,
    /// Written by [`third`](super::third) as a whole.
    pub wet: [bool; 2],
    /// Written by [`second`](super::second).
    pub dry: bool,
    /// Written by [`fourth`](super::fourth), one element of many.
    pub terrains: [Terrain; 9],
}

/// What a cell holds after a process, in 32 bits from which all its substates are made. Beyond a face it is
/// always the same.
#[helper]
pub fn mark(place: Vector3<i32>, step: u32, process: u32) -> u32 {
    if place.x == NOWHERE {
        return mix(0x0BAD_CAFE, place.y as u32);
    }
    let place = mix(mix(place.x as u32, place.y as u32), place.z as u32);
    mix(mix(place, step), process)
}

/// A number with a fraction, exact in every type.
#[helper]
pub fn single_of(mark: u32) -> f32 {
    (mark & 0xFFFF) as f32 * 0.25
}

/// As [`single_of`].
#[helper]
pub fn double_of(mark: u32) -> f64 {
    (mark & 0xF_FFFF) as f64 * 0.125
}

/// As [`single_of`], with a sign.
#[helper]
pub fn real_of(mark: u32) -> Real {
    (mark & 0xFFFF) as Real * 0.5 - 1024.0
}

/// An element of a table.
#[helper]
pub fn entry_of(mark: u32, element: u32) -> i32 {
    mix(mark, element) as i32
}

/// The element that [`fourth`](super::fourth) writes.
#[helper]
pub fn turn_of(step: u32) -> u32 {
    step % 9
}

/// Whether two places are the same.
#[helper]
pub fn same_place(a: Vector3<i32>, b: Vector3<i32>) -> bool {
    a.x == b.x && a.y == b.y && a.z == b.z
}
