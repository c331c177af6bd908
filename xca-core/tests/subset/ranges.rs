//! Parameters with ranges and computed ones, wherever their values come from.

use crate::common::PRECISIONS;
use xca_core::prelude::*;

#[derive(Substates, Clone, Copy, Debug, PartialEq, Default)]
struct Fluid {
    density: Real,
}

const FASTEST: f64 = 0.5;

#[derive(Parameters, Clone, Debug)]
struct Flow {
    #[parameter(range = 1.0..=1000.0)]
    reynolds: Real,
    #[parameter(unit = "m/s", range = 0.0..FASTEST)]
    speed: Real,
    #[parameter(range = 2..=64)]
    width: u32,
    #[parameter(range = ..=1.0)]
    shares: [Real; 2],
    /// Viscosity of the fluid.
    #[parameter(computed, positive)]
    viscosity: Real,
    free: Real,
}

fn flow() -> Flow {
    Flow { reynolds: 100.0, speed: 0.1, width: 10, shares: [0.5, 1.0], viscosity: 0.0, free: 0.0 }
}

fn builder(flow: Flow) -> ModelBuilder {
    Model::builder("flow").extents([2, 1, 1]).substates::<Fluid>().parameters(flow).compute_parameters(
        |flow: &mut Flow| flow.viscosity = flow.speed * f64::from(flow.width) / flow.reynolds,
    )
}

fn message(flow: Flow) -> String {
    builder(flow).build().expect_err("out of range").to_string()
}

#[test]
fn a_model_is_not_built_with_values_out_of_range() {
    assert_eq!(
        message(Flow { reynolds: 0.5, ..flow() }),
        "the parameter `reynolds` is 0.5, but must be at least 1 and at most 1000"
    );
    assert_eq!(
        message(Flow { speed: FASTEST, ..flow() }),
        "the parameter `speed` is 0.5, but must be at least 0 and below 0.5 (m/s)"
    );
    assert_eq!(
        message(Flow { width: 1, ..flow() }),
        "the parameter `width` is 1, but must be at least 2 and at most 64"
    );
    assert_eq!(
        message(Flow { shares: [0.0, 1.5], ..flow() }),
        "the parameter `shares` is 1.5, but must be at most 1"
    );
    // What is computed has a range too.
    assert_eq!(message(Flow { speed: 0.0, ..flow() }), "the parameter `viscosity` is 0, but must be above 0");
    assert_eq!(
        message(Flow { free: f64::NAN, ..flow() }),
        "the parameter `free` is NaN, but must be any number"
    );
    assert!(builder(Flow { free: f64::INFINITY, ..flow() }).build().is_ok());
}

#[test]
fn what_is_computed_follows_the_others() {
    let mut model = builder(flow()).build().unwrap();
    assert_eq!(model.parameters().get::<Flow>().unwrap().viscosity, 0.1 * 10.0 / 100.0);
    model.set_parameter("reynolds", "400").unwrap();
    assert_eq!(model.parameters().get::<Flow>().unwrap().viscosity, 0.1 * 10.0 / 400.0);
    let error = model.set_parameter("viscosity", "1").unwrap_err().to_string();
    assert_eq!(error, "the parameter `viscosity` is computed from others; set those");
    let error = model.set_parameter("reynolds", "1e9").unwrap_err().to_string();
    assert_eq!(error, "the parameter `reynolds` is 1000000000, but must be at least 1 and at most 1000");
    assert_eq!(model.parameters().get::<Flow>().unwrap().reynolds, 400.0, "it is what it was");
    for precision in PRECISIONS {
        let options = RunOptions { precision, ..RunOptions::default() };
        let mut simulation = Simulation::new(&model, &Reference, options).unwrap();
        let mut state = simulation.state();
        state.set_parameter("width", "20").unwrap();
        assert_eq!(state.parameters::<Flow>().unwrap().viscosity, 0.1 * 20.0 / 400.0);
        state.set_parameters(Flow { width: 40, viscosity: 77.0, ..flow() }).unwrap();
        assert_eq!(state.parameters::<Flow>().unwrap().viscosity, 0.1 * 40.0 / 100.0);
        let error = state.set_parameters(Flow { width: 65, ..flow() }).unwrap_err().to_string();
        assert_eq!(error, "the parameter `width` is 65, but must be at least 2 and at most 64");
        assert!(state.set_parameter("speed", "-0.1").is_err());
        assert_eq!(state.parameters::<Flow>().unwrap().width, 40);
    }
}

/// A number may lie in its range in f64 and outside of it in f32.
#[test]
fn a_range_holds_in_the_precision_of_the_run() {
    let start = |flow: Flow, precision: Precision| {
        let model = builder(flow).build().unwrap();
        let options = RunOptions { precision, ..RunOptions::default() };
        Simulation::new(&model, &Reference, options).map(|_| ()).map_err(|error| error.to_string())
    };
    let nearly = Flow { speed: FASTEST - 1e-12, ..flow() };
    assert_eq!(start(nearly.clone(), Precision::F64), Ok(()));
    assert_eq!(
        start(nearly, Precision::F32),
        Err("the parameter `speed` is 0.499999999999 (0.5 in f32), but must be at least 0 and below 0.5 (m/s)".to_owned())
    );
    let huge = Flow { free: 1e300, ..flow() };
    assert_eq!(start(huge.clone(), Precision::F64), Ok(()));
    assert_eq!(
        start(huge, Precision::F32),
        Err("the parameter `free` is 1e300 (inf in f32), but must be any number".to_owned())
    );
}

#[test]
fn a_snapshot_with_a_value_out_of_range_is_refused() {
    let model = builder(flow()).build().unwrap();
    let mut simulation = Simulation::new(&model, &Reference, RunOptions::default()).unwrap();
    let mut snapshot = simulation.snapshot().unwrap();
    snapshot.parameters[0] = vec![f64::NAN.to_bits()];
    let error = simulation.restore(&snapshot).unwrap_err().to_string();
    assert_eq!(
        error,
        "the snapshot does not fit the model `flow`: the parameter `reynolds` is NaN, but must be at least 1 and at most 1000"
    );
}
