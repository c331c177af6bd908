//! Waves run one cell a step, cancel where they meet, and turn round the end of a broken front.

use crate::common::{assert_same_bits, run};
use xca_core::prelude::*;
use xca_examples::models::excitable::{Medium, Tissue, model};

/// From one excited cell: after t steps the wave is the diamond of the 4 t cells that are t steps away.
#[test]
fn a_wave_is_a_diamond_that_grows_a_cell_a_step() {
    let size = 41;
    let begin = move |site: Site| if site.cell() == [20, 20, 0] { Tissue::Excited } else { Tissue::Resting };
    let model = model(size, begin).unwrap();
    for steps in [1, 7, 20] {
        let mut simulation = run(&model, 0, steps);
        let state = simulation.state();
        let tissue = state.read(Medium::TISSUE).unwrap();
        for (cell, tissue) in tissue.iter().enumerate() {
            let [x, y, _] = state.geometry().indices(cell);
            let away = x.abs_diff(20) + y.abs_diff(20);
            let wanted = match steps as usize {
                now if away == now => Tissue::Excited,
                now if away + 1 == now => Tissue::Refractory,
                _ => Tissue::Resting,
            };
            assert_eq!(*tissue, wanted, "{steps} steps, cell {x}, {y}");
        }
    }
    // On the torus the wave meets itself, and is gone.
    assert_eq!(
        run(&model, 0, 45).state().count(Medium::TISSUE, Tissue::Resting).unwrap(),
        (size * size) as u64
    );
}

/// A broken front winds itself up: its end goes round with a period of 4 steps, and never dies.
#[test]
fn a_broken_front_turns_for_ever() {
    let begin = |site: Site| match site.cell() {
        [x, 20, _] if x < 20 => Tissue::Excited,
        [x, 19, _] if x < 20 => Tissue::Refractory,
        _ => Tissue::Resting,
    };
    let model = model(40, begin).unwrap();
    let after = |steps: u64| run(&model, 0, steps).state().read(Medium::TISSUE).unwrap();
    let (one, later) = (after(400), after(404));
    assert!(one.contains(&Tissue::Excited));
    assert_eq!(one, later);
    assert_ne!(one, after(402));
}

#[test]
fn same_bits() {
    let begin = |site: Site| match site.random_bits(0) % 3 {
        0 => Tissue::Resting,
        1 => Tissue::Excited,
        _ => Tissue::Refractory,
    };
    assert_same_bits(&model(17, begin).unwrap(), 12);
}
