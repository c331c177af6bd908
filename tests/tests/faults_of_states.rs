//! Questions and orders to a state that the model has no answer to, on every engine; and steering that fails.

use std::error::Error;
use xca_core::prelude::*;
use xca_core::reduction::Reduction;
use xca_core::{Fault, ParameterError, StateError};
use xca_tests::suite::engines;

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Soil {
    water: Real,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Worm {
    length: f32,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Stranger {
    age: u32,
}

#[derive(Parameters, Clone, Copy, Debug, PartialEq)]
struct Weather {
    rain: Real,
    days: u32,
    wind: Vector2<Real>,
}

#[derive(Parameters, Clone, Copy, Debug, PartialEq)]
struct Climate {
    rain: Real,
}

#[elementary_process]
fn seep(cell: &mut Cell<Soil>, p: &Weather) {
    cell.water += p.rain;
}

fn worm(label: u32, cell: [usize; 3]) -> Item<Worm> {
    Item { label, cell, state: Worm { length: label as f32 } }
}

fn model() -> Result<Model, ModelError> {
    Model::builder("garden")
        .extents([3, 2, 2])
        .parameters(Weather { rain: 1.0, days: 3, wind: Vector2::splat(0.0) })
        .substates::<Soil>()
        .population::<Worm>(2)
        .process(seep)
        .initialise(|state| Ok(state.set_items(vec![worm(1, [0; 3]), worm(8, [2, 1, 1])])?))
        .build()
}

/// Does something that must fail with this error and message, and change nothing.
fn refused<T: std::fmt::Debug>(
    wanted: &StateError,
    message: &str,
    order: impl Fn(&mut State<'_>) -> Result<T, StateError>,
) -> Result<(), Box<dyn Error>> {
    let model = model()?;
    for engine in engines::all()? {
        let mut simulation = Simulation::new(&model, &*engine, RunOptions::default())?;
        simulation.step()?;
        let before = simulation.snapshot()?;
        let error = order(&mut simulation.state()).expect_err("a state error");
        assert_eq!(&error, wanted, "{}", engines::describe(&*engine));
        assert_eq!(error.to_string(), message);
        assert!(simulation.snapshot()? == before, "{message}: the state has changed");
        simulation.step()?;
    }
    Ok(())
}

#[test]
fn substates() -> Result<(), Box<dyn Error>> {
    let unknown = StateError::UnknownSubstates("Stranger");
    let message = "the model has no substates `Stranger`";
    refused(&unknown, message, |state| state.read(Stranger::AGE))?;
    refused(&unknown, message, |state| state.write(Stranger::AGE, &[1]))?;
    refused(&unknown, message, |state| state.get(Stranger::AGE, [0; 3]))?;
    refused(&unknown, message, |state| state.set(Stranger::AGE, [0; 3], 1))?;
    refused(&unknown, message, |state| state.sum(Stranger::AGE))?;
    refused(&unknown, message, |state| state.count(Stranger::AGE, 1))?;
    refused(&unknown, message, |state| state.items::<Stranger>())?;
    refused(&unknown, message, |state| state.count_left::<Stranger>())?;
    let cells = StateError::NotAPopulation("Soil");
    let message = "`Soil` are the substates of cells, not of a population";
    refused(&cells, message, |state| state.items::<Soil>())?;
    refused(&cells, message, |state| state.set_items::<Soil>(Vec::new()))?;
    refused(&cells, message, |state| state.count_items::<Soil>())?;
    refused(&cells, message, |state| state.largest_occupancy::<Soil>())?;
    let items = StateError::NotOfCells("Worm");
    let message = "`Worm` is a population; its items are not numbered by cells";
    refused(&items, message, |state| state.get(Worm::LENGTH, [0; 3]))?;
    refused(&items, message, |state| state.set(Worm::LENGTH, [0; 3], 1.0))
}

#[test]
fn cells_and_numbers() -> Result<(), Box<dyn Error>> {
    let outside = StateError::NoSuchCell { cell: [0, 2, 0], extents: [3, 2, 2] };
    let message = "the space of [3, 2, 2] cells has no cell [0, 2, 0]";
    refused(&outside, message, |state| state.get(Soil::WATER, [0, 2, 0]))?;
    refused(&outside, message, |state| state.set(Soil::WATER, [0, 2, 0], 1.0))?;
    refused(&outside, message, |state| state.set_items(vec![worm(3, [0, 0, 0]), worm(2, [0, 2, 0])]))?;
    let number = StateError::WrongNumber { substate: "water", wanted: 12, given: 3 };
    refused(&number, "`water` has 12 values, but 3 are given", |state| state.write(Soil::WATER, &[1.0; 3]))?;
    let number = StateError::WrongNumber { substate: "length", wanted: 2, given: 12 };
    refused(&number, "`length` has 2 values, but 12 are given", |state| state.write(Worm::LENGTH, &[1.0; 12]))
}

#[test]
fn reductions() -> Result<(), Box<dyn Error>> {
    let message = "`water` holds floating numbers, whose bits cannot be reduced; use a logical reduction, or a substate of integers";
    refused(&StateError::BitsOfFloats("water"), message, |state| {
        state.reduce(Soil::WATER, &Reduction::BitXor)
    })
}

#[test]
fn items() -> Result<(), Box<dyn Error>> {
    refused(&StateError::LabelTwice(5), "the label 5 is given to two items", |state| {
        state.set_items(vec![worm(5, [0, 0, 0]), worm(6, [0, 0, 0]), worm(5, [2, 1, 1])])
    })?;
    let full = StateError::Fault(Fault::CellFull { process: None, cell: [1, 1, 0], items: 3, slots: 2 });
    refused(&full, &full.to_string(), |state| {
        let crowd = (0..3).map(|label| worm(label, [1, 1, 0]));
        state.set_items(crowd.chain([worm(9, [0, 0, 0])]).collect())
    })
}

#[test]
fn parameters() -> Result<(), Box<dyn Error>> {
    let other = ParameterError::OtherStruct { wanted: "Climate", given: "Weather".to_owned() };
    let other = StateError::Parameter(other);
    let message = "the model has no parameters `Climate`; it has: Weather";
    refused(&other, message, |state| state.parameters::<Climate>())?;
    refused(&other, message, |state| state.set_parameters(Climate { rain: 0.0 }))?;
    let unknown = StateError::Parameter(ParameterError::Unknown {
        name: "snow".to_owned(),
        known: "rain, days, wind".to_owned(),
    });
    let message = "no parameter is called `snow`; known parameters: rain, days, wind";
    refused(&unknown, message, |state| state.parameter("snow"))?;
    refused(&unknown, message, |state| state.set_parameter("snow", "1"))?;
    for (name, text, kind) in [
        ("rain", "much", "Real"),
        ("rain", "inf", "Real"),
        ("days", "2.5", "u32"),
        ("days", "-1", "u32"),
        ("days", "4294967296", "u32"),
        ("wind", "1", "Vector2<Real>"),
        ("wind", "1, 2, 3", "Vector2<Real>"),
        ("wind", "1; 2", "Vector2<Real>"),
    ] {
        let model = model()?;
        for engine in engines::all()? {
            let mut simulation = Simulation::new(&model, &*engine, RunOptions::default())?;
            let error = simulation.state().set_parameter(name, text).expect_err("no value");
            assert!(matches!(error, StateError::Parameter(ParameterError::Invalid { .. })), "{error:?}");
            assert_eq!(
                error.to_string(),
                format!("`{text}` is no value for the parameter `{name}`, which is a {kind}")
            );
        }
    }
    Ok(())
}

#[test]
fn processes() -> Result<(), Box<dyn Error>> {
    let model = model()?;
    for engine in engines::all()? {
        let mut simulation = Simulation::new(&model, &*engine, RunOptions::default())?;
        let error = simulation.run_process(1).expect_err("no such process");
        assert!(matches!(error, RunError::NoSuchProcess { index: 1, processes: 1 }));
        assert_eq!(error.to_string(), "the model has 1 processes, no process 1");
        simulation.step()?;
    }
    Ok(())
}

/// An error of steering names the step; the state stays that of a whole step, so that a run may go on.
#[test]
fn steering() -> Result<(), Box<dyn Error>> {
    let builder = |schedule| {
        Model::builder("garden").extents([2, 2, 2]).substates::<Soil>().steer(schedule, |state| {
            state.set(Soil::WATER, [0, 0, 5], 1.0)?;
            Ok(())
        })
    };
    for engine in engines::all()? {
        let start = |schedule| -> Result<_, Box<dyn Error>> {
            Ok(Simulation::new(&builder(schedule).build()?, &*engine, RunOptions::default()))
        };
        for schedule in [Schedule::Start, Schedule::At(vec![0])] {
            let error = start(schedule)?.expect_err("steering fails");
            let cause = "the space of [2, 2, 2] cells has no cell [0, 0, 5]";
            assert_eq!(error.to_string(), format!("steering after step 0 failed: {cause}"));
        }
        let mut simulation = start(Schedule::At(vec![2]))??;
        assert!(matches!(simulation.run(4), Err(RunError::Steering { step: 2, .. })));
        assert_eq!(simulation.step_number(), 2);
        simulation.run(2)?;
        let mut simulation = start(Schedule::End)??;
        simulation.run(2)?;
        assert!(matches!(simulation.finish(), Err(RunError::Steering { step: 2, .. })));
    }
    Ok(())
}
