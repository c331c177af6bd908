//! Input that does not fit, handed to engines directly: an error, and nothing has changed.

use std::error::Error;
use xca_core::engine::{EngineFailure, Execution, InputError, Population, StepContext, SubstateId};
use xca_core::prelude::*;
use xca_core::reduction::Reduction;
use xca_core::{Fault, ParameterSet};
use xca_tests::suite::engines;

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Soil {
    roots: u8,
    water: Real,
}

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Worm {
    #[position]
    position: Vector3<Real>,
    age: u32,
}

/// Looks at all neighbours' worms: with ranges that are no ranges it would look anywhere.
#[elementary_process]
fn age(me: &mut Slot<Worm>) {
    let mut near = 0;
    for other in me.others_within(1.0) {
        near += 1 + other.age;
    }
    me.age = near;
}

const SOIL: usize = 0;
const WORMS: usize = 1;
const ROOTS: SubstateId = SubstateId { group: SOIL, field: 0 };
const WATER: SubstateId = SubstateId { group: SOIL, field: 1 };
const AGE: SubstateId = SubstateId { group: WORMS, field: 1 };

fn model() -> Result<Model, ModelError> {
    Model::builder("garden")
        .extents([3, 2, 2])
        .neighbourhood(Neighbourhood::moore(1))
        .substates::<Soil>()
        .population::<Worm>(2)
        .process(age)
        .build()
}

/// Two worms in the first cell and one in the last, in `f64`.
fn worms() -> Population {
    let mut counts = vec![0; 12];
    (counts[0], counts[11]) = (2, 1);
    let positions = [[0.5, 0.5, 0.5], [0.6, 0.5, 0.5], [2.5, 1.5, 1.5]];
    let positions = positions.iter().flatten().flat_map(|along: &f64| along.to_ne_bytes()).collect();
    Population { counts, labels: vec![4, 7, 1], fields: vec![positions, vec![0; 12]] }
}

fn step(execution: &mut dyn Execution) -> Result<(), Fault> {
    execution.run(0..1, &StepContext { step: 0, seed: 0, parameters: &[], values: &ParameterSet::default() })
}

/// Hands something to each engine that it must refuse with this message; afterwards the state is what it was,
/// and steps go on.
fn refused(
    message: &str,
    order: impl Fn(&mut dyn Execution) -> Result<(), Fault>,
) -> Result<(), Box<dyn Error>> {
    let model = model()?;
    for engine in engines::all()? {
        let place = || format!("{message}, {}", engines::describe(&*engine));
        let mut execution = engine.start(&model, Precision::F64)?;
        execution.set_population(WORMS, &worms())?;
        execution.write(ROOTS, &[9; 12])?;
        let fault = order(&mut *execution).expect_err(&place());
        assert_eq!(fault.to_string(), message, "{}", place());
        assert!(execution.population(WORMS)? == worms(), "{}", place());
        assert_eq!(execution.read(ROOTS)?, [9; 12], "{}", place());
        assert_eq!(execution.read(WATER)?, [0; 96], "{}", place());
        step(&mut *execution)?;
        assert_eq!(execution.read(AGE)?, [[1_u32; 2].map(u32::to_ne_bytes).as_flattened(), &[0; 4]].concat());
    }
    Ok(())
}

#[test]
fn values_of_another_length() -> Result<(), Box<dyn Error>> {
    for given in [0, 11, 13, 96] {
        let message = format!("the values of `Soil.roots` take 12 bytes, but {given} are given");
        refused(&message, |execution| Ok(execution.write(ROOTS, &vec![1; given])?))?;
    }
    let message = "the values of `Worm.age` take 12 bytes, but 16 are given";
    refused(message, |execution| Ok(execution.write(AGE, &[1; 16])?))?;
    let message = "the values of `Soil.water` take 16 bytes, but 8 are given";
    refused(message, |execution| Ok(execution.write_cells(WATER, &[3, 4], &[1; 8])?))
}

#[test]
fn cells_and_substates_that_are_not_there() -> Result<(), Box<dyn Error>> {
    let message = "the space has 12 cells, no cell number 12";
    refused(message, |execution| Ok(execution.write_cells(ROOTS, &[0, 12], &[1, 1])?))?;
    refused(message, |execution| Ok(execution.read_cells(ROOTS, &[0, 12]).map(|_| ())?))?;
    let message = "`Worm` is a population; its items are not numbered by cells";
    refused(message, |execution| Ok(execution.write_cells(AGE, &[0], &[0; 4])?))?;
    refused(message, |execution| Ok(execution.read_cells(AGE, &[0]).map(|_| ())?))?;
    let substate = SubstateId { group: 0, field: 2 };
    refused("`Soil` has 2 substates, no number 2", |execution| Ok(execution.write(substate, &[0; 12])?))?;
    let substate = SubstateId { group: 2, field: 0 };
    let message = "the model has 2 structs of substates, no number 2";
    refused(message, |execution| Ok(execution.read(substate).map(|_| ())?))?;
    refused(message, |execution| Ok(execution.reduce(substate, &Reduction::Sum).map(|_| ())?))?;
    refused(message, |execution| Ok(execution.write_cells(substate, &[0], &[0])?))?;
    refused(message, |execution| execution.set_population(2, &worms()))
}

#[test]
fn populations_that_do_not_agree() -> Result<(), Box<dyn Error>> {
    let changed = |message: &str, change: &dyn Fn(&mut Population)| {
        refused(message, |execution| {
            let mut population = worms();
            change(&mut population);
            execution.set_population(WORMS, &population)
        })
    };
    changed("`Worm`: it has 3 items, but 4 in its cells", &|worms| worms.counts[5] = 1)?;
    changed("`Worm`: it has 3 items, but 1 in its cells", &|worms| worms.counts[0] = 0)?;
    changed("`Worm`: it has 11 cells, not 12", &|worms| worms.counts.truncate(11))?;
    changed("`Worm`: `position` takes 72 bytes, not the 0 of a run in f64", &|worms| worms.labels.clear())?;
    changed("`Worm`: `age` takes 8 bytes, not the 12 of a run in f64", &|worms| worms.fields[1].truncate(8))?;
    changed("`Worm`: it has 1 substates, not 2", &|worms| worms.fields.truncate(1))?;
    changed("`Worm`: the items of cell [0, 0, 0] are not in the order of their labels", &|worms| {
        worms.labels.swap(0, 1);
    })?;
    changed("`Worm`: the label 7 stands on two items", &|worms| worms.labels[2] = 7)?;
    let message =
        "cell [2, 1, 0] would hold 4294967295 items, but a cell has 2 slots; give the population more slots";
    changed(message, &|worms| worms.counts[5] = u32::MAX)?;
    refused("`Soil` are the substates of cells, not of a population", |execution| {
        execution.set_population(SOIL, &worms())
    })?;
    // What a caller can match on.
    let mut execution = Reference.start(&model()?, Precision::F64)?;
    let fault = execution.set_population(WORMS, &Population::default()).expect_err("no counts");
    assert!(matches!(fault, Fault::Engine(EngineFailure::Input(InputError::Items { .. }))), "{fault:?}");
    Ok(())
}

/// Values come and go in the order in which the cells are named, on every engine; of a cell that is named
/// twice the last value stays.
#[test]
fn cells_in_any_order() -> Result<(), Box<dyn Error>> {
    let model = model()?;
    let cells = [7, 0, 1, 2, 11, 6, 7];
    for engine in engines::all()? {
        let mut execution = engine.start(&model, Precision::F64)?;
        execution.write(ROOTS, &(0..12).collect::<Vec<u8>>())?;
        assert_eq!(execution.read_cells(ROOTS, &cells)?, [7, 0, 1, 2, 11, 6, 7]);
        execution.write_cells(ROOTS, &cells, &[70, 60, 61, 62, 80, 90, 77])?;
        assert_eq!(execution.read(ROOTS)?, [60, 61, 62, 3, 4, 5, 90, 77, 8, 9, 10, 80]);
        assert_eq!(execution.read_cells(ROOTS, &[])?, [0; 0]);
        execution.write_cells(ROOTS, &[], &[])?;
        let water: Vec<u8> = [1.5_f64, -2.0].iter().flat_map(|value| value.to_ne_bytes()).collect();
        execution.write_cells(WATER, &[4, 3], &water)?;
        assert_eq!(execution.read_cells(WATER, &[4, 3])?, water);
        assert_eq!(execution.read_cells(WATER, &[3])?, (-2.0_f64).to_ne_bytes());
    }
    Ok(())
}
