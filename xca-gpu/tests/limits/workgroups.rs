//! More workgroups along an axis than a dispatch holds.

use crate::common::{TestResult, assert_agrees, gpu};
use std::error::Error;
use xca_core::model::ModelBuilder;
use xca_core::prelude::*;
use xca_gpu::Handicap;

#[derive(Substates, Clone, Copy)]
struct Rule {
    alive: u8,
}

/// Wolfram's rule 110 along the axis of the neighbourhood.
#[elementary_process]
fn rule_110(cell: &mut Cell<Rule>) {
    let before = cell.neighbour(1).alive;
    let after = cell.neighbour(2).alive;
    let pattern = 4 * before + 2 * cell.alive + after;
    cell.alive = 110 >> pattern & 1;
}

/// Beside rule 110 it draws numbers, and stops in one of a thousand cells.
#[elementary_process]
fn stop_somewhere(cell: &mut Cell<Rule>) {
    if cell.random_bits(0) % 997 == 1 {
        cell.fault(3, cell.index().x as Real);
    }
}

fn rule(extents: [usize; 3], axis: usize) -> Result<ModelBuilder, Box<dyn Error>> {
    let along = |distance: i32| {
        let mut displacement = [0; 3];
        displacement[axis] = distance;
        displacement
    };
    Ok(Model::builder("rule 110")
        .extents(extents)
        .neighbourhood(Neighbourhood::custom([0, -1, 1].map(along).to_vec())?)
        .boundary(Boundary::Toroidal)
        .substates::<Rule>()
        .process(rule_110)
        .fill(|site| Rule { alive: u8::from(site.random(0) < 0.5) }))
}

/// Each axis is the long one; workgroups of 8 invocations, of which 50 fit along an axis.
#[test]
fn long_axes_give_the_same_bits() -> TestResult {
    let narrow = Handicap { workgroup: Some(8), workgroups: Some(50), ..Handicap::default() };
    let cut = Handicap { reach: Some(4096), ..narrow };
    for (extents, axis) in
        [([5000, 1, 1], 0), ([1, 1, 5000], 2), ([8, 1000, 1], 1), ([3, 70, 9], 1), ([3, 7, 70], 2)]
    {
        let model = rule(extents, axis)?.build()?;
        for handicap in [narrow, cut] {
            // A row cannot be cut.
            if extents[0] < 1000 || handicap.reach.is_none() {
                assert_agrees(&model, &gpu(handicap)?, 9);
            }
        }
    }
    Ok(())
}

/// The first fault in the order of cells is told, wherever its workgroup stands in the dispatch.
#[test]
fn faults_are_found_in_folded_dispatches() -> TestResult {
    let narrow = Handicap { workgroup: Some(8), workgroups: Some(50), ..Handicap::default() };
    for (extents, axis) in [([5000, 1, 1], 0), ([1, 1, 5000], 2), ([3, 70, 9], 1)] {
        let model = rule(extents, axis)?.process(stop_somewhere).build()?;
        assert_agrees(&model, &gpu(narrow)?, 3);
    }
    Ok(())
}

/// Without handicaps, on axes that are too long for the adapter's own limits.
#[test]
fn millions_of_cells_along_an_axis() -> TestResult {
    for (extents, axis, workgroup) in
        [([1, 1, 5_000_000], 2, None), ([5_000_000, 1, 1], 0, Some(64)), ([64, 100_000, 1], 1, Some(64))]
    {
        let model = rule(extents, axis)?.build()?;
        let handicap = Handicap { workgroup, ..Handicap::default() };
        assert_agrees(&model, &gpu(handicap)?, 2);
    }
    Ok(())
}
