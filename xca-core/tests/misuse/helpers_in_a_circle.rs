// Helpers call each other in a circle.
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Heat {
    temperature: Real,
}

#[helper]
fn even(n: u32) -> u32 {
    if n == 0 { 1 } else { 1 + odd(n - 1) }
}

#[helper]
fn odd(n: u32) -> u32 {
    if n == 0 { 0 } else { 1 + rest::<3>(n - 1) }
}

#[helper]
fn rest<const N: u32>(n: u32) -> u32 {
    even(n % N)
}

#[elementary_process]
fn count(cell: &mut Cell<Heat>) {
    cell.temperature = even(5) as Real;
}

fn main() {}
