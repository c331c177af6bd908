//! Initial values from outside of a model, on every engine.

use std::error::Error;
use xca_core::prelude::*;
use xca_tests::suite::engines::{self, PRECISIONS};

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Ground {
    altitude: Real,
    kind: u8,
    debris: i32,
    wind: Vector2<Real>,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Water {
    altitude: f32,
    drops: u32,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Worm {
    length: f32,
}

fn model() -> Result<Model, ModelError> {
    Model::builder("ground")
        .extents([3, 2, 1])
        .substates::<Ground>()
        .substates::<Water>()
        .population::<Worm>(1)
        .fill(|_| Ground { altitude: 7.0, kind: 7, debris: 7, wind: Vector2::splat(7.0) })
        .fill(|_| Water { altitude: 7.0, drops: 7 })
        .build()
}

#[test]
fn a_substate_begins_with_the_values_that_it_is_given_and_the_others_with_the_models()
-> Result<(), Box<dyn Error>> {
    let mut model = model()?;
    let altitudes = vec![0.1, -2.5, 1e-30, 3.0, 4.0, -0.0];
    model.set_initial("Ground.altitude", altitudes.clone())?;
    model.set_initial("kind", vec![0.0, 255.0, 1.0, 2.0, 3.0, 4.0])?;
    model.set_initial("debris", vec![-2_147_483_648.0, 2_147_483_647.0, 0.0, -1.0, 1.0, 2.0])?;
    // A cell without a value keeps the model's own.
    model.set_initial("wind.y", [None, Some(2.0), None, Some(3.0), None, None])?;
    model.set_initial("drops", vec![4_294_967_295.0, 0.0, 1.0, 2.0, 3.0, 4.0])?;
    for precision in PRECISIONS {
        let stored = |value: f64| if precision == Precision::F32 { f64::from(value as f32) } else { value };
        for engine in engines::all()? {
            let options = RunOptions { precision, seed: 1 };
            let mut simulation = Simulation::new(&model, &*engine, options)?;
            let state = simulation.state();
            let read: Vec<u64> = state.read(Ground::ALTITUDE)?.into_iter().map(f64::to_bits).collect();
            let wanted: Vec<u64> = altitudes.iter().map(|value| stored(*value).to_bits()).collect();
            assert_eq!(read, wanted, "{} {precision}", engine.name());
            assert_eq!(state.read(Ground::KIND)?, [0, 255, 1, 2, 3, 4]);
            assert_eq!(state.read(Ground::DEBRIS)?, [i32::MIN, i32::MAX, 0, -1, 1, 2]);
            assert_eq!(state.read(Water::DROPS)?, [u32::MAX, 0, 1, 2, 3, 4]);
            assert_eq!(state.read(Water::ALTITUDE)?, [7.0; 6]);
            let wind = [7.0, 2.0, 7.0, 3.0, 7.0, 7.0].map(|y| Vector2::new(7.0, y));
            assert_eq!(state.read(Ground::WIND)?, wind);
        }
    }
    Ok(())
}

#[test]
fn what_a_substate_cannot_have_is_refused_when_it_is_given() -> Result<(), Box<dyn Error>> {
    let mut model = model()?;
    let mut refusal = |name: &str, values: Vec<f64>| {
        model.set_initial(name, values).map_or_else(|error| error.to_string(), |()| "accepted".to_owned())
    };
    let with = |value: f64| vec![0.0, 0.0, 0.0, 0.0, value, 0.0];
    assert_eq!(
        refusal("height", vec![0.0; 6]),
        "unknown substate of cells `height`; there are Ground.altitude, Ground.kind, Ground.debris, Ground.wind, \
         Water.altitude, Water.drops"
    );
    assert_eq!(
        refusal("altitude", vec![0.0; 6]),
        "several substates are called `altitude`; say which one: Ground.altitude, Water.altitude"
    );
    assert!(refusal("length", vec![0.0; 6]).starts_with("unknown substate of cells `length`"));
    assert_eq!(
        refusal("wind", vec![0.0; 6]),
        "`wind` is a Vector2<Real>; give one of its components, such as `wind.x`"
    );
    assert_eq!(refusal("kind", vec![0.0; 5]), "`kind` has 6 values, one for each cell, but 5 are given");
    for (name, value) in [("kind", 256.0), ("kind", 0.5), ("drops", -1.0), ("debris", 2_147_483_648.0)] {
        let message = refusal(name, with(value));
        assert!(
            message.starts_with(&format!("{value} in cell [1, 1, 0] is no value for `{name}`")),
            "{message}"
        );
    }
    for value in [f64::NAN, f64::INFINITY] {
        assert!(
            refusal("Water.altitude", with(value))
                .contains("in cell [1, 1, 0] is no value for `Water.altitude`, which is a f32")
        );
    }
    Ok(())
}
