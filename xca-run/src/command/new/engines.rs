//! Every engine must come to the same state, to the last bit.

use new_model::{Health, Person, model};
use xca::prelude::*;
use xca::run::{EngineError, EngineOptions, Engines};
use xca::{Snapshot, StateError};

/// The model after some steps on an engine.
fn run(steps: u64, engine: &str) -> Result<Simulation, EngineError> {
    let engine = Engines::default().engine(engine, &EngineOptions::default())?;
    let model = model().expect("the model is complete");
    let mut simulation = Simulation::new(&model, &*engine, RunOptions::default()).expect("the model starts");
    simulation.run(steps).expect("the model runs");
    Ok(simulation)
}

fn snapshot(steps: u64, engine: &str) -> Result<Snapshot, EngineError> {
    run(steps, engine).map(|simulation| simulation.snapshot().expect("the state can be read"))
}

#[test]
fn all_cores_agree_with_the_reference() {
    let reference = snapshot(50, "reference").expect("this engine is always there");
    let cpu = snapshot(50, "cpu").expect("this engine is always there");
    assert!(cpu == reference);
    let later = snapshot(51, "reference").expect("this engine is always there");
    assert!(later != reference);
}

/// With `cargo test --features gpu`, on a machine that has a graphics adapter or software Vulkan.
#[test]
fn the_gpu_agrees_with_the_reference() {
    match snapshot(50, "gpu") {
        Ok(gpu) => {
            let reference = snapshot(50, "reference").expect("this engine is always there");
            assert!(gpu == reference);
        }
        // `cargo test -- --nocapture` shows these words.
        Err(error) => {
            let error = error.to_string();
            let expected = ["no graphics adapter was found", "without the feature `gpu`"];
            assert!(expected.iter().any(|reason| error.contains(reason)), "{error}");
            println!("the gpu engine is NOT tested here: {error}");
        }
    }
}

#[test]
fn the_infection_spreads_and_ends_in_immunity() -> Result<(), StateError> {
    let count = |steps: u64, health: Health| {
        let mut simulation = run(steps, "cpu").expect("this engine is always there");
        simulation.state().count(Person::HEALTH, health)
    };
    assert!(count(20, Health::Infected)? > count(0, Health::Infected)?);
    assert_eq!(count(7, Health::Immune)?, 0);
    assert!(count(30, Health::Immune)? > 0);
    Ok(())
}
