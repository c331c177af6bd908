//! Random numbers of different processes, populations and structs of cells have nothing to do with each
//! other, on every engine.

use std::error::Error;
use xca_core::prelude::*;
use xca_tests::suite::engines;

/// Each of ten cells and of twice ten items draws so many times.
const OWNERS: usize = 10;
const STEPS: u64 = 1000;

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Ground {
    first: Real,
    second: Real,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Sky {
    number: Real,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Ant {
    number: Real,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Bee {
    number: Real,
}

#[elementary_process]
fn draw_first(cell: &mut Cell<Ground>) {
    cell.first = cell.random(0);
}

#[elementary_process]
fn draw_second(cell: &mut Cell<Ground>) {
    cell.second = cell.random(0);
}

#[elementary_process]
fn draw_in_the_sky(cell: &mut Cell<Sky>) {
    cell.number = cell.random(0);
}

#[elementary_process]
fn draw_as_ant(me: &mut Slot<Ant>) {
    me.number = me.random(0);
}

#[elementary_process]
fn draw_as_bee(me: &mut Slot<Bee>) {
    me.number = me.random(0);
}

fn item<S>(label: u32, state: S) -> Item<S> {
    Item { label, cell: [label as usize, 0, 0], state }
}

fn model() -> Result<Model, ModelError> {
    Model::builder("draws")
        .extents([OWNERS, 1, 1])
        .substates::<Ground>()
        .substates::<Sky>()
        .population::<Ant>(1)
        .population::<Bee>(1)
        .process(draw_first)
        .process(draw_second)
        .process(draw_in_the_sky)
        .process(draw_as_ant)
        .process(draw_as_bee)
        .initialise(|state| {
            let labels = 0..OWNERS as u32;
            state.set_items(labels.clone().map(|label| item(label, Ant { number: 0.0 })).collect())?;
            Ok(state.set_items(labels.map(|label| item(label, Bee { number: 0.0 })).collect())?)
        })
        .build()
}

/// The numbers of each sequence: of both processes over the ground, the sky, the ants, the bees.
fn sequences(engine: &dyn Engine) -> Result<Vec<Vec<f64>>, Box<dyn Error>> {
    let mut simulation = Simulation::new(&model()?, engine, RunOptions { seed: 5, ..Default::default() })?;
    let mut all = vec![Vec::new(); 5];
    for _ in 0..STEPS {
        simulation.step()?;
        let state = simulation.state();
        let now = [
            state.read(Ground::FIRST)?,
            state.read(Ground::SECOND)?,
            state.read(Sky::NUMBER)?,
            state.read(Ant::NUMBER)?,
            state.read(Bee::NUMBER)?,
        ];
        all.iter_mut().zip(now).for_each(|(sequence, numbers)| sequence.extend(numbers));
    }
    Ok(all)
}

/// Pearson's coefficient.
fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (mean_a, mean_b) = (mean(a), mean(b));
    let product = |x: &[f64], of_x: f64, y: &[f64], of_y: f64| -> f64 {
        x.iter().zip(y).map(|(x, y)| (x - of_x) * (y - of_y)).sum()
    };
    product(a, mean_a, b, mean_b) / (product(a, mean_a, a, mean_a) * product(b, mean_b, b, mean_b)).sqrt()
}

#[test]
fn equal_draws_of_different_owners_are_independent() -> Result<(), Box<dyn Error>> {
    let mut first: Option<Vec<Vec<f64>>> = None;
    for engine in engines::all()? {
        let all = sequences(&*engine)?;
        for (number, a) in all.iter().enumerate() {
            let mean = a.iter().sum::<f64>() / a.len() as f64;
            // Five standard errors of 10,000 uniform numbers, and of a correlation of as many.
            assert!((mean - 0.5).abs() < 0.0145, "{number}: mean {mean}");
            for (other, b) in all.iter().enumerate().skip(number + 1) {
                let r = correlation(a, b);
                assert!(r.abs() < 0.05, "{number} and {other}: {r}");
            }
        }
        assert_eq!(*first.get_or_insert_with(|| all.clone()), all, "{}", engines::describe(&*engine));
    }
    Ok(())
}

/// A process that stands in the model twice draws other numbers the second time; one that is run alone, those
/// of its place.
#[test]
fn the_place_in_the_step_counts() -> Result<(), Box<dyn Error>> {
    let model = Model::builder("twice")
        .extents([OWNERS, 1, 1])
        .substates::<Sky>()
        .process(draw_in_the_sky)
        .process(draw_in_the_sky)
        .build()?;
    for engine in engines::all()? {
        let mut simulation = Simulation::new(&model, &*engine, RunOptions::default())?;
        let mut after = |process| -> Result<Vec<f64>, Box<dyn Error>> {
            simulation.run_process(process)?;
            Ok(simulation.state().read(Sky::NUMBER)?)
        };
        let (first, second) = (after(0)?, after(1)?);
        assert!(first.iter().zip(&second).all(|(first, second)| first != second));
        assert_eq!(after(0)?, first);
        simulation.step()?;
        assert_eq!(simulation.state().read(Sky::NUMBER)?, second);
    }
    Ok(())
}

#[test]
fn more_processes_than_streams_are_refused() {
    let empty = Model::builder("many").extents([1, 1, 1]).substates::<Sky>();
    let full = (0..xca_core::Stream::PROCESSES).fold(empty, |builder, _| builder.process(draw_in_the_sky));
    let error = full.process(draw_in_the_sky).build().expect_err("one too many");
    assert_eq!(error, ModelError::TooManyProcesses { processes: 32_769, limit: 32_768 });
}
