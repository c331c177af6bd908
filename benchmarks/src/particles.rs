//! CADEM on the CPU engine: time a step, cost a particle, memory; beside LAMMPS, where it is installed.

use crate::lammps;
use crate::state::State;
use std::error::Error;
use std::fmt;
use std::path::Path;
use std::time::Instant;
use xca_core::engine::Figure;
use xca_core::prelude::*;
use xca_cpu::Cpu;

/// The cost of a step in one state.
#[derive(Debug)]
pub(crate) struct Cost {
    name: String,
    particles: usize,
    /// Seconds a step, sorted.
    seconds: Vec<f64>,
    /// The bytes that the engine's state takes.
    memory: usize,
    /// What the engine tells of its own work.
    figures: Vec<Figure>,
    /// What LAMMPS takes, in turns, and the ratio of the engine's time to it; sorted by this.
    beside: Vec<Beside>,
}

/// LAMMPS beside a round of the engine.
#[derive(Debug)]
struct Beside {
    lammps: lammps::Cost,
    ratio: f64,
}

/// How often, and on how many threads or processes, is measured.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rounds {
    pub(crate) rounds: usize,
    pub(crate) steps: usize,
    pub(crate) threads: usize,
}

/// Times rounds of so many steps, each from the same state and after one step to warm up; with a folder, in
/// turns with LAMMPS.
pub(crate) fn cost(
    name: &str,
    state: &State,
    Rounds { rounds, steps, threads }: Rounds,
    folder: Option<&Path>,
) -> Result<Cost, Box<dyn Error>> {
    let model = state.model()?;
    let (mut seconds, mut beside) = (Vec::new(), Vec::new());
    let (mut memory, mut figures) = (0, Vec::new());
    for _ in 0..rounds.max(1) {
        let mut simulation = Simulation::new(&model, &Cpu::with_threads(threads)?, RunOptions::default())?;
        // The engine learns what searches need, and makes its lists.
        simulation.run(WARM_UP)?;
        let start = Instant::now();
        simulation.run(steps as u64)?;
        let time = start.elapsed().as_secs_f64() / steps.max(1) as f64;
        seconds.push(time);
        (memory, figures) = (simulation.memory(), simulation.figures());
        if let Some(folder) = folder {
            let lammps = lammps::cost(state, steps, threads, &folder.join("lammps"))?;
            beside.push(Beside { ratio: time / lammps.seconds, lammps });
        }
    }
    seconds.sort_by(f64::total_cmp);
    beside.sort_by(|one, other| one.ratio.total_cmp(&other.ratio));
    Ok(Cost { name: name.to_owned(), particles: state.particles.len(), seconds, memory, figures, beside })
}

/// Steps before those that are timed, as many as LAMMPS does.
const WARM_UP: u64 = 20;

impl fmt::Display for Cost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, particles, seconds, memory, figures, beside } = self;
        let (median, low, high) = (seconds[seconds.len() / 2], seconds[0], seconds[seconds.len() - 1]);
        write!(
            f,
            "cadem {name}, {particles} particles: {:.2} ms a step ({:.2} to {:.2}), {:.1} ns a particle; state {:.1} MB",
            median * 1e3,
            low * 1e3,
            high * 1e3,
            median * 1e9 / *particles as f64,
            *memory as f64 / 1e6,
        )?;
        if let Some(Beside { lammps, ratio }) = beside.get(beside.len() / 2) {
            let (low, high) = (beside[0].ratio, beside[beside.len() - 1].ratio);
            write!(
                f,
                "\n  LAMMPS: {:.2} ms a step with a skin of {} m; ratio {ratio:.2} ({low:.2} to {high:.2})",
                lammps.seconds * 1e3,
                lammps.skin,
            )?;
        }
        for Figure { name, value } in figures {
            write!(f, "\n  {name}: {}", (value * 1e6).round() / 1e6)?;
        }
        Ok(())
    }
}
