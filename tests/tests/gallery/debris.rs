//! Debris over hexagons: soil and debris together are kept, flat ground spreads alike in six directions, and
//! each step is that of an oracle.

use crate::common::{assert_same_bits, run};
use xca_core::prelude::*;
use xca_examples::models::debris::{Debris, Slope, model};

fn hill(site: Site) -> Slope {
    let [x, y, _] = site.cell();
    let altitude = 0.8 * y as f64 + 0.3 * site.random(0);
    let is_source = x.abs_diff(12) < 3 && y.abs_diff(24) < 3;
    Slope {
        altitude,
        soil: if is_source { 3.0 } else { 0.5 },
        breaks_loose: u32::from(is_source),
        ..Slope::bare()
    }
}

#[test]
fn soil_and_debris_are_kept() {
    let model = model([25, 32], 2.5, Debris::default(), hill).unwrap();
    let mut before = run(&model, 2, 0);
    let mut after = run(&model, 2, 120);
    let total = |simulation: &mut Simulation| {
        let state = simulation.state();
        state.sum(Slope::SOIL).unwrap() + state.sum(Slope::THICKNESS).unwrap()
    };
    let (before, now) = (total(&mut before), total(&mut after));
    assert!((now / before - 1.0).abs() < 1e-12, "{now}, not {before}");
    let state = after.state();
    let reached = state.count_where(|cell: &Slope| cell.thickness > 0.01).unwrap();
    assert!(reached > 60, "debris has reached {reached} cells");
    assert!(state.minimum(Slope::SOIL).unwrap().unwrap() >= 0.0);
}

/// On flat ground a column spreads alike to its six neighbours, in even and odd rows.
#[test]
fn a_column_spreads_alike_in_six_directions() {
    for middle in [[6, 6, 0], [6, 7, 0]] {
        let begin = move |site: Site| match site.cell() == middle {
            true => Slope { thickness: 2.0, momentum: 4.0, ..Slope::bare() },
            false => Slope::bare(),
        };
        let model = model([13, 13], 1.0, Debris::default(), begin).unwrap();
        let mut simulation = run(&model, 0, 1);
        let state = simulation.state();
        let hexagonal = Neighbourhood::hexagonal(Hexagons::CornerUp);
        let around: Vec<f64> = hexagonal.displacements(middle)[1..]
            .iter()
            .map(|displacement| state.geometry().at(middle, *displacement).unwrap())
            .map(|cell| state.get(Slope::THICKNESS, cell).unwrap())
            .collect();
        assert!(around[0] > 0.1, "{around:?}");
        assert!(around.iter().all(|thickness| *thickness == around[0]), "{around:?}");
        // Each of the seven cells gets a seventh of what flows, which is 99 in 100.
        assert!((around[0] - 0.99 * 2.0 / 7.0).abs() < 1e-12, "{around:?}");
        let in_the_middle = state.get(Slope::THICKNESS, middle).unwrap();
        assert!((in_the_middle + 6.0 * around[0] - 2.0).abs() < 1e-12);
    }
}

#[test]
fn same_bits() {
    assert_same_bits(&model([10, 32], 2.5, Debris::default(), hill).unwrap(), 10);
}
