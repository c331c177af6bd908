//! Predators and prey: mean-field rates where all are mixed, diffusion of those that wander, and places
//! that stay.

use crate::common::{assert_same_bits, run};
use std::collections::BTreeMap;
use xca_core::prelude::*;
use xca_examples::models::predators::{Ecology, Inhabitants, Meadow, Predator, Prey, Shares, model};

fn everywhere(prey: f64, predators: f64) -> impl Fn(&Site) -> Shares + Clone + Send + Sync + 'static {
    move |_| Shares { prey, predators }
}

/// The shares of places that are taken by prey and by predators.
fn shares(simulation: &mut Simulation) -> [f64; 2] {
    let state = simulation.state();
    let prey = state.count_where(|prey: &Prey| prey.alive).unwrap() as f64;
    let predators = state.count_where(|predator: &Predator| predator.alive).unwrap() as f64;
    let places = state.count_items::<Prey>().unwrap() as f64;
    [prey / places, predators / places]
}

/// In a meadow of 3 x 3 cells all meet all. There the numbers follow the mean-field equations, step by step.
#[test]
fn mixed_populations_follow_the_mean_field() {
    let ecology =
        Ecology { breeding: 0.06, hunting: 0.15, growth: 0.12, death: 0.02, stride: 1.0, places: 1500 };
    let mut simulation = run(&model(3, ecology, everywhere(0.6, 0.1)).unwrap(), 3, 0);
    let [mut x, mut y] = shares(&mut simulation);
    let (mut most, mut least) = (y, x);
    for step in 0..200 {
        let (born, eaten) = (ecology.breeding * x * (1.0 - x), ecology.hunting * x * y);
        let (grown, dead) = (ecology.growth * x * y * (1.0 - y), ecology.death * y);
        (x, y) = (x + born - eaten, y + grown - dead);
        simulation.step().unwrap();
        let [prey, predators] = shares(&mut simulation);
        assert!((prey - x).abs() < 0.03, "step {step}: {prey} prey, not {x}");
        assert!((predators - y).abs() < 0.03, "step {step}: {predators} predators, not {y}");
        (most, least) = (y.max(most), x.min(least));
    }
    // Predators have multiplied and prey has become rare on the way.
    assert!(most > 0.3 && least < 0.2, "{most} {least}");
}

/// Without predators, prey that neither dies nor breeds goes `stride² / 3` along each axis in a step,
/// squared.
#[test]
fn those_that_wander_diffuse() {
    let (size, steps) = (61, 60);
    let ecology = Ecology { stride: 0.8, places: 2, ..Ecology::default() };
    let mut simulation = run(&model(size, ecology, everywhere(0.5, 0.0)).unwrap(), 9, 0);
    let places = |simulation: &mut Simulation| -> BTreeMap<u32, Vector3<f64>> {
        let items = simulation.state().items::<Prey>().unwrap();
        items.iter().map(|item| (item.label, item.state.position)).collect()
    };
    let before = places(&mut simulation);
    simulation.run(steps).unwrap();
    let after = places(&mut simulation);
    assert_eq!(before.len(), 2 * size * size);
    let nearest = |way: f64| way - (way / size as f64).round() * size as f64;
    let mut squares = [0.0; 2];
    for (label, from) in &before {
        let to = after[label];
        for (square, way) in squares.iter_mut().zip([to.x - from.x, to.y - from.y]) {
            *square += nearest(way).powi(2) / before.len() as f64;
        }
    }
    let wanted = steps as f64 * 0.8 * 0.8 / 3.0;
    for square in squares {
        // The relative standard error of the mean of n squares is the root of 2 / n: 0.016.
        assert!((square / wanted - 1.0).abs() < 0.07, "{square}, not {wanted}");
    }
}

/// No place is made or lost, and the counts of the cells are those of the items.
#[test]
fn places_stay() {
    let ecology = Ecology::default();
    let mut simulation = run(&model(24, ecology, everywhere(0.5, 0.3)).unwrap(), 2, 30);
    let state = simulation.state();
    let places = 24 * 24 * ecology.places as usize;
    assert_eq!(state.count_items::<Prey>().unwrap(), places);
    assert_eq!(state.count_items::<Predator>().unwrap(), places);
    // The counts are those of the positions at the start of the step.
    for process in [0, 1] {
        simulation.run_process(process).unwrap();
    }
    let state = simulation.state();
    let mut wanted = vec![[0, 0]; 24 * 24];
    for item in state.items::<Prey>().unwrap() {
        wanted[item.cell[1] * 24 + item.cell[0]][0] += u32::from(item.state.alive);
    }
    for item in state.items::<Predator>().unwrap() {
        wanted[item.cell[1] * 24 + item.cell[0]][1] += u32::from(item.state.alive);
    }
    let (prey, predators) = (state.read(Meadow::PREY).unwrap(), state.read(Meadow::PREDATORS).unwrap());
    let inhabitants = state.read(Meadow::INHABITANTS).unwrap();
    for (cell, [prey_there, predators_there]) in wanted.iter().enumerate() {
        assert_eq!([prey[cell], predators[cell]], [*prey_there, *predators_there], "cell {cell}");
        let who = match (*prey_there > 0, *predators_there > 0) {
            (false, false) => Inhabitants::Nobody,
            (true, false) => Inhabitants::Prey,
            (false, true) => Inhabitants::Predators,
            (true, true) => Inhabitants::Both,
        };
        assert_eq!(inhabitants[cell], who, "cell {cell}");
    }
    assert!(inhabitants.contains(&Inhabitants::Both) && inhabitants.contains(&Inhabitants::Prey));
}

/// Without prey, predators die out; without predators, prey fills the meadow.
#[test]
fn those_left_alone() {
    let alone = |prey: f64, predators: f64| {
        shares(&mut run(&model(8, Ecology::default(), everywhere(prey, predators)).unwrap(), 4, 150))
    };
    let [prey, predators] = alone(0.0, 0.9);
    assert!(prey == 0.0 && predators < 0.01, "{prey} {predators}");
    let [prey, predators] = alone(0.1, 0.0);
    assert!(prey > 0.98 && predators == 0.0, "{prey} {predators}");
}

#[test]
fn same_bits() {
    assert_same_bits(&model(6, Ecology::default(), everywhere(0.5, 0.3)).unwrap(), 10);
}
