//! Debris fills a pit like water, and none is lost.

use crate::common::{assert_same_bits, run};
use xca_core::prelude::*;
use xca_examples::models::landslide::{Debris, Slope, builder};

const SIZE: usize = 13;

/// A pit with a step on its floor, and debris on one side. Some of the rim is no ground.
fn pit(debris: Debris) -> Model {
    let state = |site: Site| {
        let [x, y, _] = site.cell();
        let is_floor = (3..10).contains(&x) && (3..10).contains(&y);
        let altitude = if !is_floor {
            20.0
        } else if x < 6 {
            1.0
        } else {
            0.0
        };
        let thickness = if x == 4 && (4..8).contains(&y) { 9.0 } else { 0.0 };
        Slope { altitude, thickness, is_ground: x > 0, ..Slope::bare() }
    };
    builder([SIZE, SIZE], 10.0, debris, state).build().unwrap()
}

#[test]
fn debris_that_does_not_stick_lies_level() {
    let mut simulation = run(&pit(Debris { adherence: 0.0, rate: 0.5 }), 0, 3000);
    let state = simulation.state();
    let [altitude, thickness] =
        [Slope::ALTITUDE, Slope::THICKNESS].map(|substate| state.read(substate).unwrap());
    // 36 m of debris on 49 cells, 21 of which are 1 m higher.
    let level = (36.0 + 21.0) / 49.0;
    for (altitude, thickness) in altitude.iter().zip(&thickness) {
        let wanted = if *altitude < 20.0 { level - altitude } else { 0.0 };
        assert!((thickness - wanted).abs() < 1e-9, "{thickness} m at {altitude} m");
    }
}

#[test]
fn same_bits() {
    assert_same_bits(&pit(Debris { adherence: 0.25, rate: 0.6 }), 25);
}
