//! The model on all engines: each must come to the same state, cell by cell.

use new_model::{Medium, model};
use xca_run::prelude::*;
use xca_run::{EngineError, EngineName, EngineOptions};

/// The state after so many steps.
fn after(steps: u64, engine: EngineName) -> Result<Vec<u32>, EngineError> {
    let engine = engine.engine(&EngineOptions::default())?;
    let model = model().expect("the model makes sense");
    let mut simulation = Simulation::new(&model, &*engine, RunOptions::default()).expect("the model begins");
    simulation.run(steps).expect("the model runs");
    Ok(simulation.state().read(Medium::PHASE).expect("the state is read"))
}

#[test]
fn all_cores_give_what_the_reference_gives() {
    let reference = after(50, EngineName::Reference).expect("this engine is always there");
    assert_eq!(after(50, EngineName::Cpu).expect("this engine is always there"), reference);
    assert_ne!(after(51, EngineName::Reference).expect("this engine is always there"), reference);
}

#[test]
fn the_gpu_gives_what_the_reference_gives_where_there_is_one() {
    match after(50, EngineName::Gpu) {
        Ok(found) => {
            assert_eq!(found, after(50, EngineName::Reference).expect("this engine is always there"));
        }
        // A machine without an adapter cannot test it; `cargo test -- --nocapture` shows these words.
        Err(error) => {
            let error = error.to_string();
            assert!(error.contains("no graphics adapter was found"), "{error}");
            println!("the gpu engine is NOT tested here: {error}");
        }
    }
}
