//! Runs single processes.

use xca_core::prelude::*;
use xca_core::{ElementaryProcess, GroupSnapshot};

pub(crate) const PRECISIONS: [Precision; 2] = [Precision::F32, Precision::F64];

/// A builder for a model of a single cell.
pub(crate) fn single_cell<S: Substates + Copy>(before: S) -> ModelBuilder {
    Model::builder("one cell").extents([1, 1, 1]).substates::<S>().fill(move |_| before)
}

/// The state of all cells after one step.
pub(crate) fn step<S: Substates>(model: &Model, precision: Precision) -> Result<Vec<S>, RunError> {
    let mut simulation =
        Simulation::new(model, &Reference, RunOptions { precision, ..RunOptions::default() })?;
    simulation.step()?;
    Ok(cells(&simulation, precision))
}

/// The state of all cells of the group `S`.
pub(crate) fn cells<S: Substates>(simulation: &Simulation, precision: Precision) -> Vec<S> {
    let snapshot = simulation.snapshot().expect("a state");
    let group = simulation.model().group_of::<S>().expect("the model has the substates");
    let GroupSnapshot::Cells(fields) = &snapshot.groups[group] else { panic!("these are items") };
    let sizes: Vec<usize> =
        S::SCHEMA.fields.iter().map(|field| field.value_type.stored(precision).size()).collect();
    (0..simulation.model().geometry().cells())
        .map(|cell| {
            S::decode(precision, |field| &fields[field][cell * sizes[field]..(cell + 1) * sizes[field]])
        })
        .collect()
}

/// The cell of a model of one cell after one step of one process, in one precision.
pub(crate) fn run_in<S: Substates + Copy, P: ElementaryProcess + Copy>(
    process: P,
    before: S,
    precision: Precision,
) -> S {
    let model = single_cell(before).process(process).build().expect("the model is right");
    step(&model, precision).expect("the step succeeds").remove(0)
}

/// The cell after one step, which must be the same in both precisions.
pub(crate) fn run<S, P>(process: P, before: S) -> S
where
    S: Substates + Copy + PartialEq + std::fmt::Debug,
    P: ElementaryProcess + Copy,
{
    let [single, double] = PRECISIONS.map(|precision| run_in(process, before, precision));
    assert_eq!(single, double);
    double
}

/// The error of a step of one process on one cell.
pub(crate) fn failure<S: Substates + Copy, P: ElementaryProcess + Copy>(process: P, before: S) -> String {
    let model = single_cell(before).process(process).build().expect("the model is right");
    let errors = PRECISIONS.map(|precision| match step::<S>(&model, precision) {
        Ok(_) => panic!("the step must fail"),
        Err(error) => error.to_string(),
    });
    assert_eq!(errors[0], errors[1]);
    let [error, _] = errors;
    error
}
