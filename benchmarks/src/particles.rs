//! CADEM on the CPU engine: time a step, cost a particle, memory.

use cadem::{Case, Configuration};
use std::error::Error;
use std::time::Instant;
use xca_core::prelude::*;
use xca_cpu::Cpu;

/// The cost of a step in one state.
#[derive(Debug)]
pub(crate) struct Cost {
    pub(crate) particles: usize,
    pub(crate) step: u64,
    /// Seconds a step: median, shortest and longest.
    pub(crate) seconds: [f64; 3],
    /// The bytes that the engine's state takes.
    pub(crate) memory: usize,
}

/// The paper's benchmark in a cube of `cells` cells along each side, with the state at the start.
pub(crate) fn simulation(cells: usize, threads: usize) -> Result<Simulation, Box<dyn Error>> {
    let (model, _) = model(cells)?;
    Ok(Simulation::new(&model, &Cpu::with_threads(threads)?, RunOptions::default())?)
}

/// The same as a model, with the number of its particles.
pub(crate) fn model(cells: usize) -> Result<(Model, usize), Box<dyn Error>> {
    let configuration = Configuration { cells: [cells; 3], ..Case::Table1.configuration() };
    let particles = configuration.authors_particles()?;
    let count = particles.len();
    Ok((cadem::model(&configuration, particles)?, count))
}

/// Steps that are timed together.
const BATCH: usize = 5;

/// Times so many steps, some at a time.
pub(crate) fn cost(simulation: &mut Simulation, steps: usize) -> Result<Cost, Box<dyn Error>> {
    let step = simulation.step_number();
    let batches = steps.div_ceil(BATCH).max(1);
    let mut seconds = Vec::with_capacity(batches);
    for _ in 0..batches {
        let start = Instant::now();
        simulation.run(BATCH as u64)?;
        seconds.push(start.elapsed().as_secs_f64() / BATCH as f64);
    }
    seconds.sort_by(f64::total_cmp);
    let items = simulation.state().items::<cadem::Dem>()?;
    let particles = items.iter().filter(|item| item.state.id == cadem::PARTICLE).count();
    let seconds = [seconds[batches / 2], seconds[0], seconds[batches - 1]];
    Ok(Cost { particles, step, seconds, memory: simulation.memory() })
}
