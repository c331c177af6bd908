//! Tests of differences with states made by hand.

use super::*;
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy)]
struct Field {
    flow: Vector2<Real>,
    count: i32,
}

#[derive(Substates, Clone, Copy)]
struct Bead {
    weight: Real,
}

fn model() -> Model {
    Model::builder("made").extents([3, 2, 1]).substates::<Field>().population::<Bead>(4).build().unwrap()
}

/// Beads in the first two cells.
fn state(beads: &[(usize, u32, f64)], flow: [f64; 12], count: [i32; 6]) -> Snapshot {
    let beads = beads.to_vec();
    let model = model();
    let mut simulation = Simulation::new(&model, &Reference, RunOptions::default()).unwrap();
    let mut state = simulation.state();
    state
        .fill(|site| {
            let [x, y, _] = site.cell();
            let cell = x + 3 * y;
            Field { flow: Vector2::new(flow[2 * cell], flow[2 * cell + 1]), count: count[cell] }
        })
        .unwrap();
    let items = beads.into_iter();
    let items = items.map(|(x, label, weight)| Item { label, cell: [x, 0, 0], state: Bead { weight } });
    state.set_items(items.collect()).unwrap();
    simulation.snapshot().unwrap()
}

fn between(first: &Snapshot, other: &Snapshot) -> Differences {
    let side = |snapshot| Side { snapshot, precision: Precision::F64 };
    Differences::between(&model(), side(first), side(other))
}

const BEADS: [(usize, u32, f64); 3] = [(0, 4, 1.0), (0, 7, 2.0), (1, 5, 3.0)];

#[test]
fn a_state_is_identical_to_itself() {
    let first = state(&BEADS, [1.5; 12], [3; 6]);
    let differences = between(&first, &first);
    assert_eq!(differences.verdict(0.0), Verdict::Identical);
    assert!(differences.substates.iter().all(|difference| difference.identical_share() == 1.0));
    assert_eq!(differences.substates[0].values, 12);
    assert!(differences.gravest().is_none());
}

#[test]
fn measures_are_those_of_their_definitions() {
    let mut flow = [4.0; 12];
    flow[3] = -8.0;
    let first = state(&BEADS, flow, [3; 6]);
    flow[7] = 4.0_f64.next_up().next_up();
    flow[8] = 3.0;
    let differences = between(&first, &state(&BEADS, flow, [3; 6]));
    let found = &differences.substates[0];
    assert_eq!((found.different, found.values), (2, 12));
    assert_eq!((found.largest_absolute, found.largest_relative, found.scale), (1.0, 0.25, 8.0));
    // Between 3 and 4 lie half of the numbers of a power of two.
    assert_eq!(found.largest_ulp, Some(1 << 51));
    assert!((found.rms - (1.0_f64 / 12.0).sqrt()).abs() < 1e-15);
    assert!((found.identical_share() - 10.0 / 12.0).abs() < 1e-15);
    let worst = found.worst.as_ref().unwrap();
    assert_eq!((worst.place, worst.component.as_str()), (Place::Cell([1, 1, 0]), ".x"));
    assert_eq!((worst.first, worst.other), (4.0, 3.0));
    assert_eq!(differences.verdict(0.124), Verdict::Different);
    assert_eq!(differences.verdict(0.125), Verdict::Rounding);
}

/// Squares of these differences are beyond the range of `f64`, the root of their mean is not.
#[test]
fn differences_of_any_size_have_a_root_mean_square() {
    for size in [1e-200, 1e200] {
        let first = state(&[], [size; 12], [0; 6]);
        let mut flow = [size; 12];
        (flow[0], flow[5]) = (4.0 * size, -3.0 * size);
        let differences = between(&first, &state(&[], flow, [0; 6]));
        let wanted = (25.0_f64 / 12.0).sqrt() * size;
        assert!((differences.substates[0].rms / wanted - 1.0).abs() < 1e-12, "{size}");
    }
}

#[test]
fn zeros_of_either_sign_have_other_bits_and_the_same_value() {
    let first = state(&[], [0.0; 12], [0; 6]);
    let differences = between(&first, &state(&[], [-0.0; 12], [0; 6]));
    let found = &differences.substates[0];
    assert_eq!((found.different, found.largest_absolute, found.largest_ulp), (12, 0.0, Some(0)));
    assert_eq!(differences.verdict(0.0), Verdict::Rounding);
}

#[test]
fn what_is_no_number_is_no_rounding() {
    let first = state(&BEADS, [1.0; 12], [3; 6]);
    let mut flow = [1.0; 12];
    flow[11] = f64::NAN;
    let differences = between(&first, &state(&BEADS, flow, [3; 6]));
    assert_eq!(differences.substates[0].largest_absolute, f64::INFINITY);
    assert_eq!(differences.verdict(1e9), Verdict::Different);
    assert_eq!(differences.substates[0].worst.as_ref().unwrap().place, Place::Cell([2, 1, 0]));
}

#[test]
fn whole_numbers_have_no_tolerance() {
    let first = state(&BEADS, [1.0; 12], [1_000_000; 6]);
    let other = state(&BEADS, [1.0; 12], [1_000_000, 1_000_000, 1_000_001, 1_000_000, 1_000_000, 1_000_000]);
    let differences = between(&first, &other);
    let found = &differences.substates[1];
    assert_eq!((found.different, found.largest_absolute, found.largest_ulp), (1, 1.0, None));
    assert_eq!(differences.verdict(0.1), Verdict::Different);
}

#[test]
fn items_are_compared_by_label_wherever_they_are() {
    let first = state(&BEADS, [1.0; 12], [3; 6]);
    // Item 4 is in another cell, and is therefore last. The weight of item 5 is different.
    let moved = [(1, 4, 1.0), (0, 7, 2.0), (1, 5, 3.5)];
    let differences = between(&first, &state(&moved, [1.0; 12], [3; 6]));
    let (weight, cells) = (&differences.substates[2], &differences.substates[3]);
    assert_eq!((weight.different, weight.values, weight.unmatched), (1, 3, 0));
    assert_eq!(weight.worst.as_ref().unwrap().place, Place::Item(5));
    assert_eq!((cells.kind, cells.different), (Kind::Cell, 1));
    assert_eq!(cells.worst.as_ref().unwrap().place, Place::Item(4));
    assert_eq!(differences.verdict(0.2), Verdict::Rounding);
}

#[test]
fn an_item_in_another_cell_is_no_rounding_where_nothing_was_rounded() {
    let first = state(&BEADS, [1.0; 12], [3; 6]);
    let differences = between(&first, &state(&[(1, 4, 1.0), BEADS[1], BEADS[2]], [1.0; 12], [3; 6]));
    assert_eq!(differences.verdict(0.2), Verdict::Different);
    assert!(!differences.is_identical());
}

#[test]
fn items_without_their_like_are_counted() {
    let first = state(&BEADS, [1.0; 12], [3; 6]);
    let differences = between(&first, &state(&[(0, 7, 2.0), (1, 6, 3.0)], [1.0; 12], [3; 6]));
    let weight = &differences.substates[2];
    assert_eq!((weight.values, weight.different, weight.unmatched), (1, 0, 3));
    assert_eq!(differences.verdict(1.0), Verdict::Different);
}

#[test]
fn what_belongs_to_no_place_differs_too() {
    let first = state(&BEADS, [1.0; 12], [3; 6]);
    let mut other = first.clone();
    other.step = 1;
    other.stop = Some("it is enough".to_owned());
    let differences = between(&first, &other);
    assert_eq!(differences.remarks, ["steps done: 0 and 1", "end of the run: goes on and it is enough"]);
    assert_eq!(differences.verdict(1.0), Verdict::Different);
}
