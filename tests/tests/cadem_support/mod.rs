//! Small CADEM systems for the tests of its physics.
#![allow(dead_code, reason = "each test program uses a part")]

use cadem::{Case, Configuration, Face, Opening, Particle};
use xca_core::prelude::*;

pub(crate) type TestResult = Result<(), Box<dyn std::error::Error>>;

/// The paper's material in a space of so many cells, with no gravity and no walls.
pub(crate) fn weightless(cells: [usize; 3]) -> Configuration {
    Configuration { cells, gravity: 0.0, openings: Opening::all_faces(), ..Case::Table1.configuration() }
}

/// Opens all faces but this one.
pub(crate) fn only_wall(face: Face) -> Vec<Opening> {
    Face::ALL.into_iter().filter(|other| *other != face).map(Opening::whole).collect()
}

/// Starts a run on the reference engine, in `f64`.
pub(crate) fn start(
    configuration: &Configuration,
    particles: Vec<Particle>,
) -> Result<Simulation, Box<dyn std::error::Error>> {
    let model = cadem::model(configuration, particles)?;
    Ok(Simulation::new(&model, &Reference, RunOptions::default())?)
}

/// Numbers in [0, 1), the same in every run: a linear congruence.
pub(crate) struct Numbers(u64);

impl Numbers {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub(crate) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A vector with components between -size and size.
    pub(crate) fn vector(&mut self, size: f64) -> [f64; 3] {
        [self.unit(), self.unit(), self.unit()].map(|number| size * (2.0 * number - 1.0))
    }
}

/// `found` is `expected`, within `tolerance`.
pub(crate) fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found:e} is not {expected:e} within {tolerance:e}");
}
