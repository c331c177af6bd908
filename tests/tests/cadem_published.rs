//! The authors' systems: how many particles they have, and how the run that they published ends.

mod cadem_support;

use cadem::{BOUNDARY, Case, Dem, Diagnostics};
use cadem_support::{TestResult, close};
use xca_core::prelude::*;
use xca_cpu::Cpu;

#[test]
fn the_published_run_ends_with_its_energy() -> TestResult {
    let configuration = Case::Published.configuration();
    let model = cadem::model(&configuration, configuration.authors_particles()?)?;
    let mut simulation = Simulation::new(&model, &Cpu::new()?, RunOptions::default())?;
    simulation.run(configuration.steps)?;
    let last = Diagnostics::of(&simulation.state(), configuration.walls)?;
    assert_eq!((last.particles, last.left), (2602, 0));
    close(last.kinetic_energy + last.potential_energy, 0.011_240_501, 5e-10);
    Ok(())
}

#[test]
fn the_published_run_begins_alike_on_the_reference_engine() -> TestResult {
    let configuration = Case::Published.configuration();
    let model = cadem::model(&configuration, configuration.authors_particles()?)?;
    let mut snapshots = Vec::new();
    for engine in [&Reference as &dyn Engine, &Cpu::new()?] {
        let mut simulation = Simulation::new(&model, engine, RunOptions::default())?;
        simulation.run(40)?;
        assert!(Diagnostics::of(&simulation.state(), configuration.walls)?.wall_contacts > 0);
        snapshots.push(simulation.snapshot()?);
    }
    assert!(snapshots[0] == snapshots[1]);
    Ok(())
}

/// 20^3 cells with one BOUNDARY slot for each face that a cell touches, and 100^3.
#[test]
fn the_systems_have_the_particles_and_walls_of_the_authors() -> TestResult {
    for (case, particles, boundary, potential) in
        [(Case::Illustration, 2602, 2400, 0.014_487), (Case::Table1, 315_979, 60_000, 6.743_2)]
    {
        let configuration = case.configuration();
        let model = cadem::model(&configuration, configuration.authors_particles()?)?;
        let mut simulation = Simulation::new(&model, &Cpu::new()?, RunOptions::default())?;
        let state = simulation.state();
        assert_eq!(state.count_items::<Dem>()?, particles + boundary);
        assert_eq!(state.count(Dem::ID, BOUNDARY)?, boundary as u64);
        let first = Diagnostics::of(&state, configuration.walls)?;
        assert_eq!((first.particles, first.contacts, first.wall_contacts), (particles as u64, 0, 0));
        assert_eq!((first.kinetic_energy, first.largest_speed), (0.0, 0.0));
        close(first.potential_energy / potential, 1.0, 1e-4);
    }
    Ok(())
}
