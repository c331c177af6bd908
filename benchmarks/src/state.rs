//! The states of CADEM that are timed.

use cadem::{Case, Configuration, Particle};
use std::error::Error;
use std::fs;
use std::path::Path;
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
