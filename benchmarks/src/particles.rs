//! CADEM on the CPU engine: time a step, cost a particle, memory; beside LAMMPS, where it is installed.

use crate::lammps;
use cadem::{Case, Configuration, Particle};
use std::error::Error;
use std::fmt;
use std::fs;
use std::path::Path;
use std::time::Instant;
use xca_core::engine::Figure;
use xca_core::prelude::*;
use xca_cpu::Cpu;

/// A state of the paper's benchmark.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Stage {
    /// At rest, without contacts.
    Start,
    /// After 8000 steps, when most particles bounce.
    Bouncing,
    /// After 12,000 steps with a strong damping, when particles lie on each other.
    Settled,
}

impl Stage {
    fn name(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Bouncing => "bouncing",
            Self::Settled => "settled",
        }
    }
}

/// A cube of particles.
pub(crate) struct State {
    /// Metres.
    pub(crate) side: f64,
    /// Metres.
    pub(crate) radius: f64,
    /// Kilograms.
    pub(crate) mass: f64,
    pub(crate) particles: Vec<Particle>,
    configuration: Configuration,
}

impl State {
    fn new(configuration: Configuration, particles: Vec<Particle>) -> Self {
        let [side, ..] = configuration.sides();
        Self { side, radius: configuration.radius, mass: configuration.mass, particles, configuration }
    }

    /// The start, in so many cells along each side.
    pub(crate) fn start(cells: usize) -> Result<Self, Box<dyn Error>> {
        let configuration = Configuration { cells: [cells; 3], ..Case::Table1.configuration() };
        let particles = configuration.authors_particles()?;
        Ok(Self::new(configuration, particles))
    }

    /// A state of the paper's size: out of the folder, or computed, which takes minutes, and kept there.
    pub(crate) fn at(stage: Stage, threads: usize, folder: &Path) -> Result<Self, Box<dyn Error>> {
        let start = Self::start(100)?;
        let (damping, steps) = match stage {
            Stage::Start => return Ok(start),
            Stage::Bouncing => (start.configuration.damping, 8000),
            Stage::Settled => (0.45, 12_000),
        };
        let configuration = Configuration { allow_overlaps: true, ..start.configuration.clone() };
        let file = folder.join(format!("{}.csv", stage.name()));
        if file.exists() {
            let read = xca_examples::cadem_input::particles(&file, &configuration);
            let particles = read.map_err(|failure| failure.to_string())?;
            return Ok(Self::new(configuration, particles));
        }
        let damped = Configuration { damping, ..start.configuration };
        let model = cadem::model(&damped, start.particles)?;
        let mut simulation = Simulation::new(&model, &Cpu::with_threads(threads)?, RunOptions::default())?;
        simulation.run(steps)?;
        let particles = cadem::particles(&simulation.state())?;
        fs::create_dir_all(folder)?;
        fs::write(&file, table(&particles))?;
        Ok(Self::new(configuration, particles))
    }

    /// The state as a model.
    pub(crate) fn model(&self) -> Result<Model, Box<dyn Error>> {
        Ok(cadem::model(&self.configuration, self.particles.clone())?)
    }
}

/// Particles as CADEM reads them, with all digits.
fn table(particles: &[Particle]) -> String {
    let mut text = "label,x,y,z,vx,vy,vz\n".to_owned();
    for Particle { label, position: [x, y, z], velocity: [vx, vy, vz], .. } in particles {
        text.push_str(&format!("{label},{x},{y},{z},{vx},{vy},{vz}\n"));
    }
    text
}

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
