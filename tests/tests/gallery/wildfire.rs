//! Wildfire: how often fire passes, and how fast it runs along a line, against the closed form of the rule.

use crate::common::{assert_same_bits, run};
use xca_core::prelude::*;
use xca_examples::models::wildfire::{Cover, Landscape, Weather, likelihood, model};

/// Cells of fuel 1, of which some burn at first.
fn plain(
    burning: impl Fn([usize; 3]) -> bool + Send + Sync + 'static,
) -> impl Fn(Site) -> Landscape + Send + Sync + 'static {
    move |site| {
        let cover = if burning(site.cell()) { Cover::Burning } else { Cover::Whole };
        Landscape { cover, fuel: 1.0, altitude: 0.0 }
    }
}

/// Fire passes from each of k burning neighbours with probability p, so that a cell catches fire with `1 -
/// (1 - p)^k`.
#[test]
fn a_front_passes_with_the_probability_of_the_rule() {
    let size = 200;
    let weather = Weather { spread: 0.3, ..Weather::default() };
    // Every third row burns: each whole cell has three burning neighbours.
    let model = model([size, size], 20.0, weather, plain(|[_, y, _]| y % 3 == 0)).unwrap();
    let mut simulation = run(&model, 5, 1);
    let state = simulation.state();
    let caught = state.count(Landscape::COVER, Cover::Burning).unwrap() as f64;
    let cover = state.read(Landscape::COVER).unwrap();
    assert!(cover.iter().skip(3 * size).take(size).all(|cover| *cover == Cover::Burnt));
    // The last row, 199, has fire on one side only, as all others have.
    let whole = (size * size) as f64 * 133.0 / 200.0;
    let probability = 1.0 - 0.7_f64.powi(3);
    let spread = (whole * probability * (1.0 - probability)).sqrt();
    assert!((caught - whole * probability).abs() < 4.0 * spread, "{caught} of {whole}: not {probability}");
}

/// On a line one cell wide, with a fire that goes out after a step, a front runs on with probability p in
/// each step: it comes g cells far with probability `p^g`.
#[test]
fn a_fire_along_a_line_comes_as_far_as_the_rule_says() {
    let (rows, length) = (999, 12);
    let weather = Weather { spread: 0.6, ..Weather::default() };
    // Lines along x, two bare rows between them.
    let begin = |site: Site| {
        let [x, y, _] = site.cell();
        let cover = if x == 0 && y % 3 == 0 { Cover::Burning } else { Cover::Whole };
        Landscape { cover, fuel: if y % 3 == 0 { 1.0 } else { 0.0 }, altitude: 0.0 }
    };
    let model = model([length, rows], 20.0, weather, begin).unwrap();
    let mut simulation = run(&model, 9, 20);
    let cover = simulation.state().read(Landscape::COVER).unwrap();
    let lines = rows / 3;
    for far in 1..=4 {
        let reached = (0..lines).filter(|line| cover[line * 3 * length + far] == Cover::Burnt).count() as f64;
        let wanted = 0.6_f64.powi(far as i32);
        let spread = (lines as f64 * wanted * (1.0 - wanted)).sqrt();
        assert!(
            (reached - lines as f64 * wanted).abs() < 4.0 * spread,
            "{reached} of {lines} came {far} cells far"
        );
    }
}

/// The numbers of the paper: wind of 10 m/s from behind, from the side, against; a slope of 45 degrees up and
/// down.
#[test]
fn wind_and_slope_are_those_of_the_paper() {
    let weather = Weather { wind: Vector2::new(10.0, 0.0), ..Weather::default() };
    let wind = |x: f64, y: f64| likelihood(Vector2::new(x, y), 0.0, &weather);
    assert!((wind(1.0, 0.0) - (0.45_f64).exp()).abs() < 1e-12);
    assert!((wind(0.0, 3.0) - (0.45_f64 - 1.31).exp()).abs() < 1e-12);
    assert!((wind(-2.0, 0.0) - (0.45_f64 - 2.62).exp()).abs() < 1e-12);
    let slope = |rise: f64| likelihood(Vector2::new(0.0, 5.0), rise, &Weather::default());
    assert!((slope(5.0) - (0.078_f64 * 45.0).exp()).abs() < 1e-9);
    assert!((slope(-5.0) * slope(5.0) - 1.0).abs() < 1e-12);
}

#[test]
fn same_bits() {
    let weather =
        Weather { spread: 0.4, wind: Vector2::new(5.0, -3.0), extinction: 0.5, ..Weather::default() };
    let begin = |site: Site| Landscape {
        cover: if site.cell() == [5, 5, 0] { Cover::Burning } else { Cover::Whole },
        fuel: 0.5 + 0.5 * site.random(0),
        altitude: 20.0 * site.random(1),
    };
    assert_same_bits(&model([11, 11], 20.0, weather, begin).unwrap(), 9);
}
