//! Tiles in which nothing can change: the same bits as with all of them, and less work.

use crate::common::{TestResult, gpu};
use std::error::Error;
use xca_core::Snapshot;
use xca_core::prelude::*;
use xca_gpu::Handicap;

/// Sand that slides where it is steep, on ground that wears off where sand slides.
#[derive(Substates, Clone, Copy, Debug)]
struct Slope {
    ground: Real,
    sand: Real,
    slides: [Real; 5],
    signed: Real,
    worn: u32,
}

#[derive(Parameters, Clone, Copy, Debug)]
struct Friction {
    limit: Real,
}

/// In place.
#[elementary_process]
fn let_go(cell: &mut Cell<Slope>, friction: &Friction) {
    for n in 1..cell.neighbour_count() {
        let here = cell.ground + cell.sand;
        let there = cell.neighbour(n).ground + cell.neighbour(n).sand;
        let steep = here - there - friction.limit;
        cell.slides[n] = if steep > 0.0 && cell.sand > 0.0 && cell.exists(n) {
            (0.1 * steep).min(0.2 * cell.sand)
        } else {
            0.0
        };
    }
}

#[elementary_process]
fn slide(cell: &mut Cell<Slope>) {
    for n in 1..cell.neighbour_count() {
        cell.sand += cell.neighbour(n).slides[cell.opposite(n)] - cell.slides[n];
    }
}

/// A second writer, now and then, of what others read at neighbours.
#[elementary_process]
fn wear(cell: &mut Cell<Slope>) {
    let mut sum = 0.0;
    for n in 1..cell.neighbour_count() {
        sum += cell.slides[n];
    }
    if sum > 0.001 {
        cell.worn += 1;
        cell.ground -= 0.01 * sum;
    }
}

/// Zeros that differ in their signs alone travel on.
#[elementary_process]
fn pass_signs(cell: &mut Cell<Slope>) {
    let west = cell.neighbour(2).signed;
    if west == 0.0 && 1.0 / west < 0.0 {
        cell.signed = west;
    }
}

fn slope(extents: [usize; 3], boundary: Boundary) -> Result<Model, ModelError> {
    Model::builder("slope")
        .extents(extents)
        .neighbourhood(Neighbourhood::von_neumann_2d(1))
        .boundaries([boundary, boundary, Boundary::Flat])
        .substates::<Slope>()
        .parameters(Friction { limit: 0.3 })
        .process(let_go)
        .process(slide)
        .process_every(3, wear)
        .process(pass_signs)
        .fill(|site| {
            let [x, y, _] = site.cell();
            let heap = x > 20 && x < 26 && y > 8 && y < 12;
            let signed = if x == 0 && y == 1 { -0.0 } else { 0.0 };
            let ground = 0.05 * x as f64;
            Slope { ground, sand: if heap { 4.0 } else { 0.0 }, slides: [0.0; 5], signed, worn: 0 }
        })
        .build()
}

/// Changes from outside come between the steps, and wake what they touch.
fn run(
    model: &Model,
    engine: &dyn Engine,
    precision: Precision,
) -> Result<(Snapshot, Option<f64>), Box<dyn Error>> {
    let mut simulation = Simulation::new(model, engine, RunOptions { precision, seed: 0 })?;
    simulation.run(25)?;
    simulation.state().set(Slope::SAND, [50, 3, 0], 2.5)?;
    simulation.run(20)?;
    simulation.step()?;
    let snapshot = simulation.snapshot()?;
    let mut simulation = Simulation::resume(model, engine, RunOptions { precision, seed: 0 }, &snapshot)?;
    simulation.run(15)?;
    let share = simulation.figures().into_iter().find(|figure| figure.name == "share_of_cells_worked_on");
    Ok((simulation.snapshot()?, share.map(|figure| figure.value)))
}

#[test]
fn quiet_tiles_are_left_out_and_no_bit_differs() -> TestResult {
    let small = Handicap { workgroup: Some(8), tiles: Some(2), ..Handicap::default() };
    let folded = Handicap { workgroups: Some(20), ..small };
    for (extents, handicap) in [([66, 21, 1], small), ([66, 21, 1], folded), ([61, 17, 1], small)] {
        let gpu = gpu(handicap)?;
        for boundary in [Boundary::Flat, Boundary::Toroidal, Boundary::Reflecting] {
            let model = slope(extents, boundary)?;
            for precision in [Precision::F32, Precision::F64] {
                let (wanted, _) = run(&model, &Reference, precision)?;
                let (found, share) = run(&model, &gpu, precision)?;
                assert!(wanted.groups == found.groups, "{extents:?} {boundary} {precision}");
                let share = share.ok_or("no share is told")?;
                assert!(share < 0.6, "{share} of the tiles are worked on");
            }
        }
    }
    Ok(())
}
