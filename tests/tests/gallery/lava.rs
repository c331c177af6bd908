//! Lava: none is lost, heat is kept but for what is radiated, cooling follows the formula, and each step is
//! that of an oracle written another way.

use crate::common::{assert_same_bits, run};
use xca_core::prelude::*;
use xca_examples::models::lava::{Lava, Rate, Vent, Volcano, emitted, model};

const SIDE: f64 = 10.0;

fn vents() -> Vec<Vent> {
    let rates = vec![
        Rate { from: 0.0, volume: 4.0 },
        Rate { from: 1800.0, volume: 12.0 },
        Rate { from: 3600.0, volume: 0.0 },
    ];
    vec![Vent { cell: [16, 15, 0], rates: rates.clone() }, Vent { cell: [18, 17, 0], rates }]
}

fn cone(site: Site) -> f64 {
    let [x, y, _] = site.cell().map(|index| index as f64 - 16.0);
    200.0 - 3.0 * x.hypot(y) + site.random(0)
}

fn volcano(lava: Lava) -> Model {
    model([32, 32], SIDE, lava, vents(), |site| Some(cone(site))).unwrap()
}

/// Fluid and solid lava together are what the vents gave.
#[test]
fn no_lava_is_lost() {
    let steps = 150;
    let mut simulation = run(&volcano(Lava::default()), 1, steps);
    let state = simulation.state();
    let volume = (state.sum(Volcano::THICKNESS).unwrap() + state.sum(Volcano::SOLID).unwrap()) * SIDE * SIDE;
    // The steering after the last step has given lava too.
    let wanted = emitted(&vents(), 60.0, steps + 1);
    assert!((volume / wanted - 1.0).abs() < 1e-12, "{volume} m³, not {wanted}");
    assert!(state.sum(Volcano::SOLID).unwrap() > 0.0, "some has become rock");
    let covered = state.count_where(|cell: &Volcano| cell.thickness > 0.0 || cell.solid > 0.0).unwrap();
    assert!(covered > 20, "it has flown over {covered} cells");
}

/// Without radiation the heat, thickness times temperature, is what the vents gave.
#[test]
fn heat_is_kept_but_for_radiation() {
    let steps = 50;
    let heat = |lava: Lava| {
        let mut simulation = run(&volcano(lava), 1, steps);
        simulation.state().sum_of(|cell: &Volcano| cell.thickness * cell.temperature).unwrap() * SIDE * SIDE
    };
    let given = emitted(&vents(), 60.0, steps + 1) * 1360.0;
    let kept = heat(Lava { cooling: 0.0, ..Lava::default() });
    assert!((kept / given - 1.0).abs() < 1e-12, "{kept}, not {given}");
    assert!(heat(Lava::default()) < 0.99 * given);
}

/// A cell alone in a pit cools as `1/T³` grows: by `cooling / thickness` a step.
#[test]
fn lava_in_a_pit_cools_as_the_formula_says() {
    let lava = Lava { solid_temperature: 500.0, ..Lava::default() };
    let rates = vec![Rate { from: 0.0, volume: 5.0 }, Rate { from: 60.0, volume: 0.0 }];
    let vent = Vent { cell: [1, 1, 0], rates };
    let pit = |site: Site| if site.cell() == [1, 1, 0] { 0.0 } else { 1000.0 };
    let model = model([3, 3], SIDE, lava, vec![vent], move |site| Some(pit(site))).unwrap();
    let mut simulation = run(&model, 0, 100);
    let thickness = 5.0 * 60.0 / (SIDE * SIDE);
    let wanted = (1360.0_f64.powi(-3) + 100.0 * lava.cooling / thickness).cbrt().recip();
    let found = simulation.state().get(Volcano::TEMPERATURE, [1, 1, 0]).unwrap();
    assert!((found / wanted - 1.0).abs() < 1e-10, "{found} K, not {wanted}");
    assert!(found < 1300.0);
}

/// The outflows of a cell written another way: heights sorted, and the lowest filled up one after the other.
#[test]
fn outflows_level_the_heights() {
    let mut simulation = run(&volcano(Lava::default()), 5, 20);
    let lava = Lava::default();
    let state = simulation.state();
    let (altitude, thickness) =
        (state.read(Volcano::ALTITUDE).unwrap(), state.read(Volcano::THICKNESS).unwrap());
    let temperature = state.read(Volcano::TEMPERATURE).unwrap();
    simulation.run_process(0).unwrap();
    let outflow = simulation.state().read(Volcano::OUTFLOW).unwrap();
    let offsets = [[-1, -1], [0, -1], [1, -1], [-1, 0], [1, 0], [-1, 1], [0, 1], [1, 1]];
    let mut flowing = 0;
    for cell in 0..32 * 32 {
        let (x, y) = ((cell % 32) as i64, (cell / 32) as i64);
        let mut heights: Vec<(f64, Option<usize>)> = vec![(altitude[cell], None)];
        let mut steep = [0.0; 8];
        for (n, [dx, dy]) in offsets.iter().enumerate() {
            let inside = (0..32).contains(&(x + dx)) && (0..32).contains(&(y + dy));
            let there = ((y + dy) * 32 + x + dx) as usize;
            let (ground, lava) = if inside { (altitude[there], thickness[there]) } else { (1e5, 0.0) };
            let distance = f64::from((dx * dx + dy * dy) as i32).sqrt();
            let height = altitude[cell] - (altitude[cell] - ground) / distance + lava;
            steep[n] = (altitude[cell] + thickness[cell] - height) / SIDE;
            if steep[n] > 0.0 {
                heights.push((height, Some(n)));
            }
        }
        heights.sort_by(|one, other| one.0.total_cmp(&other.0));
        // The common level of the lowest k heights, as long as the next one is below it.
        let (mut sum, mut level, mut count) = (thickness[cell], f64::INFINITY, 0);
        for (height, _) in &heights {
            if *height > level {
                break;
            }
            sum += height;
            count += 1;
            level = sum / f64::from(count);
        }
        let part =
            (temperature[cell] - lava.solid_temperature) / (lava.vent_temperature - lava.solid_temperature);
        let law = |solid: f64, vent: f64| solid * (vent / solid).powf(part);
        for n in 0..8 {
            let height = heights.iter().find(|(_, number)| *number == Some(n)).map(|(height, _)| *height);
            let thick =
                thickness[cell] > law(lava.solid_yield, lava.vent_yield) / (1.0 + steep[n] * steep[n]).sqrt();
            let wanted = match height {
                Some(height) if thick && thickness[cell] > 0.0 => {
                    law(lava.solid_rate, lava.vent_rate) * (level - height).max(0.0)
                }
                _ => 0.0,
            };
            assert!(
                (outflow[cell][n] - wanted).abs() < 1e-9,
                "cell {x}, {y} to {n}: {} not {wanted}",
                outflow[cell][n]
            );
            flowing += usize::from(wanted > 0.0);
        }
    }
    assert!(flowing > 10);
}

#[test]
fn same_bits() {
    let rates = vec![Rate { from: 0.0, volume: 40.0 }, Rate { from: 300.0, volume: 0.0 }];
    let slope = |site: Site| 100.0 - 4.0 * site.cell()[0] as f64 + 2.0 * site.random(0);
    let model = model([9, 7], SIDE, Lava::default(), vec![Vent { cell: [2, 3, 0], rates }], move |site| {
        Some(slope(site))
    })
    .unwrap();
    assert_same_bits(&model, 12);
}
