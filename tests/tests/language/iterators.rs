//! Iterators: over arrays, neighbours and other items.

use crate::{TestResult, on_all_engines};
use xca_core::prelude::*;
use xca_tests::suite::engines::PRECISIONS;

const SIDES: usize = 6;
const WEIGHTS: [i32; SIDES] = [3, 1, 4, 1, 5, 9];

#[helper]
fn loops(n: i32) -> i32 {
    let mut values = WEIGHTS;
    values[n.rem_euclid(6) as usize] = n;
    let mut sum = 0;
    'places: for (i, value) in values.iter().enumerate() {
        for &weight in &WEIGHTS {
            if weight == *value + 1 {
                continue 'places;
            }
            if weight + n == 25 {
                break 'places;
            }
        }
        sum = 3 * sum + value.abs() * i as i32;
    }
    for (i, value) in values.into_iter().enumerate() {
        values[SIDES - 1 - i] += value;
    }
    for value in values.iter() {
        sum = (2 * sum + value) % 10_007;
    }
    sum
}

#[helper]
fn chains(n: i32) -> i32 {
    let mut values = WEIGHTS;
    values[n.rem_euclid(6) as usize] = n;
    let mut sum = values.iter().map(|value| value * value).sum::<i32>();
    // Beyond the end are no elements.
    if (0..SIDES + 2).any(|i| values[i] == 5 || i + 1 == SIDES) {
        sum += 100;
    }
    if !(0..SIDES + 2).filter(|&i| values[i] != 4).all(|i| values[i] < 9 && i + 1 < SIDES) {
        sum += 200;
    }
    sum += 1000 * values.iter().filter(|value| **value > n).count() as i32;
    sum += (0..n).rev().step_by(2).map(|i| i.min(7)).sum::<i32>();
    sum += (0..SIDES).map(|i| values[i] - 3).filter(|more| *more > 0).map(|more| more * more).sum::<i32>();
    sum += values.iter().map(|value| value % 3).fold(1, |mixed, rest| (3 * mixed + rest) % 1009);
    if values.iter().filter(|&&value| value != 4).any(|&value| value == n + 3) {
        sum += 20_000;
    }
    if (0..4).map(|i| values[i] + 1).any(|value| value == n) {
        sum += 30_000;
    }
    if values.contains(&(n / 2)) {
        sum += 50_000;
    }
    if (2..5).contains(&n) || (7..=9).contains(&n) || !(..9).contains(&(n - 3)) {
        sum += 70_000;
    }
    let smallest =
        values.iter().enumerate().fold(0, |best, (i, &value)| if value < values[best] { i } else { best });
    sum + smallest as i32
}

#[derive(States, Clone, Copy, Debug, PartialEq)]
enum Light {
    Green,
    Amber,
    Red,
}

/// The next light, and a number; patterns give names.
#[helper]
fn patterns(n: i32) -> i32 {
    let mut light = if n % 2 == 0 { Light::Green } else { Light::Red };
    let mut sum = 0;
    for (i, weight) in WEIGHTS.iter().enumerate().filter(|(i, weight)| *i > 0 && **weight != 4) {
        light = match light {
            Light::Green if (n + i as i32) % 3 == 0 => Light::Amber,
            Light::Amber => Light::Red,
            light if sum > 20 => light,
            _ => Light::Green,
        };
        sum += match (n + *weight).rem_euclid(9) {
            few if few < 3 => few + n,
            middle @ (3 | 5) => 100 * middle,
            many @ 6..=7 => 10 * many,
            _ => 1,
        };
        if matches!(light, Light::Red | Light::Amber if sum > 0) {
            sum += 1000;
        }
    }
    sum
}

#[derive(Substates, Clone, Copy, Debug, Default, PartialEq)]
struct Numbers {
    n: i32,
    patterns: i32,
    loops: i32,
    chains: i32,
    greater: u32,
    has_equal: bool,
    shares: [Real; 3],
    sum: Real,
}

#[elementary_process]
fn compute(cell: &mut Cell<Numbers>) {
    cell.loops = loops(cell.n);
    cell.chains = chains(cell.n);
    cell.patterns = patterns(cell.n);
}

#[elementary_process]
fn look_around(cell: &mut Cell<Numbers>) {
    let own = cell.n;
    cell.greater = (1..cell.neighbour_count()).filter(|&n| cell.neighbour(n).n > own).count() as u32;
    cell.has_equal = (1..cell.neighbour_count()).any(|n| {
        let other = cell.neighbour(n);
        other.n.rem_euclid(4) == own.rem_euclid(4)
    });
    cell.sum = (1..cell.neighbour_count()).map(|n| 0.1 * cell.neighbour(n).n as Real).sum::<Real>();
    for (n, share) in cell.shares.iter().enumerate() {
        cell.shares[n] = share / (1.0 + cell.sum.abs());
    }
}

#[test]
fn iterators_are_those_of_rust() -> TestResult {
    let number = |[x, y, _]: [usize; 3]| ((x * 7 + y * 11) % 23) as i32 - 6;
    let model = Model::builder("numbers")
        .extents([9, 5, 1])
        .neighbourhood(Neighbourhood::moore_2d(1))
        .boundary(Boundary::Toroidal)
        .substates::<Numbers>()
        .process((compute, look_around))
        .fill(move |site| Numbers { n: number(site.cell()), shares: [1.0, 0.25, -3.0], ..Numbers::default() })
        .build()?;
    for precision in PRECISIONS {
        on_all_engines(&model, precision, |simulation| {
            let state = simulation.state();
            for index in 0..45 {
                let cell = state.geometry().indices(index);
                let n = number(cell);
                assert_eq!(state.get(Numbers::LOOPS, cell)?, loops(n), "{n}");
                assert_eq!(state.get(Numbers::CHAINS, cell)?, chains(n), "{n}");
                assert_eq!(state.get(Numbers::PATTERNS, cell)?, patterns(n), "{n}");
                let [x, y, _] = cell;
                let around = (0..9)
                    .filter(|place| *place != 4)
                    .map(|place| number([(x + place % 3 + 8) % 9, (y + place / 3 + 4) % 5, 0]));
                let greater = around.clone().filter(|other| *other > n).count();
                assert_eq!(state.get(Numbers::GREATER, cell)?, greater as u32, "{cell:?}");
                let has_equal = around.clone().any(|other| (other - n) % 4 == 0);
                assert_eq!(state.get(Numbers::HAS_EQUAL, cell)?, has_equal, "{cell:?}");
                let sum = 0.1 * f64::from(around.sum::<i32>());
                assert!((state.get(Numbers::SUM, cell)? - sum).abs() < 1e-5, "{cell:?}");
                let share = state.get(Numbers::SHARES, cell)?[1];
                assert!((share * (1.0 + sum.abs()) - 0.25).abs() < 1e-5, "{cell:?}");
            }
            Ok(())
        })?;
    }
    Ok(())
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Bead {
    #[position]
    position: Vector3<Real>,
    near: u32,
    is_smallest: bool,
    distances: Real,
}

#[elementary_process]
fn look(me: &mut Slot<Bead>) {
    me.near = me.others_within(0.9).count() as u32;
    me.is_smallest = me.others_in_neighbours().all(|other| other.label() > me.label());
    me.distances = me
        .others_within(0.7)
        .filter(|other| other.label() % 2 == 0)
        .map(|other| (me.position - other.position).length())
        .sum::<Real>();
}

#[derive(Substates, Clone, Copy, Debug, Default, PartialEq)]
struct Ground {
    crowded: bool,
}

#[elementary_process]
fn weigh(ground: &mut Cell<Ground>, beads: &Slots<Bead>) {
    ground.crowded = beads.into_iter().filter(|bead| bead.near > 2).count() > 1;
}

#[test]
fn searches_are_iterators() -> TestResult {
    let at = |label: u32| {
        let along = |prime: u32| 4.0 * f64::from(label * prime % 97) / 97.0;
        Vector3::new(along(31), along(57), 0.5)
    };
    let cell = move |label: u32| [at(label).x as usize, at(label).y as usize, 0];
    let model = Model::builder("beads")
        .extents([4, 4, 1])
        .neighbourhood(Neighbourhood::moore_2d(1))
        .substates::<Ground>()
        .population::<Bead>(12)
        .process((look, weigh))
        .initialise(move |state| {
            let bead = |label| Bead { position: at(label), near: 0, is_smallest: false, distances: 0.0 };
            let items = (0..48).map(|label| Item { label, cell: cell(label), state: bead(label) });
            Ok(state.set_items(items.collect())?)
        })
        .build()?;
    on_all_engines(&model, Precision::F64, |simulation| {
        let state = simulation.state();
        let items = state.items::<Bead>()?;
        let near = |one: u32, other: u32| one != other && (at(one) - at(other)).length() < 0.9;
        for item in &items {
            let me = item.label;
            let wanted = (0..48).filter(|other| near(me, *other)).count();
            assert_eq!(item.state.near, wanted as u32, "{me}");
            let beside = |other: &u32| {
                let far = |axis: usize| cell(me)[axis].abs_diff(cell(*other)[axis]);
                far(0).max(far(1)) == 1
            };
            assert_eq!(item.state.is_smallest, (0..48).filter(beside).all(|other| other > me), "{me}");
            let distances = (0..48).filter(|other| near(me, *other) && other % 2 == 0);
            let distances = distances.map(|other| (at(me) - at(other)).length()).filter(|far| *far < 0.7);
            assert!((item.state.distances - distances.sum::<f64>()).abs() < 1e-12, "{me}");
        }
        assert!(items.iter().any(|item| item.state.is_smallest));
        for index in 0..16 {
            let place = state.geometry().indices(index);
            let many = items.iter().filter(|item| item.cell == place && item.state.near > 2).count() > 1;
            assert_eq!(state.get(Ground::CROWDED, place)?, many, "{place:?}");
        }
        Ok(())
    })
}
