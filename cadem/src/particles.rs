//! Particles on the host, and the checks on those that a run starts from.

use crate::face::Face;
use crate::initial::Placed;
use crate::substates::{Dem, PARTICLE};
use xca_core::{State, StateError, Vector3};

/// A particle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Particle {
    /// Its label, which it keeps for its life; less than [`crate::FIRST_BOUNDARY_LABEL`].
    pub label: u32,
    /// Its centre, x, y and z, in m.
    pub position: [f64; 3],
    /// Its velocity along x, y and z, in m/s.
    pub velocity: [f64; 3],
}

impl Particle {
    /// A particle that does not move.
    pub const fn at_rest(label: u32, position: [f64; 3]) -> Self {
        Self { label, position, velocity: [0.0; 3] }
    }

    pub(crate) fn substates(&self) -> Dem {
        let vector = |[x, y, z]: [f64; 3]| Vector3::new(x, y, z);
        Dem {
            id: PARTICLE,
            face: 0,
            position: vector(self.position),
            velocity: vector(self.velocity),
            force: Vector3::splat(0.0),
        }
    }
}

impl From<Placed> for Particle {
    fn from(placed: Placed) -> Self {
        Self::at_rest(placed.label, placed.position)
    }
}

/// The particles of a state, by label.
///
/// # Errors
/// Where the model is not CADEM.
pub fn particles(state: &State<'_>) -> Result<Vec<Particle>, StateError> {
    let mut particles: Vec<Particle> = state
        .items::<Dem>()?
        .into_iter()
        .filter(|item| item.state.id == PARTICLE)
        .map(|item| Particle {
            label: item.label,
            position: array(item.state.position),
            velocity: array(item.state.velocity),
        })
        .collect();
    particles.sort_unstable_by_key(|particle| particle.label);
    Ok(particles)
}

pub(crate) fn array(vector: Vector3<f64>) -> [f64; 3] {
    [vector.x, vector.y, vector.z]
}

/// A particle that no run can start from.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the messages explain the fields")]
#[non_exhaustive]
pub enum ParticleError {
    #[error("the {what} of particle {label} is {value:?}; it must be three finite numbers")]
    NotFinite { label: u32, what: &'static str, value: [f64; 3] },
    #[error("particle {label} at {position:?} m is outside the domain, which reaches from 0 to {sides:?} m")]
    Outside { label: u32, position: [f64; 3], sides: [f64; 3] },
    #[error(
        "particle {label} at {position:?} m is behind the wall {face}, which this wall law puts at {wall} m; `allow_overlaps` (`--allow-overlaps` on the command line) lets it"
    )]
    BehindWall { label: u32, position: [f64; 3], face: Face, wall: f64 },
    #[error("two particles have the label {label}")]
    LabelTwice { label: u32 },
    #[error("the label {label} is too large; labels of particles are less than {limit}")]
    LargeLabel { label: u32, limit: u32 },
    #[error(
        "particles {label} and {other} overlap: their centres are {distance} m apart, less than two radii, {diameter} m \
         (in all {pairs} pairs overlap); `allow_overlaps` (`--allow-overlaps` on the command line) lets them"
    )]
    Overlap { label: u32, other: u32, distance: f64, diameter: f64, pairs: u64 },
}

impl ParticleError {
    /// The labels of the particles that the error is about, so that a reader can say where they come from.
    pub fn labels(&self) -> (u32, Option<u32>) {
        match self {
            Self::NotFinite { label, .. }
            | Self::Outside { label, .. }
            | Self::BehindWall { label, .. }
            | Self::LabelTwice { label }
            | Self::LargeLabel { label, .. } => (*label, None),
            Self::Overlap { label, other, .. } => (*label, Some(*other)),
        }
    }
}
