//! Where the items of the self-checking population are at any time, in processes' own words.
//!
//! Each cell has three places at the start, one for each class, some of them taken. Items of class 0 rest;
//! those of class 1 and 2 move by the same distance in every step, the same for the whole class. So whoever
//! knows the step knows all items of any cell: for each class those that started in one certain cell.

use super::lattice::{Lattice, linear, mix, neighbour_place};
use xca_core::prelude::*;

/// In place of a label where there is no item. It sorts last.
pub const ABSENT: u32 = u32::MAX;

/// How a class moves in a step, in quarters of a cell.
#[helper]
pub fn motion(p: &Lattice, class: u32) -> Vector3<i32> {
    match class {
        1 => p.forward,
        2 => p.backward,
        _ => Vector3::splat(0),
    }
}

/// Whether a cell has an item of a class at the start.
#[helper]
pub fn is_taken(p: &Lattice, number: i32, class: u32) -> bool {
    mix(number as u32, class + 77) % 16 < p.density
}

/// The label of the item of a class that starts in the cell with this linear index. Along the rows the labels
/// of the first class ascend, of the second descend, of the third ascend from the middle of the space, so
/// that cells hold them in many orders.
#[helper]
pub fn label_of(number: i32, class: u32, cells: i32) -> u32 {
    let rank = match class {
        0 => number,
        1 => cells - 1 - number,
        _ => (number + cells / 2) % cells,
    };
    3 * rank as u32 + class
}

/// The linear index of the cell where the item with this label starts.
#[helper]
pub fn start_of(label: u32, cells: i32) -> i32 {
    let rank = (label / 3) as i32;
    match label % 3 {
        0 => rank,
        1 => cells - 1 - rank,
        _ => (rank + cells - cells / 2) % cells,
    }
}

/// The indices of a cell.
#[helper]
pub fn place_of(number: i32, extents: Vector3<i32>) -> Vector3<i32> {
    Vector3::new(number % extents.x, number / extents.x % extents.y, number / (extents.x * extents.y))
}

/// How many cells something has gone that started in the middle of a cell and went so many quarters.
#[helper]
pub fn cells_gone(quarters: i32) -> i32 {
    (quarters + 2) >> 2
}

/// Where on one axis something started that is now in the cell `index`; -1 where that is no cell.
#[helper]
fn back(index: i32, gone: i32, extent: i32, boundary: i32) -> i32 {
    let start = index - gone;
    if boundary == 1 {
        return (start % extent + extent) % extent;
    }
    if start >= 0 && start < extent { start } else { -1 }
}

/// The label of the item of a class in a cell, after this number of steps; [`ABSENT`] where there is none.
#[helper]
pub fn resident(p: &Lattice, here: Vector3<i32>, extents: Vector3<i32>, step: u32, class: u32) -> u32 {
    let gone = motion(p, class) * (step as i32);
    let x = back(here.x, cells_gone(gone.x), extents.x, p.low.x);
    let y = back(here.y, cells_gone(gone.y), extents.y, p.low.y);
    let z = back(here.z, cells_gone(gone.z), extents.z, p.low.z);
    if x < 0 || y < 0 || z < 0 {
        return ABSENT;
    }
    let number = linear(Vector3::new(x, y, z), extents);
    if is_taken(p, number, class) {
        label_of(number, class, extents.x * extents.y * extents.z)
    } else {
        ABSENT
    }
}

/// The labels of the items in a cell, the smallest first.
#[helper]
pub fn residents(p: &Lattice, here: Vector3<i32>, extents: Vector3<i32>, step: u32) -> Vector3<u32> {
    let a = resident(p, here, extents, step, 0);
    let b = resident(p, here, extents, step, 1);
    let c = resident(p, here, extents, step, 2);
    let low = a.min(b);
    let high = a.max(b);
    Vector3::new(low.min(c), low.max(high.min(c)), high.max(c))
}

/// Where on one axis an item is after going so many quarters from the middle of a cell, in quarters from the
/// origin.
#[helper]
fn ahead(start: i32, gone: i32, extent: i32, boundary: i32) -> i32 {
    let quarters = 4 * start + 2 + gone;
    let period = 4 * extent;
    if boundary == 1 { (quarters % period + period) % period } else { quarters }
}

/// Where the item with this label is after this number of steps, in quarters of a cell.
#[helper]
pub fn quarters_of(p: &Lattice, label: u32, extents: Vector3<i32>, step: u32) -> Vector3<i32> {
    let start = place_of(start_of(label, extents.x * extents.y * extents.z), extents);
    let gone = motion(p, label % 3) * (step as i32);
    Vector3::new(
        ahead(start.x, gone.x, extents.x, p.low.x),
        ahead(start.y, gone.y, extents.y, p.low.y),
        ahead(start.z, gone.z, extents.z, p.low.z),
    )
}

/// A distance along one axis by the shorter way.
#[helper]
fn shorter(distance: i32, extent: i32, boundary: i32) -> i32 {
    let period = 4 * extent;
    if boundary == 1 && 2 * distance > period {
        return distance - period;
    }
    if boundary == 1 && 2 * distance < -period {
        return distance + period;
    }
    distance
}

/// Whether two items are nearer than the radius of the lattice.
#[helper]
pub fn is_near(p: &Lattice, a: Vector3<i32>, b: Vector3<i32>, extents: Vector3<i32>) -> bool {
    let x = shorter(a.x - b.x, extents.x, p.low.x);
    let y = shorter(a.y - b.y, extents.y, p.low.y);
    let z = shorter(a.z - b.z, extents.z, p.low.z);
    x * x + y * y + z * z < p.quarters * p.quarters
}

/// Follows a list of labels: equal results come from equal lists in equal order.
#[helper]
pub fn follow(list: u32, label: u32) -> u32 {
    if label == ABSENT { list } else { mix(list, label) }
}

/// For [`follow_cell`]: no radius.
pub const ALL: u32 = u32::MAX;

/// Whether an item is to be followed: it is there, it is not `me`, and it is near at this time.
#[helper]
fn is_wanted(p: &Lattice, me: u32, other: u32, extents: Vector3<i32>, time: u32) -> bool {
    if other == ABSENT || other == me {
        return false;
    }
    time == ALL
        || is_near(p, quarters_of(p, me, extents, time), quarters_of(p, other, extents, time), extents)
}

/// What [`follow`] gives of the items that a cell has after this number of steps, without the item `me`, in
/// order of labels; only of those nearer than the radius at the given time, which may be a step ahead.
#[helper]
pub fn follow_cell(
    p: &Lattice,
    list: u32,
    me: u32,
    there: Vector3<i32>,
    extents: Vector3<i32>,
    step: u32,
    time: u32,
) -> u32 {
    if there.x < 0 {
        return list;
    }
    let labels = residents(p, there, extents, step);
    let mut result = list;
    if is_wanted(p, me, labels.x, extents, time) {
        result = mix(result, labels.x);
    }
    if is_wanted(p, me, labels.y, extents, time) {
        result = mix(result, labels.y);
    }
    if is_wanted(p, me, labels.z, extents, time) {
        result = mix(result, labels.z);
    }
    result
}

/// What [`follow`] gives of everything that an item can find in neighbours.
#[helper]
pub fn follow_neighbours(
    p: &Lattice,
    list: u32,
    me: u32,
    here: Vector3<i32>,
    extents: Vector3<i32>,
    step: u32,
    time: u32,
) -> u32 {
    let mut result = list;
    for n in 1..p.neighbours as usize {
        result = follow_cell(p, result, me, neighbour_place(p, here, extents, n), extents, step, time);
    }
    result
}
