//! Iterators over arrays and ranges, against the same functions run by Rust itself.
#![allow(
    clippy::manual_contains,
    clippy::needless_range_loop,
    clippy::redundant_guards,
    clippy::suspicious_map,
    reason = "these forms are what is tested"
)]

use crate::common::run;
use xca_core::prelude::*;

const SIDES: usize = 5;
const WEIGHTS: [i32; SIDES] = [3, 1, 4, 1, 5];

/// Digits of a number, so that each has other elements.
#[helper]
fn digits(n: i32) -> [i32; SIDES] {
    let mut digits = [0; SIDES];
    let mut rest = n;
    for digit in 0..SIDES {
        digits[digit] = rest.rem_euclid(10);
        rest = rest.div_euclid(10);
    }
    digits
}

/// The forms of `for`.
#[helper]
fn loops(n: i32) -> i32 {
    let values = digits(n);
    let mut sum = 0;
    for value in values.iter() {
        sum = 3 * sum + value;
    }
    for &value in values.iter() {
        sum = 2 * sum - value;
    }
    for value in &values {
        if *value > 6 {
            continue;
        }
        sum += value.max(4);
    }
    for (i, value) in values.iter().enumerate() {
        sum += i as i32 * *value;
    }
    'first: for (i, &value) in WEIGHTS.iter().enumerate() {
        for (k, value_too) in digits(n + value).into_iter().enumerate() {
            if i == k && value == value_too {
                continue 'first;
            }
            if value + value_too == 13 {
                break 'first;
            }
            sum += 7 * value_too - k as i32;
        }
    }
    let mut changed = values;
    for (i, value) in values.into_iter().enumerate() {
        changed[i] = value * value;
        let value = changed[SIDES - 1 - i];
        sum ^= value;
    }
    sum
}

/// The chains.
#[helper]
fn chains(n: i32) -> i32 {
    let values = digits(n);
    let mut sum = values.iter().sum::<i32>();
    if values.iter().any(|value| *value == 7) {
        sum += 1000;
    }
    if (0..SIDES).all(|i| values[i] > WEIGHTS[i] - 2) {
        sum += 2000;
    }
    sum += 3 * (1..=4).rev().map(|i| i * n.rem_euclid(i)).sum::<i32>();
    sum += values.iter().filter(|value| **value > 3).count() as i32;
    sum += values.iter().filter(|&&value| value > 4).map(|value| 2 * value).sum::<i32>();
    sum += values.into_iter().enumerate().map(|(i, value)| i as i32 * value).sum::<i32>();
    sum += values
        .iter()
        .enumerate()
        .filter(|(i, value)| *i > 1 && value.min(5) == 5)
        .map(|(place, &value)| place as i32 + value)
        .fold(1, |total, next| (total * 3 + next) % 1009);
    sum += values.iter().map(|value| value + 1).filter(|next| next % 2 == 0).map(|next| next * next).count()
        as i32;
    // What comes after the end is known is not computed: there are no elements for it.
    if (0..SIDES + 3).any(|i| values[i] == 9 || i + 1 == SIDES) {
        sum += 5000;
    }
    if (0..SIDES + 3).filter(|&i| values[i] > 2 || i == 4).any(|i| i + 1 == SIDES) {
        sum += 7000;
    }
    if (0..SIDES + 3).filter(|&i| values[i] < 10).all(|i| i + 1 < SIDES) {
        sum += 11_000;
    }
    let result = 2;
    sum + (0..result).fold(sum % 7, |result, n| {
        let twice = 2 * n;
        if (0..3).any(|n| n == twice) { result + n } else { result - twice }
    })
}

#[derive(States, Clone, Copy, Debug, PartialEq)]
enum Light {
    Green,
    Amber,
    Red,
}

/// The name `light` is that of another variable too.
#[helper]
fn next(light: Light, n: i32) -> (Light, i32) {
    let waits = matches!(light, Light::Red | Light::Amber if n > 3);
    let seconds = match n % 10 {
        few if few < 3 => few + n,
        4 => n,
        middle @ (3 | 5) => 100 * middle,
        many @ 6..=8 => 10 * many,
        _ => 1000,
    };
    let next = match light {
        Light::Green if waits => Light::Amber,
        Light::Amber => Light::Red,
        light if seconds % 2 == 0 => light,
        other => match seconds % 5 {
            0 => other,
            light => {
                if light > 2 {
                    Light::Green
                } else {
                    Light::Amber
                }
            }
        },
    };
    (next, seconds)
}

/// Loops over what passes a filter, and sums whose type stands beside them.
#[helper]
fn patterns(n: i32) -> i32 {
    let values = digits(n);
    let total: i32 = values.iter().sum();
    let (mut light, mut sum) = (Light::Green, total);
    'values: for (i, value) in values.iter().enumerate().filter(|(i, value)| *i > 0 && **value != 2) {
        for k in (1..4).filter(|&k| k != *value).map(|k| 3 * k) {
            if k > 3 * *value {
                continue 'values;
            }
            sum += k;
        }
        let (after, seconds) = next(light, *value + n);
        light = after;
        sum = (sum + seconds * i as i32) % 10_007;
        match light {
            Light::Green => sum += 1,
            found if found == Light::Red => sum += 2,
            _ => (),
        }
        if matches!(light, Light::Red) && value.min(5) == 5 {
            break;
        }
    }
    sum
}

#[derive(Substates, Clone, Copy, Debug, PartialEq, Default)]
struct State {
    n: i32,
    patterns: i32,
    loops: i32,
    chains: i32,
}

#[elementary_process]
fn compute(cell: &mut Cell<State>) {
    cell.loops = loops(cell.n);
    cell.chains = chains(cell.n);
    cell.patterns = patterns(cell.n);
}

#[test]
fn iterators_are_those_of_rust() {
    for n in (0..100_000).step_by(977).chain([0, 7, 77_777, 99_999, 30_303]) {
        let wanted = State { n, loops: loops(n), chains: chains(n), patterns: patterns(n) };
        assert_eq!(run(compute, State { n, ..State::default() }), wanted, "{n}");
    }
}

#[derive(Substates, Clone, Copy, Debug, PartialEq, Default)]
struct Flows {
    depth: Real,
    outflow: [Real; 4],
    sum: Real,
    none: Real,
    wet: bool,
}

/// The cell is written while its substate is gone through.
#[elementary_process]
fn drain(cell: &mut Cell<Flows>) {
    for (n, out) in cell.outflow.iter().enumerate() {
        cell.depth -= out;
        cell.outflow[n] = 0.5 * out.sqrt();
    }
    cell.sum = cell.outflow.iter().sum::<Real>();
    cell.none = cell.outflow.iter().filter(|out| **out < 0.0).sum::<Real>();
    cell.wet = cell.outflow.iter().any(|&out| out > 1.0);
    match cell.outflow.iter().filter(|out| **out > 0.9).count() {
        1 => cell.depth += 100.0,
        _ => (),
    }
}

#[test]
fn substates_are_gone_through() {
    let before = Flows { depth: 10.0, outflow: [1.0, 0.0, 4.0, 0.25], ..Flows::default() };
    let after = run(drain, before);
    assert_eq!(after.outflow, [0.5, 0.0, 1.0, 0.25]);
    assert_eq!(after.depth, 104.75);
    assert_eq!((after.sum, after.wet), (1.75, false));
    let nothing: [f64; 0] = [];
    assert_eq!(after.none.to_bits(), nothing.iter().sum::<f64>().to_bits());
}
