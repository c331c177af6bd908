//! What a cell knows of its neighbours, and its random numbers.

use super::state::State;
use crate::common::{accepted, function, written, written_with};
use xca_core::Parity;
use xca_core::prelude::*;
use xca_wgsl::Options;

#[elementary_process]
fn neighbours(cell: &mut Cell<State>) {
    let left = cell.neighbour(1);
    let any = cell.neighbour(cell.unsigned as usize);
    cell.real = left.real + any.velocity.x + cell.neighbour(cell.byte as usize).real;
    if cell.neighbour_count() > 3 {
        cell.signed += cell.neighbour(3).signed;
    }
    if cell.real > 100.0 {
        cell.fault(17, cell.real);
        return;
    }
    cell.velocity = cell.neighbour(0).velocity;
}

#[test]
fn neighbours_beyond_the_neighbourhood_are_faults() {
    accepted::<neighbours>();
    let shader = written::<neighbours>(Precision::F64);
    assert!(shader.source.contains("record_fault(1u, index, space.neighbours, Real());"));
    assert!(shader.source.contains("velocity_next[3u * here + 2u] = cell.velocity.z;"));
}

/// In a hexagonal grid odd rows or columns have neighbours of their own.
#[test]
fn neighbours_by_parity() {
    for (parity, axis) in [(Parity::Row, "y"), (Parity::Column, "x")] {
        let shader = written_with::<neighbours>(&Options {
            parity,
            neighbourhood_size: Some(7),
            ..Options::default()
        });
        let text = function(&shader, "neighbour_at");
        assert!(
            text.contains(&format!("neighbour_offsets[index + (u32(here_index.{axis}) & 1u) * 7u]")),
            "{text}"
        );
    }
}

#[elementary_process]
fn chance(cell: &mut Cell<State>) {
    if cell.random(0) < 0.25 {
        cell.unsigned = cell.random_bits(cell.unsigned as usize + 1);
    }
}

#[test]
fn random_numbers() {
    accepted::<chance>();
}

#[elementary_process]
fn directions_of_neighbours(cell: &mut Cell<State>) {
    for n in 1..cell.neighbour_count() {
        if cell.exists(n) {
            cell.unsigned += cell.opposite(n) as u32;
        }
    }
    cell.signed = cell.displacement(directions::von_neumann::UP).z;
    cell.signed += cell.displacement(cell.unsigned as usize).x;
}

/// A number that may lie beyond the neighbourhood is checked; one from a loop over the neighbours is not.
#[test]
fn directions_are_read_from_a_table() {
    accepted::<directions_of_neighbours>();
    for parity in [Parity::None, Parity::Row, Parity::Column] {
        let options = Options { parity, neighbourhood_size: Some(7), ..Options::default() };
        let text = written_with::<directions_of_neighbours>(&options).source;
        for words in [
            "if neighbour_exists(n) {",
            "u32(neighbour_direction(n).w)",
            "neighbour_direction(valid_neighbour(cell.unsigned)).x",
            "there.y >= 0 && there.y < space.extents.y",
        ] {
            assert!(text.contains(words), "{words}: {text}");
        }
        assert!(!text.contains("neighbour_offsets"), "{text}");
    }
    let boundaries = [Boundary::Toroidal, Boundary::Reflecting, Boundary::Toroidal].into();
    let text = written_with::<directions_of_neighbours>(&Options { boundaries, ..Options::default() }).source;
    assert!(text.contains("return true;"), "{text}");
}
