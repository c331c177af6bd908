//! Loops over arrays, backwards, in steps and with labels; tuples; constants of functions.

use crate::common::run;
use xca_core::ElementaryProcess;
use xca_core::prelude::*;

const SIDES: usize = 4;
const WEIGHTS: [i32; SIDES] = [1, 10, 100, 1000];

#[derive(Substates, Clone, Copy, Debug, PartialEq, Default)]
struct State {
    a: i32,
    b: i32,
    c: i32,
}

#[elementary_process]
fn arrays(cell: &mut Cell<State>) {
    let mut digits = [0; SIDES];
    digits[1] = 3;
    for weight in WEIGHTS {
        cell.a += weight;
    }
    for i in 0..digits.len() {
        cell.b += digits[i] * WEIGHTS[i];
    }
    for digit in digits {
        cell.c += digit;
    }
}

#[test]
fn arrays_are_gone_through() {
    assert_eq!(run(arrays, State::default()), State { a: 1111, b: 30, c: 3 });
}

#[elementary_process]
fn ranges(cell: &mut Cell<State>) {
    for i in (0..4).rev() {
        cell.a = 10 * cell.a + i;
    }
    for i in (1..=9).step_by(4) {
        cell.b = 10 * cell.b + i;
    }
    for i in (0..9).rev().step_by(3) {
        cell.c = 10 * cell.c + i;
    }
}

#[test]
fn ranges_run_backwards_and_in_steps() {
    assert_eq!(run(ranges, State::default()), State { a: 3210, b: 159, c: 852 });
}

/// `return` leaves the process, also out of a loop with the label that the kernel has for itself.
#[elementary_process]
fn labels(cell: &mut Cell<State>) {
    'body: for i in 0..5 {
        for k in 0..5 {
            if k > i {
                continue 'body;
            }
            if i == 3 {
                break 'body;
            }
            cell.a += 1;
        }
    }
    'body: loop {
        cell.b += 1;
        if cell.b == 3 {
            return;
        }
        continue 'body;
    }
}

#[test]
fn labels_name_loops() {
    assert_eq!(run(labels, State::default()), State { a: 6, b: 3, c: 0 });
}

#[helper]
fn sum_and_product<const N: usize>(values: [i32; N]) -> (i32, i32) {
    let (mut sum, mut product) = (0, 1);
    for value in values {
        sum += value;
        product *= value;
    }
    (sum, product)
}

#[elementary_process]
fn results<const FACTOR: i32>(cell: &mut Cell<State>) {
    let (sum, product) = sum_and_product::<3>([2, 3, 4]);
    let (_, square) = sum_and_product::<2>([sum, sum]);
    cell.a = FACTOR * sum;
    cell.b = FACTOR * product;
    cell.c = square;
}

#[test]
fn constants_make_processes_of_their_own() {
    assert_eq!(run(results::<1>, State::default()), State { a: 9, b: 24, c: 81 });
    assert_eq!(run(results::<-2>, State::default()), State { a: -18, b: -48, c: 81 });
    assert_eq!(results::<-2>::process().name, "results<-2>");
    assert_eq!(sum_and_product([5, 6]), (11, 30));
}

#[derive(Substates, Clone, Copy, Debug, PartialEq, Default)]
struct Zero {
    n: i32,
}

#[elementary_process]
fn stand_still(cell: &mut Cell<Zero>) {
    for i in (0..3).step_by(cell.n as usize) {
        cell.n += i;
    }
}

/// In Rust a step of 0 panics, which is an error of the run.
#[test]
fn a_step_of_zero_ends_the_run() {
    let error = crate::common::failure(stand_still, Zero { n: 0 });
    assert!(error.contains("`stand_still`"), "{error}");
}
