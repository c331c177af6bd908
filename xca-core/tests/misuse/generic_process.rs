// Functions that are generic in types, in constants of other types, and in constants that are patterns.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
    kind: u8,
}

#[elementary_process]
fn first<S: Substates>(cell: &mut Cell<S>) {
    let _n = cell.neighbour_count();
}

#[helper]
fn second<T>(value: T) -> T {
    value
}

#[elementary_process]
fn third<const WORD: char>(cell: &mut Cell<Heat>) {
    cell.kind = 1;
}

#[elementary_process]
fn fourth<const kind: u8>(cell: &mut Cell<Heat>) {
    cell.kind = kind;
}

#[elementary_process]
fn fifth<const KIND: u8>(cell: &mut Cell<Heat>) {
    match cell.kind {
        KIND => cell.kind = 0,
        _ => {}
    }
}

#[elementary_process]
fn sixth<const KIND: u8>(cell: &mut Cell<Heat>) {
    cell.temperature = KIND;
}

fn main() {
    let _ = Model::builder("heat").substates::<Heat>().process(first).process(sixth::<3>);
}
