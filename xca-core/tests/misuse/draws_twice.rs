// The same random number twice, and the ways in which a number can stand twice.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Tree {
    age: Real,
    burning: u8,
}

#[elementary_process]
fn in_one_block(cell: &mut Cell<Tree>) {
    cell.age = cell.random(0) + cell.random(1);
    cell.burning = (cell.random_bits(0) % 2) as u8;
}

#[elementary_process]
fn before_a_branch(cell: &mut Cell<Tree>) {
    let chance = cell.random(0);
    if cell.burning > 0 {
        return;
    }
    for n in 1..cell.neighbour_count() {
        if cell.neighbour(n).burning > 0 && cell.random(0usize) < chance {
            cell.burning = 1;
        }
    }
}

#[elementary_process]
fn after_a_branch(cell: &mut Cell<Tree>) {
    match cell.burning {
        0 => cell.age = cell.random(3),
        _ => cell.age = 0.0,
    }
    cell.age += cell.random(3);
}

// These are right.

#[elementary_process]
fn in_branches(cell: &mut Cell<Tree>) {
    match cell.burning {
        0 if cell.random(0) < 0.5 => cell.burning = 1,
        1 => cell.age = cell.random(0),
        _ => cell.age = if cell.age > 1.0 { cell.random(0) } else { cell.random(0) * 2.0 },
    }
    if cell.age > 2.0 {
        cell.age = cell.random(1);
    }
    if cell.age < 0.0 {
        cell.age = cell.random(1);
    }
}

#[elementary_process]
fn after_a_way_out(cell: &mut Cell<Tree>) {
    if cell.burning > 0 {
        cell.age = cell.random(0);
        return;
    }
    cell.age = cell.random(0);
    for draw in 1..4 {
        cell.age += cell.random(draw);
    }
}

fn main() {}
