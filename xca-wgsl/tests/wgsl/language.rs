//! Loops, tuples, methods and constants of functions as WGSL.

use crate::common::{accepted, function, written};
use xca_core::Precision;
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct State {
    count: i32,
    x: Real,
    y: Real,
}

const TABLE: [i32; 3] = [1, 2, 3];

#[elementary_process]
fn jump(cell: &mut Cell<State>) {
    'rows: for i in (0..9).rev().step_by(2) {
        for value in TABLE {
            if value == i {
                continue 'rows;
            }
            if value > i {
                break 'rows;
            }
        }
        cell.count += TABLE.len() as i32;
    }
}

/// WGSL has no labels: flags carry a jump to the loop that it goes to.
#[test]
fn labels_are_flags() {
    accepted::<jump>();
    let text = function(&written::<jump>(Precision::F32), "jump");
    for part in ["continued = true;", "left = true;", "if continued {", "if left {", "TABLE[place]", "3u"] {
        assert!(text.contains(part), "{part}\n{text}");
    }
}

#[helper]
fn split<const N: usize>(values: [Real; N]) -> (Real, bool, [Real; N]) {
    (values[0], values[0] > 0.0, values)
}

#[elementary_process]
fn take_apart(cell: &mut Cell<State>) {
    let (x, positive, _) = split::<2>([cell.x, cell.y]);
    let (y, _, three) = split::<3>([x, x, cell.y]);
    cell.x = if positive { y } else { three[2] };
}

/// A tuple is a struct; each constant gives a function of its own.
#[test]
fn tuples_are_structs() {
    accepted::<take_apart>();
    let shader = written::<take_apart>(Precision::F64);
    assert!(shader.source.contains("struct tuple_3_real_bool_array_real_2 {"), "{}", shader.source);
    assert!(shader.source.contains("fn split(values: array<Real, 2>)"), "{}", shader.source);
    assert!(shader.source.contains("fn split_2(values: array<Real, 3>)"), "{}", shader.source);
}

#[elementary_process]
fn compute(cell: &mut Cell<State>) {
    cell.x = cell.x.exp().round() + cell.y.rem_euclid(3.0) + cell.x % cell.y + cell.x.signum();
    cell.y = (2.0).powi(cell.count) + cell.y.copysign(cell.x).fract().recip();
    cell.count = cell.count.rem_euclid(7) + cell.count.signum() + cell.x.is_finite() as i32;
}

/// None of WGSL's own functions whose result is the driver's choice.
#[test]
fn methods_are_routines() {
    accepted::<compute>();
    for precision in [Precision::F32, Precision::F64] {
        let text = function(&written::<compute>(precision), "compute");
        for part in
            ["exp_2(", "round_real(", "rem_euclid_real(", "remainder_real(", "powi(", "rem_euclid_i32("]
        {
            assert!(text.contains(part), "{part}\n{text}");
        }
        assert!(!text.contains(" exp(") && !text.contains(" round("), "{text}");
    }
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Weather {
    rain: [Real; 3],
    dry: bool,
}

#[derive(Parameters, Clone, Debug)]
struct Soil {
    rate: Real,
}

#[derive(Parameters, Clone, Debug)]
struct Growth {
    rate: Real,
    weights: [Real; 3],
}

#[helper]
fn weigh<const N: usize>(values: [Real; N], growth: &Growth) -> (Real, bool) {
    let mut sum = 0.0;
    for value in values {
        sum += value * growth.rate;
    }
    (sum, sum > 1.0)
}

#[elementary_process]
fn update<const COLOUR: i32>(cell: &mut Cell<State>, weather: &Cell<Weather>, soil: &Soil, growth: &Growth) {
    if cell.count != COLOUR {
        return;
    }
    let (sum, much) = weigh::<3>(weather.rain, growth);
    'search: for n in (1..cell.neighbour_count()).rev() {
        let sky = weather.neighbour(n);
        for rain in sky.rain {
            if sky.dry || cell.neighbour(n).count == 7 {
                continue 'search;
            }
            if much && rain > soil.rate {
                break 'search;
            }
        }
        for k in (0..weather.neighbour(n).rain.len()).step_by(2) {
            cell.x += weather.neighbour(n).rain[k] * growth.weights[k];
        }
    }
    cell.y = sum;
}

/// The indices are known to lie in their arrays and neighbourhoods: nothing is checked.
#[test]
fn loops_over_neighbours_in_several_structs() {
    accepted::<update<0>>();
    accepted::<update<7>>();
    let text = function(&written::<update<7>>(Precision::F32), "update");
    assert!(!text.contains("checked_index") && !text.contains("valid_neighbour"), "{text}");
    assert!(text.contains("7i"), "{text}");
}

#[elementary_process]
fn iterate(cell: &mut Cell<State>) {
    let weights = [cell.x, cell.y, 0.5];
    for (i, weight) in weights.iter().enumerate() {
        cell.x += weight.abs() * i as Real;
    }
    if (1..cell.neighbour_count()).any(|n| cell.neighbour(n).count == cell.count) {
        cell.y = weights.iter().filter(|weight| **weight > 0.0).map(|weight| 2.0 * weight).sum::<Real>();
    }
    match cell.count {
        0 => cell.count = TABLE.into_iter().fold(1, |product, value| product * value),
        1 => {}
        _ => (),
    }
}

/// An iterator is a loop, whose indices are known to lie in the array.
#[test]
fn iterators_are_loops() {
    accepted::<iterate>();
    let text = function(&written::<iterate>(Precision::F32), "iterate");
    for part in ["(var i: u32 = 0u; i < end; i += 1u)", "_xca_elements[i]", "if weight > 0.0"] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    assert!(!text.contains("checked_index") && !text.contains("valid_neighbour"), "{text}");
}
