//! Loops: over arrays, backwards, in steps, with labels.

use crate::{TestResult, on_all_engines};
use xca_core::prelude::*;
use xca_tests::suite::engines::PRECISIONS;

const SIDES: usize = 6;
const WEIGHTS: [i32; SIDES] = [3, 1, 4, 1, 5, 9];
const ROWS: [[i32; 2]; 2] = [[1, 2], [3, 4]];

#[helper]
fn elements(n: i32) -> i32 {
    let mut own = [n; SIDES];
    let mut marks = [0_u8; SIDES / 2 + 1];
    own[(n & 3) as usize] = 7;
    marks[(n & 3) as usize] = 2;
    let mut sum = 0;
    for weight in WEIGHTS {
        sum = 3 * sum + weight;
    }
    for value in own {
        if value == 7 {
            continue;
        }
        sum += value;
    }
    for row in ROWS {
        for value in row {
            sum = 2 * sum + value;
        }
    }
    for value in [n, n + 1, n * n] {
        sum ^= value;
    }
    for mark in marks {
        sum += mark as i32;
    }
    sum + n
}

/// Sums in an order that the result shows.
#[helper]
fn backwards(n: i32) -> i32 {
    let mut sum: i32 = 1;
    for i in (0..n).rev() {
        sum = sum.wrapping_mul(7).wrapping_add(i);
    }
    for i in (-2..=n).rev() {
        if i == 1 {
            continue;
        }
        sum = sum.wrapping_mul(5).wrapping_add(i);
    }
    sum
}

#[helper]
fn in_steps(n: i32, step: u32) -> i32 {
    let mut sum: i32 = 1;
    for i in (-3..n).step_by(2) {
        sum = sum.wrapping_mul(7).wrapping_add(i);
    }
    for i in (-3..=n).rev().step_by(3) {
        if i == 0 {
            break;
        }
        sum = sum.wrapping_mul(5).wrapping_add(i);
    }
    for i in (0..20_u32).step_by(step as usize) {
        sum = sum.wrapping_mul(3).wrapping_add(i as i32);
    }
    sum
}

/// At the ends of the types, where a counter that goes on would wrap.
#[helper]
fn at_the_ends(n: i32) -> i32 {
    let mut sum: i32 = n;
    for i in (0..=2_u32).rev() {
        sum = sum.wrapping_mul(7).wrapping_add(i as i32);
    }
    for i in (2_147_483_640..=2_147_483_647).step_by(3) {
        sum = sum.wrapping_mul(5).wrapping_add(i);
    }
    for i in (-2_147_483_648..-2_147_483_640).rev().step_by(5) {
        sum = sum.wrapping_mul(3).wrapping_add(i);
    }
    for i in (250..=255_u8).rev() {
        sum = sum.wrapping_mul(3).wrapping_add(i as i32);
    }
    for i in (4_294_967_290..=4_294_967_295_u32).step_by(4) {
        sum = sum.wrapping_mul(3).wrapping_add(i as i32);
    }
    sum
}

#[helper]
fn labels(n: i32) -> i32 {
    let mut sum = 0;
    'rows: for i in 0..6 {
        let mut k = 0;
        'columns: while k < 6 {
            k += 1;
            for l in (0..4).rev() {
                if l + k == n {
                    continue 'rows;
                }
                if l * i == n + 1 {
                    continue 'columns;
                }
                if i + k + l == n + 6 {
                    break 'rows;
                }
                if l == 2 * k {
                    break 'columns;
                }
                if l == 1 {
                    break;
                }
                sum = 3 * sum + l;
                sum &= 0xffff;
            }
            sum += 1;
        }
        sum += 100;
    }
    'endless: loop {
        sum += 1;
        for step in [1, 2, 3] {
            if sum > 1000 * step {
                break 'endless;
            }
            sum += 17;
        }
    }
    sum
}

/// As many turns as kernels write out, and one more.
const TURNS: i32 = 27;
const MORE: i32 = TURNS + 1;
const NEAR: u8 = 102;

/// Loops that kernels write out, with every way to leave a turn.
#[helper]
fn short(n: i32) -> i32 {
    let mut sum: i32 = 1;
    for i in 0..TURNS {
        if i == n {
            continue;
        }
        if i > n + 9 {
            break;
        }
        sum = sum.wrapping_mul(7).wrapping_add(i);
    }
    for i in 1..=MORE {
        if sum & 3 == 3 {
            sum += 5;
            continue;
        }
        sum = sum.wrapping_mul(5).wrapping_sub(i);
    }
    'turns: for i in 2..=6 {
        match i + n {
            5 => continue 'turns,
            9 => break 'turns,
            17 => return sum,
            _ => sum = sum.wrapping_mul(3).wrapping_add(i),
        }
    }
    for i in 100..=NEAR {
        sum = sum.wrapping_add(i as i32);
    }
    for i in 2..TURNS - 24 {
        sum += 1000 * i;
    }
    let mut turn = 0;
    'outer: while turn < 50 {
        turn += 1;
        for i in 0..4 {
            sum = sum.wrapping_add(i);
            if sum & 7 == 0 {
                break 'outer;
            }
            if sum & 1 == 0 {
                continue 'outer;
            }
        }
        sum = sum.wrapping_add(1);
    }
    sum
}

#[derive(Substates, Clone, Copy, Debug, Default, PartialEq)]
struct Numbers {
    n: i32,
    short: i32,
    elements: i32,
    backwards: i32,
    in_steps: i32,
    ends: i32,
    labels: i32,
}

#[elementary_process]
fn compute(cell: &mut Cell<Numbers>) {
    cell.elements = elements(cell.n);
    cell.backwards = backwards(cell.n);
    cell.in_steps = in_steps(cell.n, 1 + (cell.n & 7) as u32);
    cell.ends = at_the_ends(cell.n);
    cell.labels = labels(cell.n);
    cell.short = short(cell.n);
}

#[test]
fn loops_are_those_of_rust() -> TestResult {
    let model = Model::builder("loops")
        .extents([24, 1, 1])
        .substates::<Numbers>()
        .process(compute)
        .fill(|site| {
            let [x, ..] = site.cell();
            Numbers { n: x as i32 - 4, ..Numbers::default() }
        })
        .build()?;
    for precision in PRECISIONS {
        on_all_engines(&model, precision, |simulation| {
            let state = simulation.state();
            for (x, n) in (-4..20).enumerate() {
                let cell = [x, 0, 0];
                assert_eq!(state.get(Numbers::ELEMENTS, cell)?, elements(n), "{n}");
                assert_eq!(state.get(Numbers::BACKWARDS, cell)?, backwards(n), "{n}");
                assert_eq!(state.get(Numbers::IN_STEPS, cell)?, in_steps(n, 1 + (n & 7) as u32), "{n}");
                assert_eq!(state.get(Numbers::ENDS, cell)?, at_the_ends(n), "{n}");
                assert_eq!(state.get(Numbers::LABELS, cell)?, labels(n), "{n}");
                assert_eq!(state.get(Numbers::SHORT, cell)?, short(n), "{n}");
            }
            Ok(())
        })?;
    }
    Ok(())
}

#[derive(Substates, Clone, Copy, Debug, Default, PartialEq)]
struct Height {
    height: i32,
    low: i32,
}

/// The neighbours from the last to the first, up to one that is lower.
#[elementary_process]
fn look_back(cell: &mut Cell<Height>) {
    'search: for n in (1..cell.neighbour_count()).rev() {
        for step in 0..3 {
            if cell.neighbour(n).height + step < cell.height {
                cell.low = n as i32;
                break 'search;
            }
        }
    }
}

#[test]
fn neighbours_backwards() -> TestResult {
    let model = Model::builder("heights")
        .extents([7, 5, 1])
        .neighbourhood(Neighbourhood::moore_2d(1))
        .boundary(Boundary::Reflecting)
        .substates::<Height>()
        .process(look_back)
        .fill(|site| {
            let [x, y, _] = site.cell();
            Height { height: ((x * 5 + y * 3) % 7) as i32, low: 0 }
        })
        .build()?;
    on_all_engines(&model, Precision::F32, |simulation| {
        // Height 6 at (5, 3); below to the right of it, the last neighbour, 4 * 3 + 6 * 5 = 42, which is 0.
        let state = simulation.state();
        assert_eq!(state.get(Height::HEIGHT, [5, 3, 0])?, 6);
        assert_eq!(state.get(Height::LOW, [5, 3, 0])?, 8);
        // Nothing is lower than 0.
        assert_eq!(state.get(Height::LOW, [0, 0, 0])?, 0);
        Ok(())
    })
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Bead {
    #[position]
    position: Vector3<Real>,
    found: u32,
}

/// Pairs of others until one of them has a label that is a multiple of five; a search is two loops on a GPU.
#[elementary_process]
fn pair(me: &mut Slot<Bead>) {
    let mut found = 0;
    'first: for one in me.others_within(0.9) {
        for other in me.others_in_neighbours_within(0.7) {
            if other.label() == one.label() {
                continue 'first;
            }
            if (other.label() + one.label()) % 5 == 0 {
                break 'first;
            }
            found += 1;
        }
        found += 100;
    }
    me.found = found;
}

#[test]
fn labels_of_searches() -> TestResult {
    let model = Model::builder("beads")
        .extents([4, 4, 1])
        .neighbourhood(Neighbourhood::moore_2d(1))
        .population::<Bead>(12)
        .process(pair)
        .initialise(|state| {
            let items = (0..48).map(|label| {
                let at = |prime: u32| 4.0 * f64::from(label * prime % 97) / 97.0;
                let position = Vector3::new(at(31), at(57), 0.5);
                let cell = [position.x as usize, position.y as usize, 0];
                Item { label, cell, state: Bead { position, found: 0 } }
            });
            Ok(state.set_items(items.collect())?)
        })
        .build()?;
    on_all_engines(&model, Precision::F64, |simulation| {
        let state = simulation.state();
        let items = state.items::<Bead>()?;
        assert!(items.iter().any(|item| item.state.found > 100));
        for item in &items {
            assert_eq!(item.state.found, found(&items, item), "{}", item.label);
        }
        Ok(())
    })
}

/// What `pair` finds, by going through all beads.
fn found(items: &[Item<Bead>], me: &Item<Bead>) -> u32 {
    let near = |radius: f64, own: bool| {
        let mut near: Vec<&Item<Bead>> = items
            .iter()
            .filter(|other| other.label != me.label)
            .filter(|other| own || other.cell != me.cell)
            .filter(|other| (0..2).all(|axis| other.cell[axis].abs_diff(me.cell[axis]) <= 1))
            .filter(|other| (me.state.position - other.state.position).length() < radius)
            .collect();
        // The own cell first, then from the lower left to the upper right.
        near.sort_by_key(|other| (other.cell != me.cell, other.cell[1], other.cell[0], other.label));
        near
    };
    let mut found = 0;
    'first: for one in near(0.9, true) {
        for other in near(0.7, false) {
            if other.label == one.label {
                continue 'first;
            }
            if (other.label + one.label) % 5 == 0 {
                break 'first;
            }
            found += 1;
        }
        found += 100;
    }
    found
}
