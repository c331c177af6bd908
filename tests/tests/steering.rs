//! When steering operations run, in which order, and what they draw.

use std::error::Error;
use std::sync::{Arc, Mutex};
use xca_core::prelude::*;
use xca_tests::suite::engines;

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Vent {
    lava: u32,
    drawn: Real,
}

#[elementary_process]
fn rest(cell: &mut Cell<Vent>) {
    cell.lava += 0;
}

fn builder() -> ModelBuilder {
    Model::builder("vent").extents([2, 1, 1]).substates::<Vent>().process(rest)
}

#[test]
fn schedules_run_when_they_say() -> Result<(), Box<dyn Error>> {
    let seen: Arc<Mutex<Vec<(&str, u64)>>> = Arc::default();
    let note = |name: &'static str| {
        let seen = Arc::clone(&seen);
        move |state: &mut State<'_>| -> Result<(), SteeringError> {
            seen.lock().map_err(|_| "a thread has panicked")?.push((name, state.step()));
            Ok(())
        }
    };
    let model = builder()
        .steer(Schedule::Every(2), note("every"))
        .steer(Schedule::EveryFromStart(2), note("from start"))
        .steer(Schedule::EveryFromStart(3), note("thirds"))
        .steer(Schedule::At(vec![0, 3]), note("at"))
        .steer(Schedule::End, note("end"))
        .initialise(note("start"))
        .build()?;
    let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
    simulation.run(5)?;
    simulation.finish()?;
    let wanted = [
        ("start", 0),
        ("from start", 0),
        ("thirds", 0),
        ("at", 0),
        ("every", 2),
        ("from start", 2),
        ("thirds", 3),
        ("at", 3),
        ("every", 4),
        ("from start", 4),
        ("end", 5),
    ];
    assert_eq!(*seen.lock().expect("no thread has panicked"), wanted);
    Ok(())
}

/// A vent that is open from the start adds to the initial state; one that begins with a step does not.
#[test]
fn a_vent_from_the_start() -> Result<(), Box<dyn Error>> {
    let erupt = |state: &mut State<'_>| -> Result<(), SteeringError> {
        let lava = state.get(Vent::LAVA, [0, 0, 0])?;
        Ok(state.set(Vent::LAVA, [0, 0, 0], lava + 1)?)
    };
    for engine in engines::all()? {
        for (schedule, wanted) in [(Schedule::EveryFromStart(1), 5), (Schedule::Every(1), 4)] {
            let model = builder().steer(schedule, erupt).build()?;
            let mut simulation = Simulation::new(&model, &*engine, RunOptions::default())?;
            assert_eq!(simulation.state().sum(Vent::LAVA)?, wanted - 4);
            simulation.run(4)?;
            assert_eq!(simulation.state().sum(Vent::LAVA)?, wanted);
        }
    }
    Ok(())
}

/// A criterion that is met by the initial state stops the run before its first step.
#[test]
fn a_criterion_from_the_start() -> Result<(), Box<dyn Error>> {
    let cold = |state: &mut State<'_>| -> Result<Option<String>, SteeringError> {
        Ok((state.sum(Vent::LAVA)? == 0).then(|| "cold".to_owned()))
    };
    for (schedule, steps) in [(Schedule::EveryFromStart(1), 0), (Schedule::Every(1), 1)] {
        let model = builder().stop_when(schedule, cold).build()?;
        let mut simulation = Simulation::new(&model, &Reference, RunOptions::default())?;
        assert_eq!(simulation.run(9)?, Outcome::Stopped { reason: "cold".to_owned() });
        assert_eq!(simulation.step_number(), steps);
    }
    Ok(())
}

/// Each operation has random numbers of its own, in each step others, and the same in every run with one
/// seed.
#[test]
fn operations_draw() -> Result<(), Box<dyn Error>> {
    let draw = |cell: usize| {
        move |state: &mut State<'_>| -> Result<(), SteeringError> {
            let drawn = state.random(0);
            Ok(state.set(Vent::DRAWN, [cell, 0, 0], drawn)?)
        }
    };
    let model = builder()
        .steer(Schedule::EveryFromStart(1), draw(0))
        .steer(Schedule::EveryFromStart(1), draw(1))
        .build()?;
    let mut all = Vec::new();
    for engine in engines::all()? {
        let mut simulation = Simulation::new(&model, &*engine, RunOptions { seed: 3, ..Default::default() })?;
        let mut numbers = simulation.state().read(Vent::DRAWN)?;
        simulation.step()?;
        numbers.extend(simulation.state().read(Vent::DRAWN)?);
        assert!(numbers.iter().all(|number| (0.0..1.0).contains(number)));
        let mut sorted = numbers.clone();
        sorted.sort_by(f64::total_cmp);
        sorted.dedup();
        assert_eq!(sorted.len(), 4);
        all.push(numbers);
    }
    all.dedup();
    assert_eq!(all.len(), 1);
    Ok(())
}
