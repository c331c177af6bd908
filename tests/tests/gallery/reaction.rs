//! Small waves of one substance alone fade as the scheme says; spots stay within bounds.

use crate::common::{assert_same_bits, run};
use std::f64::consts::TAU;
use xca_core::prelude::*;
use xca_examples::models::reaction::{Mixture, Rates, model};

/// Without `v` the scheme is linear in `1 - u`: a wave of k along x fades by `1 - feed - 2 D (1 - cos k)` a
/// step.
#[test]
fn a_wave_fades_as_the_scheme_says() {
    let (size, steps) = (32, 60);
    let rates = Rates::default();
    let wave = move |x: usize| 0.1 * (TAU * 3.0 * x as f64 / 32.0).cos();
    let model = model(size, rates, move |site| Mixture { u: 1.0 - wave(site.cell()[0]), v: 0.0 }).unwrap();
    let factor = 1.0 - rates.feed - 2.0 * rates.diffusion_u * (1.0 - (TAU * 3.0 / 32.0).cos());
    let mut simulation = run(&model, 0, steps);
    for (cell, u) in simulation.state().read(Mixture::U).unwrap().iter().enumerate() {
        let wanted = 1.0 - wave(cell % size) * factor.powi(steps as i32);
        assert!((u - wanted).abs() < 1e-14, "cell {cell}: {u}, not {wanted}");
    }
}

/// In a well stirred dish both substances follow the map of one cell; the rates have a steady state where it
/// says.
#[test]
fn spots_grow_and_both_shares_stay_between_0_and_1() {
    let begin = |site: Site| {
        let [x, y, _] = site.cell();
        let seeded = (24..40).contains(&x) && (24..40).contains(&y);
        Mixture {
            u: if seeded { 0.5 } else { 1.0 },
            v: if seeded { 0.25 + 0.01 * site.random(0) } else { 0.0 },
        }
    };
    let mut simulation = run(&model(64, Rates::default(), begin).unwrap(), 3, 3000);
    let state = simulation.state();
    let covered = state.count_where(|cell: &Mixture| cell.v > 0.1).unwrap();
    assert!(covered > 700, "the pattern has spread over {covered} cells");
    for substate in [Mixture::U, Mixture::V] {
        assert!(state.minimum(substate).unwrap().unwrap() >= 0.0);
        assert!(state.maximum(substate).unwrap().unwrap() <= 1.0);
    }
}

#[test]
fn same_bits() {
    let begin = |site: Site| Mixture { u: site.random(0), v: 0.5 * site.random(1) };
    assert_same_bits(&model(19, Rates::default(), begin).unwrap(), 10);
}
