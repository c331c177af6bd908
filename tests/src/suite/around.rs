//! What a cell of the self-checking automaton is told of where its neighbours lie.
//!
//! The words are asked in several orders: in loops over all neighbours, up and down, and one by one by
//! numbers that chance makes.

use super::lattice::{Lattice, NOWHERE, displacement, mix, neighbour_place, opposite};
use super::site::{Site, WRONG_DISPLACEMENT, WRONG_EXISTENCE, WRONG_OPPOSITE, same_place};
use xca_core::prelude::*;

/// Displacements, and whether there are cells.
#[elementary_process]
pub fn look_around(cell: &mut Cell<Site>, p: &Lattice, space: &Space) {
    let here = cell.index();
    for n in 0..cell.neighbour_count() {
        let there = neighbour_place(p, here, space.extents(), n);
        if !same_place(cell.displacement(n), displacement(p.shape, n, here)) {
            cell.fault(WRONG_DISPLACEMENT, n as Real);
        }
        if cell.exists(n) != (there.x != NOWHERE) || cell.exists(n) != (cell.neighbour(n).place.x != NOWHERE)
        {
            cell.fault(WRONG_EXISTENCE, n as Real);
        }
    }
    let m = mix(cell.stamp, space.step()) as usize % cell.neighbour_count();
    if cell.displacement(m).z != displacement(p.shape, m, here).z {
        cell.fault(WRONG_DISPLACEMENT, m as Real);
    }
    if cell.exists(m) != (neighbour_place(p, here, space.extents(), m).x != NOWHERE) {
        cell.fault(WRONG_EXISTENCE, m as Real);
    }
}

/// Opposites.
#[elementary_process]
pub fn turn_round(cell: &mut Cell<Site>, p: &Lattice, space: &Space) {
    let here = cell.index();
    let mut n = cell.neighbour_count();
    while n > 0 {
        n -= 1;
        if cell.opposite(cell.opposite(n)) != n {
            cell.fault(WRONG_OPPOSITE, n as Real);
        }
    }
    for n in 0..cell.neighbour_count() {
        // The way there and, with the number that the neighbour has for it, back.
        let way = cell.displacement(n);
        let back = displacement(p.shape, cell.opposite(n), here + way + Vector3::splat(2));
        if !same_place(back, -way) {
            cell.fault(WRONG_OPPOSITE, n as Real);
        }
    }
    let m = mix(cell.stamp, space.step()) as usize % cell.neighbour_count();
    if cell.opposite(m) != opposite(p, m, here) {
        cell.fault(WRONG_OPPOSITE, m as Real);
    }
}
