//! What passes between parts, against counts by hand.

use crate::{TestResult, cpu};
use std::collections::BTreeMap;
use xca_core::prelude::*;
use xca_parts::{Balance, Grid, Parts};
use xca_tests::suite::engines::gpu;

#[derive(Substates, Clone, Copy, Debug, PartialEq)]
struct Plate {
    warmth: Real,
    age: u32,
}

/// Each step changes the age, which neighbours do not read.
#[elementary_process]
fn spread(plate: &mut Cell<Plate>) {
    let mut sum = 0.0;
    for n in 1..plate.neighbour_count() {
        sum += plate.neighbour(n).warmth;
    }
    plate.warmth = 0.25 * sum;
    plate.age += 1;
}

/// A line of 30 cells has a halo of one cell at each end, of 8 bytes each in `f64`.
const LINE: u64 = (30 + 2) * 8;

const STEPS: u64 = 19;

/// The figures of all parts after some steps.
fn figures(boundary: Boundary, parts: &Parts) -> Result<BTreeMap<String, f64>, Box<dyn std::error::Error>> {
    let model = Model::builder("plate")
        .extents([30, 8, 1])
        .neighbourhood(Neighbourhood::von_neumann_2d(1))
        .boundary(boundary)
        .substates::<Plate>()
        .process(spread)
        .build()?;
    let options = RunOptions { precision: Precision::F64, seed: 0 };
    let mut simulation = Simulation::new(&model, parts, options)?;
    simulation.run(STEPS)?;
    Ok(simulation.figures().into_iter().map(|figure| (figure.name, figure.value)).collect())
}

#[test]
fn messages_are_those_of_the_edges() -> TestResult {
    // Faces with another part beyond them, of each part.
    for (boundary, parts, neighbours) in [
        (Boundary::Toroidal, 2, vec![2, 2]),
        (Boundary::Toroidal, 3, vec![2, 2, 2]),
        (Boundary::Flat, 3, vec![1, 2, 1]),
        (Boundary::Flat, 1, vec![0]),
    ] {
        let grid = Grid { y: parts, z: 1 };
        let on_cpu = figures(boundary, &Parts::with_grid(cpu(1, 0)?, grid).with_balance(Balance::NEVER))?;
        let on_gpu = figures(boundary, &Parts::with_grid(gpu()?, grid).with_balance(Balance::NEVER))?;
        for ((part, faces), figures) in
            neighbours.into_iter().enumerate().flat_map(|part| [(part, &on_cpu), (part, &on_gpu)])
        {
            let figure = |name: &str| figures[&format!("part_{part}_{name}")];
            // Each step sends the warmth of the line at each face.
            assert_eq!(figure("messages_sent"), (STEPS * faces) as f64, "{boundary} {parts}");
            assert_eq!(figure("bytes_sent"), (STEPS * faces * LINE) as f64, "{boundary} {parts}");
            // They compare their faults every 16 steps and at the end. One part alone has no one to ask.
            let agreements = if parts > 1 { 2.0 } else { 0.0 };
            assert_eq!(figure("agreements"), agreements, "{boundary} {parts}");
            assert!(figure("seconds_waited") >= 0.0);
        }
    }
    Ok(())
}
