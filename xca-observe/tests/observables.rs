//! Observables against numbers by hand, and with the same bits on all engines.

use std::error::Error;
use xca_core::prelude::*;
use xca_cpu::Cpu;
use xca_observe::{Observable, measure};
use xca_parts::{Grid, Parts};

type TestResult = Result<(), Box<dyn Error>>;

#[derive(States, Clone, Copy, PartialEq)]
enum Soil {
    Sand,
    Clay,
}

#[derive(Substates, Clone, Copy)]
struct Ground {
    height: f64,
    age: u32,
    flow: Vector2<Real>,
    layers: [i32; 2],
    is_wet: bool,
    soil: Soil,
}

#[derive(Substates, Clone, Copy)]
struct Grain {
    mass: f32,
}

const EXTENTS: [usize; 3] = [3, 2, 2];

/// Cells are numbered from 0 to 11. Cell 4 has two grains, cell 7 one.
fn model() -> Result<Model, ModelError> {
    let number = |[x, y, z]: [usize; 3]| x + 3 * (y + 2 * z);
    Model::builder("ground")
        .extents(EXTENTS)
        .substates::<Ground>()
        .population::<Grain>(3)
        .fill(move |site| {
            let n = number(site.cell());
            Ground {
                height: n as f64 / 4.0,
                age: n as u32,
                flow: Vector2::new(n as f64, -1.0),
                layers: [-(n as i32), 5],
                is_wet: n < 5,
                soil: if n == 3 { Soil::Clay } else { Soil::Sand },
            }
        })
        .populate(move |site| {
            let count = match number(site.cell()) {
                4 => 2,
                7 => 1,
                _ => 0,
            };
            (0..count).map(|grain| Grain { mass: 1.5 + grain as f32 })
        })
        .build()
}

fn measured(model: &Model, missing: Option<&[bool]>) -> Result<Vec<(String, f64)>, Box<dyn Error>> {
    let simulation = Simulation::new(model, &Reference, RunOptions::default())?;
    Ok(measure(&simulation, missing)?.into_iter().map(|one| (one.name, one.value)).collect())
}

fn wanted(numbers: &[(&str, f64)]) -> Vec<(String, f64)> {
    numbers.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect()
}

#[test]
fn by_hand() -> TestResult {
    let all = [
        ("ground_height_min", 0.0),
        ("ground_height_mean", 66.0 / 48.0),
        ("ground_height_max", 2.75),
        ("ground_age_min", 0.0),
        ("ground_age_sum", 66.0),
        ("ground_age_max", 11.0),
        ("ground_flow_x_mean", 5.5),
        ("ground_flow_y_mean", -1.0),
        ("ground_layers_0_mean", -5.5),
        ("ground_layers_1_mean", 5.0),
        ("ground_is_wet_true", 5.0),
        ("ground_soil_Sand", 11.0),
        ("ground_soil_Clay", 1.0),
        ("grain_items", 3.0),
        ("grain_largest_occupancy", 2.0),
        ("grain_mass_min", 1.5),
        ("grain_mass_mean", 5.5 / 3.0),
        ("grain_mass_max", 2.5),
    ];
    assert_eq!(measured(&model()?, None)?, wanted(&all));
    Ok(())
}

/// Only cells 4 and 8 have ground; grains need none.
#[test]
fn cells_without_ground_count_for_nothing() -> TestResult {
    let missing: Vec<bool> = (0..12).map(|cell| cell != 4 && cell != 8).collect();
    let found = measured(&model()?, Some(&missing))?;
    let some = [
        ("ground_height_min", 1.0),
        ("ground_height_mean", 1.5),
        ("ground_height_max", 2.0),
        ("ground_age_min", 4.0),
        ("ground_age_sum", 12.0),
        ("ground_age_max", 8.0),
        ("ground_flow_x_mean", 6.0),
    ];
    assert_eq!(found[..7], wanted(&some));
    let last = [
        ("ground_is_wet_true", 1.0),
        ("ground_soil_Sand", 2.0),
        ("ground_soil_Clay", 0.0),
        ("grain_items", 3.0),
    ];
    assert_eq!(found[10..14], wanted(&last));
    assert_eq!(found[14..], measured(&model()?, None)?[14..], "grains");
    let none = measured(&model()?, Some(&[true; 12]))?;
    assert!(none[0].1.is_nan() && none[1].1.is_nan() && none[4].1 == 0.0, "{none:?}");
    Ok(())
}

#[derive(Substates, Clone, Copy)]
struct Star {
    mass: f64,
    flow: [f64; 2],
}

/// The sum of the numbers is infinite, their mean is not; also where some cells are left out, and where
/// values come in several blocks.
#[test]
fn means_of_the_largest_numbers_are_finite() -> TestResult {
    for extents in [[4, 3, 1], [64, 128, 100]] {
        let model = Model::builder("stars")
            .extents(extents)
            .substates::<Star>()
            .fill(|site| match site.cell() {
                [0, ..] => Star { mass: f64::NAN, flow: [f64::NAN; 2] },
                _ => Star { mass: 1.5e308, flow: [1.0, 1.25e308] },
            })
            .build()?;
        let missing: Vec<bool> = (0..model.geometry().cells()).map(|cell| cell % extents[0] == 0).collect();
        let simulation = Simulation::new(&model, &Cpu::with_threads(1)?, RunOptions::default())?;
        check_means(&measure(&simulation, Some(&missing))?);
    }
    Ok(())
}

fn check_means(found: &[Observable]) {
    let wanted = [
        ("mass_min", 1.5e308),
        ("mass_mean", 1.5e308),
        ("mass_max", 1.5e308),
        ("flow_0_mean", 1.0),
        ("flow_1_mean", 1.25e308),
    ];
    assert_eq!(found.len(), wanted.len());
    for (Observable { name, value, .. }, (wanted_name, wanted)) in found.iter().zip(wanted) {
        assert!(name == wanted_name && (value / wanted - 1.0).abs() < 1e-10, "{name}: {value}");
    }
}

#[derive(Substates, Clone, Copy)]
struct Air {
    heat: Real,
    wind: Vector3<Real>,
}

#[derive(Substates, Clone, Copy)]
struct Dust {
    mass: Real,
}

/// Sums whose last digits depend on the order, in blocks and at once.
#[test]
fn all_engines_observe_the_same_bits() -> TestResult {
    let model = Model::builder("air")
        .extents([17, 9, 6])
        .substates::<Air>()
        .population::<Dust>(4)
        .fill(|site| Air {
            heat: site.random(0) * 10.0_f64.powi(site.cell()[1] as i32),
            wind: Vector3::new(site.random(1), site.random(2) - 0.5, 1e-3),
        })
        .populate(|site| {
            let count = (site.random(3) * 4.0) as usize;
            (0..count).map(move |grain| Dust { mass: site.random(4 + grain) })
        })
        .build()?;
    for precision in [Precision::F32, Precision::F64] {
        let options = RunOptions { precision, seed: 5 };
        let on = |engine: &dyn Engine| -> Result<Vec<Observable>, Box<dyn Error>> {
            Ok(measure(&Simulation::new(&model, engine, options)?, None)?)
        };
        let mut reference = Simulation::new(&model, &Reference, options)?;
        let wanted = measure(&reference, None)?;
        assert!(on(&Cpu::with_threads(2)?)? == wanted, "{precision}");
        for grid in [Grid { y: 2, z: 1 }, Grid { y: 1, z: 3 }, Grid { y: 3, z: 2 }] {
            assert!(on(&Parts::with_grid(Cpu::with_threads(1)?, grid))? == wanted, "{precision} {grid}");
        }
        // As reductions of the model's own observables add.
        let mean = reference.state().sum(Air::HEAT)? / (17 * 9 * 6) as f64;
        assert_eq!(wanted[1], Observable::number("air_heat_mean", mean), "{precision}");
    }
    Ok(())
}
